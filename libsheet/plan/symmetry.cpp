// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/symmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using Eigen::Vector3d;

constexpr double rounding = 1e-9; // of speeds: what is less is none
constexpr double alike = 1e-3;    // of the thickness: lengths that differ by less
constexpr double noise = 1e-2;    // of the thickness
constexpr double farthest = 100;  // that anything falls, in sizes of the sheet
constexpr std::size_t probes = 100;

struct MirrorPlane {
  Vector3d normal;
  double size;      // of what lies in it [m]
  double thickness; // of that [m]

  [[nodiscard]] bool along(const Vector3d& v) const { return std::abs(v.dot(normal)) <= rounding * v.norm(); }
  [[nodiscard]] bool turns_in_itself(const Vector3d& angular) const {
    return normal.cross(angular).norm() <= rounding * angular.norm();
  }
  [[nodiscard]] Vector3d mirrored(const Vector3d& v) const { return v - 2 * v.dot(normal) * normal; }
};

// In which all vertices of a sheet lie.
std::optional<MirrorPlane> plane_of(const formats::Frame& frame) {
  const double thickness = *measured(frame).thickness;
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
  const MirrorPlane plane{Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0), size,
                          thickness};
  for (const Vector3d& p : x)
    if (std::abs((p - mean).dot(plane.normal)) > alike * thickness)
      return {};
  return plane;
}

enum class Met { nothing, the_same, something_else };

// What both faces of what comes down from x meet, if all solids stand as at the start. What it passes does nothing to
// it, nor what comes later.
Met met_by_both_faces(const solid::Solids& solids, const MirrorPlane& plane, Vector3d x, const Vector3d& down) {
  const double half_thickness = plane.thickness / 2;
  for (double way = 0; way < farthest * plane.size;) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t met = 0;
    for (std::size_t i = 0; i < solids.size(); ++i)
      if (const double distance = solids.at(i, x, 0).distance; distance < nearest) {
        nearest = distance;
        met = i;
      }
    if (nearest <= half_thickness) {
      const solid::SolidPoint here = solids.at(met, x + half_thickness * plane.normal, 0),
                              there = solids.at(met, x - half_thickness * plane.normal, 0);
      const bool same = std::abs(here.distance - there.distance) <= alike * plane.thickness &&
                        (plane.mirrored(here.velocity) - there.velocity).norm() <= rounding * here.velocity.norm();
      return same ? Met::the_same : Met::something_else;
    }
    x += nearest * down;
    way += nearest;
  }
  return Met::nothing;
}

// Whether it meets something, and always the same with both faces.
bool meets_mirror_images(const Scene& scene, const MirrorPlane& plane, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Vector3d down = scene.environment.gravity->normalized();
  const std::size_t apart = std::max<std::size_t>(1, first.vertices / probes);
  bool meets = false;
  for (std::size_t v = 0; v < first.vertices; v += apart) {
    const Met met = met_by_both_faces(solids, plane, positions(first)[v], down);
    if (met == Met::something_else)
      return false;
    meets = meets || met == Met::the_same;
  }
  return meets;
}

bool moves_along(const Scene& scene, const scene::SheetTable& sheet, const MirrorPlane& plane) {
  const bool sheet_is_quiet = plane.along(sheet.velocity) && plane.turns_in_itself(sheet.angular_velocity) &&
                              sheet.radial_velocity == 0 && !sheet.enters &&
                              std::ranges::all_of(sheet.perturbations, &scene::Perturbation::of_thickness);
  const auto inflow_is_quiet = [&](const scene::Inflow& inflow) {
    const bool of_other = !inflow.sheet.empty() && inflow.sheet != sheet.name;
    return of_other ||
           (inflow.radial_velocity.entries.empty() &&
            std::ranges::all_of(inflow.velocity.entries, [&](const auto& entry) { return plane.along(entry.value); }));
  };
  const auto& air = scene.environment.air;
  const bool blown_along =
      !air || std::ranges::all_of(air->wind.entries, [&](const auto& entry) { return plane.along(entry.value); });
  const auto rests = [](const scene::Hold& hold) { return std::holds_alternative<scene::Fixed>(hold.motion); };
  return blown_along && sheet_is_quiet && std::ranges::all_of(scene.inflows, inflow_is_quiet) &&
         std::ranges::all_of(scene.holds, rests);
}

} // namespace

std::vector<std::size_t> sheets_in_their_planes(const Scene& scene) {
  std::vector<std::size_t> sheets;
  const auto& gravity = scene.environment.gravity;
  if (!gravity || scene.solids.empty() || scene.environment.pressure || scene.environment.bath)
    return sheets;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const formats::Frame frame = build_sheet(scene, i, Notes::silent);
    const std::optional<MirrorPlane> plane = plane_of(frame);
    if (plane && plane->along(*gravity) && moves_along(scene, scene.sheets[i], *plane) &&
        meets_mirror_images(scene, *plane, frame))
      sheets.push_back(i);
  }
  return sheets;
}

std::vector<std::string> small_noise(const Scene& scene, std::span<const std::size_t> sheets,
                                     std::span<const scene::Measured> measured) {
  std::vector<std::string> sets;
  for (const std::size_t i : sheets)
    if (scene.sheets[i].perturbations.empty())
      sets.push_back(fmt::format("sheet.{}perturbation={{amplitude = \"{:.2g} um\", seed = {}}}",
                                 scene.sheets.size() > 1 ? fmt::format("{}.", i) : "",
                                 1e6 * noise * *measured[i].thickness, i + 1));
  return sets;
}

} // namespace sheet
