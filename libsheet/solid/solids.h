// SPDX-License-Identifier: GPL-3.0-or-later
// The solids of a scene in their places: signed distance, outward normal and surface velocity at any point and time.
#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libsheet/geometry/facing_walls.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/distance.h"

namespace sheet::solid {

// What a solid is at a point x and a time.
struct SolidPoint {
  double distance;  // signed, negative inside [m]
  Vector3 normal;   // unit, outward, at the nearest point of the surface
  Vector3 velocity; // of what sticks to the surface there: the solid's motion and its belt's [m/s]
};

// The part of a belt's velocity along its surface there. All of it on the faces along which it is meant to run.
[[nodiscard]] inline Vector3 along_surface(const Vector3& velocity, const Vector3& normal) {
  constexpr double rounding = 1e-9;
  const double across = velocity.dot(normal);
  return std::abs(across) <= rounding * velocity.norm() ? velocity : Vector3(velocity - across * normal);
}

class Solids {
public:
  // Reads the meshes and fields that the scene names, unless others are there that have read them (mesh.h). Throws
  // Error (io, bad_input) where one of them is missing or is not the surface of a solid (check.h).
  explicit Solids(const Scene& scene);

  [[nodiscard]] std::size_t size() const { return solids_.size(); }
  [[nodiscard]] bool empty() const { return solids_.empty(); }

  // For messages: its number in the scene, its shape, its file.
  [[nodiscard]] const std::string& name(std::size_t solid) const { return solids_[solid].name; }
  [[nodiscard]] const scene::Solid& scene(std::size_t solid) const { return solids_[solid].scene; }
  [[nodiscard]] const SolidDistance& shape(std::size_t solid) const { return *solids_[solid].shape; }

  // From the solid's own frame to the world at time t [s].
  [[nodiscard]] Eigen::Isometry3d pose(std::size_t solid, double t) const;

  // At the point x [m] of the world, at time t [s].
  [[nodiscard]] SolidPoint at(std::size_t solid, const Vector3& x, double t) const;

  // Velocity at time t of what sticks to the solid at x, where its surface has this normal [m/s]: the belt runs along
  // the surface, so at a face that it does not run along it stands.
  [[nodiscard]] Vector3 surface_velocity(std::size_t solid, const Vector3& x, const Vector3& normal, double t) const;
  // The belt's part of it.
  [[nodiscard]] Vector3 belt_velocity(std::size_t solid, const Vector3& normal) const;

  // Whether what sticks to one may be squeezed by another one (scene::solids_squeeze).
  [[nodiscard]] bool may_squeeze() const { return may_squeeze_; }

  // Another solid across a gap.
  struct Facing {
    std::size_t solid;
    double gap; // [m]
  };
  // Of those that face `solid` at the point x [m] at time t [s] (facing_walls.h), the nearest, if it leaves less than
  // `room` [m]: across the point, or beside an edge of the other one by the longest edge of the mesh there [m].
  [[nodiscard]] std::optional<Facing> facing(std::size_t solid, const Vector3& x, double t, double room,
                                             double longest_edge = 0) const;
  // Whether another one leaves what sticks to `solid` there no room: it faces it across a gap that a layer of this
  // thickness [m] fills.
  [[nodiscard]] bool squeezed(std::size_t solid, const Vector3& x, double t, double thickness,
                              double longest_edge) const {
    return facing(solid, x, t, filled_gap * thickness, longest_edge).has_value();
  }

private:
  struct Entry {
    scene::Solid scene;
    std::string name;
    Eigen::Isometry3d placed; // from its own frame to the world at time 0
    std::shared_ptr<const SolidDistance> shape;
  };
  std::vector<Entry> solids_;
  bool may_squeeze_ = false;
};

} // namespace sheet::solid
