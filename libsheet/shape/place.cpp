// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/place.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "libsheet/base/error.h"

namespace sheet {

Plane parse_plane(std::string_view name) {
  if (name == "xy")
    return Plane::xy;
  if (name == "xz")
    return Plane::xz;
  if (name == "yz")
    return Plane::yz;
  fail(ExitCode::bad_input, "plane = \"{}\": known are xy, xz and yz", name);
}

Eigen::Matrix3d plane_rotation(Plane plane) {
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  if (plane == Plane::xz)
    r << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  else if (plane == Plane::yz)
    r << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return r;
}

void place_mesh(TriangleMesh& mesh, const Placement& placement) {
  const Eigen::Matrix3d& r = placement.rotation;
  if (!((r.transpose() * r - Eigen::Matrix3d::Identity()).norm() < 1e-9) || !(r.determinant() > 0.0))
    fail(ExitCode::bad_input, "the rotation of the shape is no rotation");
  if (!placement.center.allFinite())
    fail(ExitCode::bad_input, "the center of the shape is not finite");
  const Eigen::Matrix3d turn = r * plane_rotation(placement.plane);
  for (Eigen::Vector3d& x : mesh.positions)
    x = (placement.center + turn * x).eval();
  for (Eigen::Vector3d& v : mesh.velocities)
    v = (turn * v).eval();
}

} // namespace sheet
