// SPDX-License-Identifier: GPL-3.0-or-later
// Light along a camera ray by path tracing [Kajiya 1986]: lights are sampled at every turbid or matte surface and
// weighted against directions that the surface chose itself (multiple importance sampling [Veach and Guibas 1995],
// balance heuristic); paths end by Russian roulette.
//
// A sheet is a slab (slab.h) met where a ray enters its closed surface; the way out on the other side is free, since
// the slab's formulas hold both faces. Where a ray comes from within (a solid that touches the mid-surface, two layers
// that overlap), the way out is the meeting. So light that goes through a layer is always dimmed once. Straight light
// passes without a shift: a slab bends it back. Shadows of clear layers are coloured. Layers that touch are one slab,
// as thick as they are deep together (body.h).
//
// Two biases, against specks: where a turbid or matte surface sees a mirror image of the lights (caustics), it sees
// them blurred; and what a path that has been chosen at random brings of the lights is bounded.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "libsheet/render/body.h"
#include "libsheet/render/lighting.h"
#include "libsheet/render/microfacets.h"
#include "libsheet/render/slab.h"
#include "libsheet/render/world.h"

namespace sheet::render {

struct Surroundings {
  std::vector<Colour> solids; // reflectance of the scene's solids, matte
  Colour ground{0.68F, 0.66F, 0.63F};
  std::optional<float> solid_gloss{}, ground_gloss{}; // roughness of a clear coat on it; absent: there is none
  // Planes and what lies behind everything are left to another picture where they are seen straight (coverage).
  bool cut_out = false;
  float fade_from = 2,
        fade_to = 9; // planes seen directly blend into the backdrop between these distances, in the world's unit
};

// The light along a ray, in parts.
struct Light {
  Colour certain = Colour::Zero(); // of paths without any random decision: the same for each sample
  // Of the others: those that pass the first sheet or end there, and those in its mirror.
  std::array<Colour, 2> chance{Colour::Zero(), Colour::Zero()};
  Colour& of(bool is_certain, std::size_t layer) { return is_certain ? certain : chance[layer]; }
  [[nodiscard]] Colour sum() const { return certain + chance[0] + chance[1]; }
};

// What the light in one part of Light::chance comes from: the last surface on the way straight through all slabs that
// let most of the light pass. So it is what lies behind a clear sheet, not the sheet.
struct SightLayer {
  Colour weight = Colour::Zero(); // about what the light was multiplied with since it left that surface
  Vec normal = Vec::Zero();       // towards the camera
  Vec position = Vec::Zero();     // in the world's unit
  float length = 0;               // of the way there
  std::uint32_t way = 0;          // a number for all ids on the way; 0: there is nothing
  std::uint32_t end = 0;          // the last id
};

// What the camera sees along a ray without any random decision.
struct Sight {
  Hit first;
  Colour certain = Colour::Zero(); // Light::certain
  std::array<SightLayer, 2> layers;
};

class PathTracer {
public:
  // World and lighting must outlive it. `liquids`: by their numbers in the surface, and again from the first.
  PathTracer(const World& world, const Lighting& lighting, const std::vector<Liquid>& liquids,
             Surroundings surroundings, Body body = {});
  // The radiance that arrives along the ray. Adds the rays that it took to `rays`.
  [[nodiscard]] Light radiance(const Ray& ray, Sampler& sampler, std::uint64_t& rays) const;
  // The same, if it is known what the ray hits.
  [[nodiscard]] Light radiance(const Ray& ray, const Hit& first, Sampler& sampler, std::uint64_t& rays) const;
  // What comes back of even light from all sides, of what a ray of that direction hits.
  [[nodiscard]] Colour reflectance(const Hit& hit, const Vec& direction) const;
  [[nodiscard]] Sight look(const Ray& ray, std::uint64_t& rays) const;
  [[nodiscard]] bool cuts_out() const { return surroundings_.cut_out; }
  // With cut_out, the part of another background that is not seen along a ray: of red, green and blue that of the
  // colour of which the slabs let least pass. What they let pass of the others beyond that has the radiance of the
  // picture's own background. So honey is yellow before any other, too, which one part for all three would make grey.
  [[nodiscard]] float coverage(const Ray& ray, std::uint64_t& rays) const;

private:
  struct Path;
  struct Meeting;
  struct Crossing;
  [[nodiscard]] Path start(const Ray& ray, float number) const;
  void follow(Path path, const Hit& first, Sampler& sampler, std::uint64_t& rays, Light& light) const;
  void look(Path path, Sight& sight, std::uint64_t& rays) const;
  void meet_sheet(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays, Light& light) const;
  void meet_matte(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays, Light& light) const;
  Hit next_met(Path& path, std::uint64_t& rays) const;
  [[nodiscard]] Vec mirrored(const Hit& hit, const Meeting& meeting, const Vec& direction) const;
  [[nodiscard]] Crossing cross(const Hit& hit, const Path& path, std::uint64_t& rays) const;
  [[nodiscard]] Meeting meet(const Hit& hit, const Vec& direction) const;
  Depth depth(const Hit& hit, const Meeting& meeting, const Vec& direction, float bridged, std::uint64_t& rays) const;
  void go(const Hit& hit, const Meeting& meeting, const Vec& direction, Path& path) const;
  void go_on(const Hit& hit, const Meeting& meeting, Path& path) const;
  Path split(const Hit& hit, Crossing& crossing, Path& path) const;
  Colour lamp_at_sheet(const Hit& hit, const Path& path, const Crossing& crossing, const std::array<float, 4>& chance,
                       Sampler& sampler, std::uint64_t& rays) const;
  Colour lamp_mirrored(const Hit& hit, const Path& image, const Colour& mirrored, const RoughMirror& rough,
                       float chance, Sampler& sampler, std::uint64_t& rays) const;
  Colour arriving(const Hit& hit, const Lighting::Sample& lamp, const Colour& share, const Within& within, float number,
                  std::uint64_t& rays) const;
  void uncover(Path& path) const;
  Colour visible(const Hit& hit, const Vec& direction, Within within, std::uint64_t& rays) const;
  [[nodiscard]] bool passes(const Face& face, Path& path) const;
  [[nodiscard]] Colour bounded(const Colour& light) const;
  [[nodiscard]] Colour from_afar(Path& path) const;
  [[nodiscard]] Colour fade(const Hit& hit, Path& path) const;
  [[nodiscard]] const Colour& albedo(const Hit& hit) const;
  [[nodiscard]] const std::optional<float>& gloss(const Hit& hit) const;
  // How what is hit of the sheet takes light.
  struct Optics {
    Slab slab;
    DiffuseTable diffuse;
    [[nodiscard]] bool is_rough() const { return slab.liquid().roughness > 0; }
  };
  [[nodiscard]] const Optics& optics(const Hit& hit) const {
    return optics_[world_->surface().liquid(hit.triangle) % optics_.size()];
  }

  const World* world_;
  const Lighting* lighting_;
  Body body_;
  std::vector<Optics> optics_; // of each liquid
  Surroundings surroundings_;
};

} // namespace sheet::render
