// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hole_forecast.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "libsheet/flow/exposure.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/brief.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;
using scene::brief;

constexpr double too_many = 1; // holes at the start

// Exposure of the whole first frame: how many holes open at once.
double holes_at_start(const scene::Inclusions& inclusions, const Frame& first) {
  const auto x = positions(first);
  double exposure = 0;
  for (std::size_t t = 0; t < first.triangles; ++t) {
    const Corners& c = triangles(first)[t];
    const double area = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
    if (area > 0)
      exposure += volumes(first)[t] * flow::piercing(inclusions, volumes(first)[t] / area);
  }
  return exposure;
}

} // namespace

std::vector<scene::Scale> hole_scales(const Scene& scene, const Frame& first) {
  if (!scene.tear || !scene.tear->inclusions || first.triangles == 0)
    return {};
  const auto& [number, at_thickness, m, seed] = *scene.tear->inclusions;
  const auto volume = volumes(first);
  const double sites = number * std::accumulate(volume.begin(), volume.end(), 0.0);
  if (m > 1)
    return {{"h_1", "thickness at the first hole, in the mean",
             at_thickness * std::pow(sites, 1 / m) * std::tgamma(1 - 1 / m), "m",
             "at_thickness (sites V)^(1/m) Gamma(1 - 1/m), thinned evenly"}};
  return {{"h_1", "thickness at the first hole, median", at_thickness * std::pow(sites / std::numbers::ln2, 1 / m), "m",
           "at_thickness (sites V / ln 2)^(1/m), thinned evenly"}};
}

std::vector<std::string> hole_warnings(const Scene& scene, const Frame& first) {
  if (!scene.tear)
    return {};
  std::vector<std::string> warnings;
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  if (scene.tear->drops &&
      std::ranges::none_of(liquids, [](const Liquid& liquid) { return liquid.surface_tension > 0; }))
    warnings.emplace_back("[tear] drops are balls, which only surface_tension in [material] would make of pieces");
  if (!scene.tear->inclusions)
    return warnings;
  if (!(scene.material.surface_tension > 0))
    warnings.emplace_back("[tear] sites opens holes that nothing draws open: surface_tension in [material] does");
  if (const double holes = holes_at_start(*scene.tear->inclusions, first); holes > too_many)
    warnings.push_back(fmt::format("some {} holes open at the start: fewer sites, a smaller at_thickness, or a thicker "
                                   "sheet",
                                   brief(holes)));
  return warnings;
}

} // namespace sheet
