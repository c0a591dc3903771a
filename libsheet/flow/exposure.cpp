// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/exposure.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/shape/random.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr std::string_view exposure_array = "tear.exposure";

std::span<double> exposures(Frame& frame) {
  formats::Array* array = frame.find(exposure_array);
  if (array == nullptr)
    array = &frame.put(formats::make_array(exposure_array, formats::Place::triangle, formats::Type::float64, 1, "1",
                                           formats::Transfer::conserve, frame.triangles));
  if (array->place != formats::Place::triangle || array->type != formats::Type::float64 || array->components != 1 ||
      array->transfer != formats::Transfer::conserve)
    fail(ExitCode::bad_input, "array \"{}\" is no exposure: it must be triangle float64 1 conserve; rename yours",
         exposure_array);
  return array->values<double>();
}

// Numbers of their own for each triangle of each step.
Random numbers_of(std::int64_t seed, std::uint64_t step, std::uint64_t triangle) {
  Random of_step(Random(static_cast<std::uint64_t>(seed)).next() + step);
  return Random(Random(of_step.next() + triangle).next());
}

// Evenly distributed over the triangle.
Vector3 place_in(const Corners& c, std::span<const Vector3> x, Random& random) {
  double a = random.uniform(), b = random.uniform();
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return x[c[0]] + a * (x[c[1]] - x[c[0]]) + b * (x[c[2]] - x[c[0]]);
}

} // namespace

double piercing(const scene::Inclusions& inclusions, double thickness) {
  return inclusions.number * std::pow(inclusions.at_thickness / thickness, inclusions.exponent);
}

std::vector<Site> draw_sites(Frame& frame, const scene::Inclusions& inclusions, std::span<const double> areas,
                             const std::vector<bool>& supported) {
  const std::span<double> exposure = exposures(frame);
  const auto volume = volumes(std::as_const(frame));
  const auto corners = triangles(std::as_const(frame));
  const auto x = positions(std::as_const(frame));
  std::vector<Site> sites;
  for (std::uint32_t t = 0; t < frame.triangles; ++t) {
    if (!(areas[t] > 0) || std::ranges::all_of(corners[t], [&](std::uint32_t v) { return supported[v]; }))
      continue;
    const double now = volume[t] * piercing(inclusions, volume[t] / areas[t]), rise = now - exposure[t];
    if (!(rise > 0))
      continue;
    exposure[t] = now;
    Random random = numbers_of(inclusions.seed, frame.step, t);
    if (random.uniform() < -std::expm1(-rise))
      sites.push_back({t, place_in(corners[t], x, random)});
  }
  return sites;
}

} // namespace sheet::flow
