// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of a sheet that touch, as one body of liquid: which faces lie inside it, and how deep it is.
//
// Two layers touch where they overlap, or where the gap is narrow between them. On the way of a ray, a face of theirs
// is inside the body if the ray comes from inside the layer in front of it, or from a gap that it bridges: gaps up to
// half the thickness there, or of the sheet on average if that is more, every ray bridges, gaps above twice that none,
// and of rays that draw what they bridge evenly, a part that falls linearly between. So what is seen, their mean, is
// continuous in the gap. Gaps have no depth. Layers of two liquids do not touch: the one behind is met for itself.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "libsheet/render/world.h"

namespace sheet::render {

// Where a ray is.
struct Within {
  float bridged;            // gaps up to so wide are liquid to this ray [widths]
  bool layer = false;       // it has last come into a layer
  int layers = 0;           // that it is in, by the faces that it has passed
  std::uint32_t liquid = 0; // of the layer that it has last met
  float width = 0; // otherwise, what gaps are measured by along the ray; 0: no layer may be near [units of the world]
};

// How deep the body is along a ray, as the thickness of a slab [m].
struct Depth {
  struct Part {
    float share, thickness;
  };
  float thickness = 0;          // to a ray that bridges so wide gaps as it does
  std::array<Part, 8> of_all{}; // to rays that bridge other gaps: shares of their sum, 1
  int parts = 0;                // of that
};

class Body {
public:
  Body() = default; // layers that touch are drawn each by itself
  explicit Body(const World& world);

  // Whether another layer may touch the one that is hit.
  [[nodiscard]] bool touches(const Face& hit) const {
    return hit.id == sheet_id && !touching_.empty() && touching_[hit.triangle] != 0;
  }
  // The normal of the surface at a hit of the sheet: smooth across the folds of layers that touch.
  [[nodiscard]] Vec normal_at(const World& world, const Hit& hit) const;
  // What a ray bridges, drawn with a number of [0, 1); 0.5 is the middle.
  [[nodiscard]] static float bridged(float number);
  // Whether any layers may touch.
  [[nodiscard]] bool has_layers_that_touch() const { return !touching_.empty(); }
  // Whether the ray that is `within` passes the face that it hits without meeting it: it leaves the layer it is in, or
  // goes from layer to layer in the body. `within` is then where it goes on.
  [[nodiscard]] bool passes(const World& world, const Face& hit, const Vec& direction, Within& within) const;
  // Whether rays that bridge other gaps do not all do as that one does.
  [[nodiscard]] static bool is_by_chance(const Face& hit, const Vec& direction, const Within& within);
  // Where a ray is that goes on from a layer at `hit` in that direction; `enters`: it came there from outside, so that
  // what is thrown back is in air and bridges nothing.
  [[nodiscard]] Within after(const World& world, const Face& hit, const Vec& direction, bool enters,
                             float bridged) const;
  // How deep the body is along a ray that meets it at `hit`, which touches. `way`: the direction inside, refracted;
  // `cosine`: of its angle with the normal. Adds the rays that it took to `rays`.
  [[nodiscard]] Depth depth(const World& world, const Hit& hit, const Vec& way, float cosine, float bridged,
                            std::uint64_t& rays) const;
  // The greatest depth that is worth telling from greater ones [m], for layers of at most `thickest`.
  [[nodiscard]] float deepest(float thickest) const;

private:
  [[nodiscard]] float width_at(const World& world, const Face& hit, const Vec& direction) const;

  std::vector<char> touching_; // of Surface's triangles: another layer is near; empty: none is
  std::vector<Vec> normals_;   // of Surface's points
  float mean_ = 0;             // thickness [m]
};

// The world to draw bodies in. Where any layers touch, the surface is round instead of flat from vertex to vertex
// (rounded.h), as far as layers are close, and its faces stand out by so little (3e-6 of the world's unit) that those
// which coincide lie in order along a ray.
[[nodiscard]] std::unique_ptr<World> world_of_bodies(const Surface& surface, const std::vector<SolidMesh>& meshes,
                                                     const std::vector<Eigen::Isometry3d>& motions,
                                                     const std::vector<Plane>& planes, const Box& box);

} // namespace sheet::render
