// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/level_planes.h"

#include <algorithm>

#include <fmt/format.h>

namespace sheet::scene {

std::optional<std::string> level_plane_in_doubt(const Scene& scene, std::size_t solid) {
  constexpr double rounding = 1e-9, one_degree = 0.99985; // of cosines
  const auto* plane = std::get_if<HalfSpace>(&scene.solids[solid].shape);
  const auto gravity_up = up(scene.environment);
  if (plane == nullptr || !gravity_up || plane->normal.normalized().dot(*gravity_up) < 1 - rounding ||
      std::ranges::any_of(scene.sheets, [](const SheetTable& sheet) { return sheet.rotation.has_value(); }))
    return {};
  Eigen::Index axis = 0;
  if (gravity_up->cwiseAbs().maxCoeff(&axis) > one_degree)
    return {};
  Vector3d nearest = Vector3d::Zero();
  nearest[axis] = (*gravity_up)[axis] > 0 ? 1 : -1;
  return fmt::format("its normal is against gravity, as by default, so it is level, though gravity is along no axis: "
                     "for a slope normal = [{}, {}, {}]",
                     nearest.x(), nearest.y(), nearest.z());
}

} // namespace sheet::scene
