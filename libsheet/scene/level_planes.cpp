// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/level_planes.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr double one_degree = 0.99985; // as a cosine

Eigen::Index main_axis(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return axis;
}

Plane plane_across(Eigen::Index axis) { return axis == 0 ? Plane::yz : axis == 1 ? Plane::xz : Plane::xy; }

bool is_flat(const SheetShape& shape) {
  return std::holds_alternative<Rectangle>(shape) || std::holds_alternative<Disk>(shape) ||
         std::holds_alternative<Annulus>(shape);
}

} // namespace

std::optional<std::string> level_plane_in_doubt(const Scene& scene, std::size_t solid) {
  constexpr double rounding = 1e-9; // of cosines
  const auto* plane = std::get_if<HalfSpace>(&scene.solids[solid].shape);
  const auto gravity_up = up(scene.environment);
  if (plane == nullptr || !gravity_up || plane->normal.normalized().dot(*gravity_up) < 1 - rounding ||
      std::ranges::any_of(scene.sheets, [](const SheetTable& sheet) { return sheet.rotation.has_value(); }))
    return {};
  const Eigen::Index axis = main_axis(*gravity_up);
  if (std::abs((*gravity_up)[axis]) > one_degree)
    return {};
  Vector3d nearest = Vector3d::Zero();
  nearest[axis] = (*gravity_up)[axis] > 0 ? 1 : -1;
  return fmt::format("its normal is against gravity, as by default, so it is level, though gravity is along no axis: "
                     "for a slope normal = [{}, {}, {}]",
                     nearest.x(), nearest.y(), nearest.z());
}

std::optional<std::string> sheet_edge_on_in_doubt(const Scene& scene, const Vector3d& face) {
  const auto gravity_up = up(scene.environment);
  const Eigen::Index axis = gravity_up ? main_axis(*gravity_up) : 0, along = main_axis(face);
  if (!gravity_up || std::abs((*gravity_up)[axis]) > one_degree || along == axis || std::abs(face[along]) < one_degree)
    return {};
  const auto lies_across = [&](const SheetTable& sheet) {
    return is_flat(sheet.shape) && !sheet.rotation && axes_of(sheet.plane).normal == axis;
  };
  if (std::ranges::none_of(scene.sheets, lies_across))
    return {};
  return fmt::format("the sheet lies in {}, as that is most nearly across gravity, which is along no axis: plane = "
                     "\"{}\" in [sheet] lays it along that solid",
                     words::planes[static_cast<std::size_t>(plane_across(axis))],
                     words::planes[static_cast<std::size_t>(plane_across(along))]);
}

} // namespace sheet::scene
