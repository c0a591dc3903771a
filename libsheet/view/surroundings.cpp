// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/surroundings.h"

#include <algorithm>
#include <cmath>

#include "libsheet/render/framing.h"
#include "libsheet/view/packed_numbers.h"

namespace sheet::view {
namespace {

std::array<double, 3> coordinates(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

std::array<double, 12> numbers_of(const Eigen::Isometry3d& motion) {
  std::array<double, 12> m{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      m[static_cast<std::size_t>(3 * row + column)] = motion.linear()(row, column);
    m[static_cast<std::size_t>(9 + row)] = motion.translation()[row];
  }
  return m;
}

double reach(const render::SolidMesh& mesh) {
  double most = 1e-30;
  for (const auto& x : mesh.positions)
    most = std::max(most, x.cwiseAbs().maxCoeff());
  return most;
}

} // namespace

std::vector<PackedSolid> pack_solids(const Scene& scene) {
  std::vector<PackedSolid> solids;
  for (const render::SolidMesh& mesh : render::make_solids(scene)) {
    PackedSolid solid{mesh.solid, mesh.positions.size(), mesh.triangles.size(),
                      std::exp2(std::ceil(std::log2(reach(mesh))) - 16), ""};
    std::vector<std::int32_t> places, corners;
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& x : mesh.positions)
        places.push_back(static_cast<std::int32_t>(std::lround(x[axis] / solid.step)));
    for (const Corners& t : mesh.triangles)
      corners.insert(corners.end(), t.begin(), t.end());
    PackedNumbers packed;
    packed.add(places);
    packed.add(corners);
    solid.text = packed.text();
    solids.push_back(std::move(solid));
  }
  return solids;
}

bool Placement::operator==(const Placement& other) const {
  const auto same = [](const FlatSurface& a, const FlatSurface& b) {
    return a.kind == b.kind && a.point == b.point && a.normal == b.normal;
  };
  return motions == other.motions && std::ranges::equal(surfaces, other.surfaces, same);
}

Placement place_surroundings(const Scene& scene, const std::vector<PackedSolid>& solids, double time) {
  Placement placement;
  for (const PackedSolid& solid : solids)
    placement.motions.push_back(numbers_of(render::motion_of(scene.solids[solid.solid], time)));
  for (const render::Plane& plane : render::make_planes(scene, time)) {
    const bool runs = !scene.solids[plane.id - render::first_solid_id].surface_velocity.isZero();
    placement.surfaces.push_back({runs ? "belt" : "plane", coordinates(plane.point), coordinates(plane.normal)});
  }
  if (const auto& bath = scene.environment.bath) {
    const Eigen::Vector3d up = render::up_of(&scene);
    placement.surfaces.push_back(
        {render::has_shore(scene) ? "sea" : "bath", coordinates(bath->level * up), coordinates(up)});
  }
  return placement;
}

} // namespace sheet::view
