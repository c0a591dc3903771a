// SPDX-License-Identifier: GPL-3.0-or-later
// Puts a shape from its local frame (normal or axis +z) into the scene.
#pragma once
#include <string_view>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

// The plane in which flat shapes lie. The local axes x, y, z (normal) become
//   xy: x, y, z      xz: x, -z, y (horizontal, facing up)      yz: y, z, x
// Curved shapes turn with it: the cap's apex and the tube's axis point along the plane's normal.
enum class Plane { xy, xz, yz };

// "xy", "xz" or "yz"; throws Error (bad_input) otherwise.
[[nodiscard]] Plane parse_plane(std::string_view name);

struct Placement {
  Plane plane = Plane::xz;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); // about the centre, after the plane
  Eigen::Vector3d center = Eigen::Vector3d::Zero();       // [m] where the local origin goes
};

// The rotation that takes the local frame to the plane.
[[nodiscard]] Eigen::Matrix3d plane_rotation(Plane plane);

// x = center + rotation * plane_rotation * x_local; velocities turn too. Throws Error (bad_input) unless `rotation` is
// a proper rotation.
void place_mesh(TriangleMesh& mesh, const Placement& placement);

} // namespace sheet
