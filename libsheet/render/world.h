// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that rays may hit: the sheet, the solids, planes. Lengths are in the world's own unit, chosen so that what
// is drawn measures about 1 and lies at the origin: single precision is fine enough then.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "libsheet/geometry/box.h"
#include "libsheet/render/image.h"
#include "libsheet/render/solids.h"
#include "libsheet/render/surface.h"

namespace sheet::render {

struct Ray {
  Vec origin, direction; // direction of length 1
};

// Whether a ray goes straight on from the camera, or where light may come from: it passes planes that let light in.
enum class Looks : std::uint8_t { straight, for_light };

// Where a ray goes through a face.
struct Face {
  std::uint32_t id = nothing_id; // of Layers
  float distance = 0;            // along the ray
  Vec face = Vec::Zero();        // normal of the triangle, outwards
  float u = 0, v = 0;            // barycentric coordinates of the triangle's second and third corner
  std::uint32_t triangle = 0;    // of Surface, if the sheet is hit
  std::uint32_t part = 0;        // of what is drawn
  bool plane = false;            // a Plane is hit
  [[nodiscard]] bool anything() const { return id != nothing_id; }
};

struct Hit : Face {
  Vec position = Vec::Zero();
  Vec normal = Vec::Zero(); // smooth normal, outwards
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

  // Of a straight look.
  [[nodiscard]] Hit nearest(const Ray& ray) const;
  // Only what is behind the distance `beyond`: to go on after a hit that is passed through.
  [[nodiscard]] Hit nearest(const Ray& ray, float beyond) const;
  // Only the sheet, and only if it is the nearest between these distances.
  [[nodiscard]] Hit nearest_sheet(const Ray& ray, float beyond, float within) const;
  // The nearest faces of the sheet and of solids between these distances, in order, as many as `found` has room for;
  // their number.
  [[nodiscard]] std::size_t faces(const Ray& ray, float beyond, float within, std::span<Face> found) const;
  // The nearest plane.
  [[nodiscard]] Hit nearest_plane(const Ray& ray, Looks looks) const;
  // Where a face of the sheet or of a solid is hit.
  [[nodiscard]] Hit hit_of(const Face& face) const;
  // Embree's bare answer, for measurements: the distance or infinity.
  [[nodiscard]] float bare_distance(const Ray& ray) const;

  // The thickness of the sheet at a hit of it [m].
  [[nodiscard]] float thickness_at(const Face& hit) const;
  [[nodiscard]] const Surface& surface() const;
  [[nodiscard]] Vec to_world(const Vector3& x) const; // [m] to units of the world
  [[nodiscard]] Vector3 from_world(const Vec& x) const;
  [[nodiscard]] double unit() const; // [m]

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The faces along a ray, one after the other, as rays from each to the next would find them: 16 at a time by one
// traversal of the tree, since in piles rays go through as many.
class FacesAhead {
public:
  FacesAhead() = default;
  FacesAhead(const World& world, const Ray& ray, Looks looks = Looks::for_light);
  [[nodiscard]] const Ray& ray() const { return ray_; }
  // The next one, its distance counted from the one before; nothing if there is no more. A plane is the last. Adds the
  // rays that it took to `rays`.
  [[nodiscard]] Face next(std::uint64_t& rays);
  // All about a face that next() has just told.
  [[nodiscard]] Hit hit(const Face& told) const;

private:
  [[nodiscard]] bool is_before(const Face& face) const;
  bool look_on(std::uint64_t& rays);

  const World* world_ = nullptr;
  Ray ray_;
  Hit plane_;
  std::array<Face, 16> found_;
  std::size_t count_ = found_.size(), at_ = count_; // of what has been found; how much of it has been told or passed
  Face last_;                                       // that has been told
};

// A start beside a hit, on the side that `direction` goes to, so that the surface is not hit again.
[[nodiscard]] Ray leave(const Hit& hit, const Vec& direction);

} // namespace sheet::render
