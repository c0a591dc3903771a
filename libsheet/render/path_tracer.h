// SPDX-License-Identifier: GPL-3.0-or-later
// Light along a camera ray by path tracing [Kajiya 1986]: lights are sampled at every turbid or matte surface and
// weighted against directions that the surface chose itself (multiple importance sampling [Veach and Guibas 1995],
// balance heuristic); paths end by Russian roulette.
//
// A sheet is a slab (slab.h) met where a ray enters its closed surface; the way out on the other side is free, since
// the slab's formulas hold both faces. Where a ray comes from within (a solid that touches the mid-surface, two layers
// that overlap), the way out is the meeting. So light that goes through a layer is always dimmed once. Straight light
// passes without a shift: a slab bends it back. Shadows of clear layers are coloured.
//
// One bias, against specks: where a turbid or matte surface sees a mirror image of the lights (caustics), it sees them
// blurred.
#pragma once
#include <vector>

#include "libsheet/render/lighting.h"
#include "libsheet/render/slab.h"
#include "libsheet/render/world.h"

namespace sheet::render {

struct Surroundings {
  std::vector<Colour> solids; // reflectance of the scene's solids, matte
  Colour ground{0.68F, 0.66F, 0.63F};
  float fade_from = 2,
        fade_to = 9; // planes seen directly blend into the backdrop between these distances, in the world's unit
};

class PathTracer {
public:
  // World and lighting must outlive it.
  PathTracer(const World& world, const Lighting& lighting, const Liquid& liquid, Surroundings surroundings);
  // The radiance that arrives along the ray. Adds the rays that it took to `rays`.
  [[nodiscard]] Colour radiance(const Ray& ray, Sampler& sampler, std::uint64_t& rays) const;

private:
  struct Path;
  struct Meeting;
  Colour follow(Path path, Sampler& sampler, std::uint64_t& rays) const;
  Colour meet_sheet(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays) const;
  Colour meet_matte(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays) const;
  Colour visible(const Hit& hit, const Vec& direction, bool inside, std::uint64_t& rays) const;

  const World* world_;
  const Lighting* lighting_;
  Slab slab_;
  DiffuseTable diffuse_;
  Surroundings surroundings_;
};

} // namespace sheet::render
