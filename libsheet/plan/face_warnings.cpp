// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/face_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "libsheet/geometry/area.h"
#include "libsheet/material/driven_rate.h"
#include "libsheet/material/flow_curve.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;
using scene::brief;

double mean_thickness(const Frame& frame) {
  const auto x = positions(frame);
  double volume = 0, area = 0;
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    volume += volumes(frame)[t];
    area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  }
  return volume / area;
}

bool has_free_rims(const Scene& scene, const Frame& frame) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  return std::ranges::any_of(scene::free_faces(scene, frame, mesh).rims, [](double part) { return part > 0; });
}

bool right_angled(const Corners& c, std::span<const Vector3> x) {
  constexpr double close = 0.02; // cosine
  for (int k = 0; k < 3; ++k) {
    const Vector3 a = x[c[(k + 1) % 3]] - x[c[k]], b = x[c[(k + 2) % 3]] - x[c[k]];
    if (std::abs(a.dot(b)) < close * a.norm() * b.norm())
      return true;
  }
  return false;
}

std::string warning_of_mesh(const Frame& first) {
  const auto right =
      std::ranges::count_if(triangles(first), [&](const Corners& c) { return right_angled(c, positions(first)); });
  if (2 * static_cast<std::size_t>(right) < first.triangles)
    return {};
  return "faces = true on right-angled triangles: slopes count 0.83 to 1.5 times, by their direction; pattern = "
         "\"irregular\" or \"equilateral\", or sheet-remesh, counts them within some percent";
}

} // namespace

std::vector<std::string> face_warnings(const Scene& scene, const Frame& first, double until) {
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  const Liquid& liquid = *std::ranges::max_element(liquids, {}, &Liquid::surface_tension);
  if (!(liquid.surface_tension > 0) || first.triangles == 0)
    return {};
  if (scene.model.faces) {
    const std::string warning = warning_of_mesh(first);
    return warning.empty() ? std::vector<std::string>{} : std::vector{warning};
  }
  const double h = mean_thickness(first);
  const double rate = driven_rate(liquid, liquid.surface_tension / h), moved = rate * until;
  const double ohnesorge = viscosity_of(liquid, {rate * rate}) / std::sqrt(liquid.density * liquid.surface_tension * h);
  const bool inertial = scene.model.inertia && ohnesorge < 1;
  if (!(moved > 0.1 || inertial) || !(scene.tear || has_free_rims(scene, first)))
    return {};
  const std::string_view rims = has_free_rims(scene, first) ? "free rims" : "the rims of what tears";
  return {fmt::format("tension draws {} together without end, and levels nothing ({}): faces = true in [model] makes "
                      "rims and strands round",
                      rims,
                      inertial ? fmt::format("mu / sqrt(rho gamma h) = {}", brief(ohnesorge))
                               : fmt::format("gamma t / (mu h) = {} at {} s", brief(moved), brief(until)))};
}

} // namespace sheet
