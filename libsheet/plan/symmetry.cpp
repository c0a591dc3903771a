// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/symmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using Eigen::Vector3d;

constexpr double rounding = 1e-9; // of lengths and speeds: what is less is none
constexpr double farthest = 100;  // that anything falls, in sizes of the sheet
constexpr std::size_t probes = 100;

struct MirrorPlane {
  Vector3d normal;
  double size; // of what lies in it [m]

  [[nodiscard]] bool along(const Vector3d& v) const { return std::abs(v.dot(normal)) <= rounding * v.norm(); }
  [[nodiscard]] bool turns_in_itself(const Vector3d& angular) const {
    return normal.cross(angular).norm() <= rounding * angular.norm();
  }
  [[nodiscard]] Vector3d mirrored(const Vector3d& v) const { return v - 2 * v.dot(normal) * normal; }
};

// In which all vertices lie.
std::optional<MirrorPlane> plane_of(const formats::Frame& frame) {
  const auto x = positions(frame);
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : x)
    mean += p / static_cast<double>(x.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double size = 0;
  for (const Vector3d& p : x) {
    spread += (p - mean) * (p - mean).transpose();
    size = std::max(size, (p - mean).norm());
  }
  const MirrorPlane plane{Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0), size};
  for (const Vector3d& p : x)
    if (std::abs((p - mean).dot(plane.normal)) > rounding * size)
      return {};
  return plane;
}

// Times at which motions are compared [s].
std::vector<double> times_of(const Scene& scene) {
  std::vector<double> times{0, 1};
  for (const scene::Solid& solid : scene.solids)
    std::ranges::copy(scene::events(solid.motion), std::back_inserter(times));
  return times;
}

// Whether both faces of what comes down from x see the same at time t, until it touches something.
bool meets_mirror_images(const solid::Solids& solids, const MirrorPlane& plane, Vector3d x, const Vector3d& down,
                         double half_thickness, double t) {
  for (double way = 0; way < farthest * plane.size;) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const solid::SolidPoint here = solids.at(i, x + half_thickness * plane.normal, t),
                              there = solids.at(i, x - half_thickness * plane.normal, t);
      if (std::abs(here.distance - there.distance) > rounding * plane.size ||
          (plane.mirrored(here.velocity) - there.velocity).norm() > rounding * here.velocity.norm())
        return false;
      nearest = std::min(nearest, solids.at(i, x, t).distance);
    }
    if (nearest <= half_thickness)
      return true;
    x += nearest * down;
    way += nearest;
  }
  return true;
}

bool meets_mirror_images(const Scene& scene, const MirrorPlane& plane, const formats::Frame& first, double thickness) {
  const solid::Solids solids(scene);
  const Vector3d down = scene.environment.gravity->normalized();
  const std::size_t apart = std::max<std::size_t>(1, first.vertices / probes);
  for (const double t : times_of(scene))
    for (std::size_t v = 0; v < first.vertices; v += apart)
      if (!meets_mirror_images(solids, plane, positions(first)[v], down, thickness / 2, t))
        return false;
  return true;
}

bool moves_along(const Scene& scene, const MirrorPlane& plane) {
  const auto sheet_is_quiet = [&](const scene::SheetTable& sheet) {
    return plane.along(sheet.velocity) && plane.turns_in_itself(sheet.angular_velocity) && sheet.radial_velocity == 0 &&
           !sheet.enters && std::ranges::all_of(sheet.perturbations, &scene::Perturbation::of_thickness);
  };
  const auto inflow_is_quiet = [&](const scene::Inflow& inflow) {
    return inflow.radial_velocity.entries.empty() &&
           std::ranges::all_of(inflow.velocity.entries, [&](const auto& entry) { return plane.along(entry.value); });
  };
  const auto& air = scene.environment.air;
  const bool blown_along =
      !air || std::ranges::all_of(air->wind.entries, [&](const auto& entry) { return plane.along(entry.value); });
  const auto rests = [](const scene::Hold& hold) { return std::holds_alternative<scene::Fixed>(hold.motion); };
  return blown_along && std::ranges::all_of(scene.sheets, sheet_is_quiet) &&
         std::ranges::all_of(scene.inflows, inflow_is_quiet) && std::ranges::all_of(scene.holds, rests);
}

} // namespace

bool stays_in_its_plane(const Scene& scene, const formats::Frame& first, double thickness) {
  const auto& gravity = scene.environment.gravity;
  if (!gravity || scene.solids.empty() || scene.environment.pressure || scene.environment.bath)
    return false;
  const std::optional<MirrorPlane> plane = plane_of(first);
  return plane && plane->along(*gravity) && moves_along(scene, *plane) &&
         meets_mirror_images(scene, *plane, first, thickness);
}

std::vector<std::string> small_noise(const Scene& scene, std::span<const scene::Measured> measured) {
  std::vector<std::string> sets;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (scene.sheets[i].perturbations.empty())
      sets.push_back(fmt::format("sheet.{}perturbation={{amplitude = \"{:.2g} um\", seed = {}}}",
                                 scene.sheets.size() > 1 ? fmt::format("{}.", i) : "", 100 * *measured[i].thickness,
                                 i + 1));
  return sets;
}

} // namespace sheet
