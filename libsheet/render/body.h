// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of a sheet that touch, as one body of liquid: which faces lie inside it, and how deep it is.
//
// Two layers touch where they overlap, or where the gap is narrow between them: 1.25 thicknesses there, or those of the
// sheet on average if that is more. On the way of a ray, a face of theirs is inside the body if the ray comes from
// inside the layer in front of it, or from a gap no wider than that. A gap counts as liquid: it cannot be told from a
// layer whose faces rays skip, as they coincide with others.
#pragma once
#include <vector>

#include "libsheet/render/world.h"

namespace sheet::render {

// Where a ray is.
struct Within {
  bool layer = false; // in a layer that it has met
  float gap = 0;      // otherwise it has just left one, and the body goes on in a layer so near [units of the world]
};

class Body {
public:
  Body() = default; // layers that touch are drawn each by itself
  explicit Body(const World& world);

  // Whether another layer may touch the one that is hit.
  [[nodiscard]] bool touches(const Hit& hit) const {
    return hit.id == sheet_id && !touching_.empty() && touching_[hit.triangle] != 0;
  }
  // The normal of the surface at a hit of the sheet: smooth across the folds of layers that touch.
  [[nodiscard]] Vec normal_at(const World& world, const Hit& hit) const;
  // Whether the ray that is `within` passes the face that it hits without meeting it: it leaves the layer it is in, or
  // goes from layer to layer in the body. `within` is then where it goes on.
  [[nodiscard]] bool passes(const World& world, const Hit& hit, const Vec& direction, Within& within) const;
  // Where a ray is that has met a layer at `hit` and goes on in that direction; `inside`: in that layer.
  [[nodiscard]] Within after(const World& world, const Hit& hit, const Vec& direction, bool inside) const;
  // The thickness of a slab that the body is as deep as along a ray which meets it at `hit`, which touches [m]. `way`:
  // the direction inside, refracted; `cosine`: of its angle with the normal. Adds the rays that it took to `rays`.
  [[nodiscard]] float depth(const World& world, const Hit& hit, const Vec& way, float cosine,
                            std::uint64_t& rays) const;
  // The greatest depth that is worth telling from greater ones [m], for layers of at most `thickest`.
  [[nodiscard]] float deepest(float thickest) const;

private:
  [[nodiscard]] float gap_at(const World& world, const Hit& hit, const Vec& direction) const;

  std::vector<char> touching_; // of Surface's triangles: another layer is near; empty: none is
  std::vector<Vec> normals_;   // of Surface's points
  float mean_ = 0;             // thickness [m]
};

} // namespace sheet::render
