// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/slopes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/way_along_solid.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;

// Of the solid's surface where the vertex lies on it or would land; nothing if it does neither.
std::optional<Vector3> normal_below(const solid::Solids& solids, std::size_t solid, const Frame& sheet,
                                    double thickness, std::size_t vertex, const Landing* landing) {
  const solid::SolidPoint point = solids.at(solid, positions(sheet)[vertex], sheet.time);
  constexpr double near = 0.75; // of the thickness
  if (std::abs(point.distance) < near * thickness)
    return point.normal;
  return landing != nullptr && landing->solid == solid ? std::optional(landing->there.normal) : std::nullopt;
}

// Whether each probe lies on one of those along which it flows.
bool lies(const Scene& scene, const solid::Solids& solids, const Frame& sheet, double thickness) {
  return std::ranges::all_of(probes_of(sheet), [&](std::size_t v) {
    for (std::size_t s = 0; s < solids.size(); ++s)
      if (scene.solids[s].contact == SolidContact::flow && normal_below(solids, s, sheet, thickness, v, nullptr))
        return true;
    return false;
  });
}

std::optional<double> along(const solid::Solids& solids, std::size_t solid, const Frame& sheet, double thickness,
                            const Vector3& gravity, const std::vector<Landing>& landings) {
  double most = 0;
  auto landing = landings.begin();
  for (const std::size_t v : probes_of(sheet)) {
    const bool lands = landing != landings.end() && landing->vertex == v;
    const auto normal = normal_below(solids, solid, sheet, thickness, v, lands ? &*landing : nullptr);
    if (!normal)
      return std::nullopt;
    most = std::max(most, (gravity - gravity.dot(*normal) * *normal).norm());
    landing += lands ? 1 : 0;
  }
  return most;
}

// The steepest part of a way down, as far as an edge, round which it turns over as much as it is thick.
double steepest(WayAlongSolid way, const Vector3& gravity, double thickness) {
  std::vector<double> pulls; // at its steps
  bool edge = false, goes_on = true;
  for (int i = 0; goes_on && i < WayAlongSolid::most_steps; ++i) {
    pulls.push_back(way.along(gravity).norm());
    edge = pulls.back() > WayAlongSolid::least_slope * gravity.norm() && way.go(gravity);
    goes_on = pulls.back() > WayAlongSolid::least_slope * gravity.norm() && !edge && !way.taken_up();
  }
  const auto at_edge = static_cast<std::size_t>(std::ceil(WayAlongSolid::in_reach * thickness / way.step()));
  pulls.resize(edge ? std::max<std::size_t>(1, pulls.size() - std::min(pulls.size(), at_edge)) : pulls.size());
  return *std::ranges::max_element(pulls);
}

// Likewise on the ways down from where it lies or lands.
std::optional<double> along_ways_down(const Scene& scene, const solid::Solids& solids, std::size_t solid, double time,
                                      double thickness, const std::vector<Landing>& landings) {
  std::optional<double> most;
  for (const Landing& landing : landings)
    if (landing.solid == solid)
      most = std::max(most.value_or(0), steepest({scene, solids, solid, time, thickness, landing.place},
                                                 *scene.environment.gravity, thickness));
  return most;
}

} // namespace

std::vector<scene::Measured> measured_on_solids(const Scene& scene, const Frame& first) {
  std::vector<scene::Measured> all = measured_sheets(scene, first);
  if (!scene::flows_on_solids(scene) || !scene.environment.gravity)
    return all;
  const solid::Solids solids(scene);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = scene.sheets[i].name;
    const bool flows_in = std::ranges::any_of(
        scene.inflows, [&](const auto& inflow) { return inflow.sheet.empty() || inflow.sheet == name; });
    const Frame sheet = scene.sheets.size() == 1 ? first : build_sheet(scene, i, Notes::silent);
    const std::vector<Landing> lands = landings(scene, sheet);
    const double thickness = *all[i].thickness;
    all[i].lies = !flows_in && lies(scene, solids, sheet, thickness);
    for (std::size_t s = 0; s < solids.size(); ++s)
      all[i].along.push_back(scene.solids[s].contact != SolidContact::flow ? std::nullopt
                             : flows_in ? along_ways_down(scene, solids, s, sheet.time, thickness, lands)
                                        : along(solids, s, sheet, thickness, *scene.environment.gravity, lands));
  }
  return all;
}

} // namespace sheet
