// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that rays may hit: the sheet, the solids, planes. Lengths are in the world's own unit, chosen so that what
// is drawn measures about 1 and lies at the origin: single precision is fine enough then.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "libsheet/geometry/box.h"
#include "libsheet/render/image.h"
#include "libsheet/render/solids.h"
#include "libsheet/render/surface.h"

namespace sheet::render {

struct Ray {
  Vec origin, direction; // direction of length 1
};

struct Hit {
  std::uint32_t id = nothing_id; // of Layers
  float distance = 0;            // along the ray
  Vec position = Vec::Zero();    //
  Vec face = Vec::Zero();        // normal of the triangle, outwards
  Vec normal = Vec::Zero();      // smooth normal, outwards
  float u = 0, v = 0;            // barycentric coordinates of the triangle's second and third corner
  std::uint32_t triangle = 0;    // of Surface, if the sheet is hit
  bool plane = false;            // a Plane is hit
  [[nodiscard]] bool anything() const { return id != nothing_id; }
};

class World {
public:
  // Surface, meshes and their motions must outlive the world only until it is built. `box` is what the picture is
  // about.
  World(const Surface& surface, const std::vector<SolidMesh>& meshes, const std::vector<Eigen::Isometry3d>& motions,
        const std::vector<Plane>& planes, const Box& box);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  [[nodiscard]] Hit nearest(const Ray& ray) const;
  // Only what is behind the distance `beyond`: to go on after a hit that is passed through.
  [[nodiscard]] Hit nearest(const Ray& ray, float beyond) const;
  // Only the sheet, and only if it is the nearest between these distances.
  [[nodiscard]] Hit nearest_sheet(const Ray& ray, float beyond, float within) const;
  // Embree's bare answer, for measurements: the distance or infinity.
  [[nodiscard]] float bare_distance(const Ray& ray) const;

  // The thickness of the sheet at a hit of it [m].
  [[nodiscard]] float thickness_at(const Hit& hit) const;
  [[nodiscard]] const Surface& surface() const;
  [[nodiscard]] Vec to_world(const Vector3& x) const; // [m] to units of the world
  [[nodiscard]] Vector3 from_world(const Vec& x) const;
  [[nodiscard]] double unit() const; // [m]

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A start beside a hit, on the side that `direction` goes to, so that the surface is not hit again.
[[nodiscard]] Ray leave(const Hit& hit, const Vec& direction);

} // namespace sheet::render
