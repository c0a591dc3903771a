// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/blow_up.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libsheet/geometry/area.h"
#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

struct Pressing {
  double value, falls; // at the start [Pa]; p ~ r^-falls
};

std::optional<Pressing> pressing(const scene::Pressure& pressure, double radius) {
  if (const auto* constant = std::get_if<scene::ConstantPressure>(&pressure))
    return Pressing{constant->value, 0};
  if (const auto* law = std::get_if<scene::InverseSquarePressure>(&pressure))
    return Pressing{law->value * law->reference_radius * law->reference_radius / (radius * radius), 2};
  return {}; // a given amount of gas ends where its pressure does
}

// What is blown up round: a sphere, or about that, or a tube.
struct Round {
  double radius, thickness; // at the start
  double sides;             // along which it is curved: 2 of a sphere, 1 of a tube
  double c;                 // c (dr/dt)/r is its rate of strain
};

// The integral of c/rate(s) over ln r from the start on, s = (p r - 2 sides gamma)/(c h); none if it does not yield, or
// comes to where its surface tension bears the pressure.
std::optional<double> time_under(const Liquid& liquid, const Pressing& law, const Round& round) {
  constexpr double step = 0.05, enough = 1e-4; // of ln r; of what is summed up
  const double borne = 2 * round.sides * liquid.surface_tension;
  const auto rate_at = [&](double x) { // ln r less that at the start
    const double tension = law.value * round.radius * std::exp((1 - law.falls) * x) - borne;
    const double thickness = round.thickness * std::exp(-round.sides * x);
    return tension > 0 ? driven_rate(liquid, tension / (round.c * thickness)) : 0;
  };
  if (!(rate_at(0) > 0))
    return {};
  if (liquid.law.newtonian() && borne == 0)
    return round.c / (rate_at(0) * (1 - law.falls + round.sides));
  double time = 0, part = 0, at = 0.5 * step;
  do {
    const double rate = rate_at(at);
    if (!(rate > 0))
      return {};
    part = round.c * step / rate;
    time += part;
    at += step;
  } while (part > enough * time);
  return time;
}

// Of a flat sheet from its middle to the nearest rim [m].
std::optional<double> half_width(const scene::SheetShape& shape) {
  if (const auto* disk = std::get_if<scene::Disk>(&shape))
    return disk->radius;
  if (const auto* rectangle = std::get_if<scene::Rectangle>(&shape))
    return std::min(rectangle->size_first, rectangle->size_second) / 2;
  return {};
}

bool is_held_at_rim(const scene::SheetTable& sheet, const Scene& scene) {
  return std::ranges::any_of(scene.holds, [&](const scene::Hold& hold) {
    const auto* border = std::get_if<scene::Border>(&hold.region);
    return border != nullptr && (*border == scene::Border::rim || *border == scene::Border::outer_rim) &&
           hold.axes == all_axes && !hold.until && (hold.sheet.empty() || hold.sheet == sheet.name);
  });
}

// Of a flat one; none where it tears before.
std::optional<double> blow_up_time_of_flat(const scene::SheetTable& sheet, const Scene& scene, double thickness) {
  constexpr double step = 0.02, last = 20; // of the height over the half width
  const auto* constant = std::get_if<scene::ConstantPressure>(&*scene.environment.pressure);
  const auto width = half_width(sheet.shape);
  if (!constant || !width || scene.tear || !is_held_at_rim(sheet, scene) ||
      !(std::abs(constant->value) * *width > 4 * scene.material.surface_tension))
    return {};
  const Liquid& liquid = scene.material;
  const double a = *width, p = std::abs(constant->value), c = 2 * std::numbers::sqrt3;
  double time = scene.model.inertia ? std::sqrt(2 * liquid.density * thickness * a / p) : 0;
  for (double s = step / 2; s < last; s += step) {
    const double rate = driven_rate(liquid, p * a * std::pow(1 + s * s, 2) / (2 * c * thickness * s));
    if (!(rate > 0))
      return {};
    time += c * s / ((1 + s * s) * rate) * step;
  }
  return time;
}

// Of one that is not flat. A cap that is held at its rim has its least radius as a half sphere over that.
std::optional<Round> round_one(const scene::SheetTable& sheet, const Scene& scene) {
  const auto* thickness = std::get_if<double>(&sheet.thickness);
  if (thickness == nullptr)
    return {};
  if (const auto* tube = std::get_if<scene::Tube>(&sheet.shape))
    return Round{tube->radius, *thickness, 1, 2};
  constexpr double of_sphere = 2 * std::numbers::sqrt3;
  if (const auto* sphere = std::get_if<scene::Sphere>(&sheet.shape))
    return Round{sphere->radius, *thickness, 2, of_sphere};
  if (const auto* cap = std::get_if<scene::Cap>(&sheet.shape)) {
    const bool shallow = cap->angle < std::numbers::pi / 2 && is_held_at_rim(sheet, scene);
    return Round{cap->radius * (shallow ? std::sin(cap->angle) : 1), *thickness, 2, of_sphere};
  }
  return {};
}

// Of one that the pressure acts on, from when it is there.
std::optional<double> blow_up_time_of(const scene::SheetTable& sheet, const Scene& scene) {
  const auto* thickness = std::get_if<double>(&sheet.thickness);
  if (thickness != nullptr && half_width(sheet.shape))
    return blow_up_time_of_flat(sheet, scene, *thickness);
  const auto round = round_one(sheet, scene);
  const auto law = round ? pressing(*scene.environment.pressure, round->radius) : std::nullopt;
  if (!law || (round->sides == 1 && law->falls > 0))
    return {};
  const auto creeping = time_under(scene.material, *law, *round);
  if (!creeping || !scene.model.inertia)
    return creeping;
  const double driving = law->value - 2 * round->sides * scene.material.surface_tension / round->radius;
  return *creeping + std::sqrt(2 * scene.material.density * round->thickness * round->radius / driving);
}

// To which side the pressure drives a flat sheet; none of one that is not flat.
std::optional<Vector3> bulging(const Scene& scene, const formats::Frame& first) {
  constexpr double flat = 0.99; // of the area
  const auto x = positions(first);
  Vector3 sum = Vector3::Zero();
  double area = 0;
  for (const Corners& c : triangles(first)) {
    const TriangleArea triangle(x[c[0]], x[c[1]], x[c[2]]);
    sum += triangle.area * triangle.normal;
    area += triangle.area;
  }
  const auto* constant = std::get_if<scene::ConstantPressure>(&*scene.environment.pressure);
  if (sum.norm() < flat * area || constant == nullptr)
    return {};
  return constant->value < 0 ? Vector3(-sum.normalized()) : Vector3(sum.normalized());
}

// The direction in the half space of a place in the unit circle: even in the one for places that are in the other.
Vector3 into_half_space(const Vector3& in_circle, const Vector3& normal) {
  const double r = std::min(1.0, in_circle.norm()), up = 1 - r * r;
  return r > 0 ? Vector3(std::sqrt(1 - up * up) / r * in_circle + up * normal).normalized() : normal;
}

} // namespace

bool is_blown_into_mould(const Scene& scene, const formats::Frame& first) {
  constexpr double near = 0.01; // sizes of the sheet: from a solid
  constexpr int most = 200;     // steps
  const solid::Solids solids(scene);
  const auto x = positions(first);
  solid::Box3 box;
  for (const Vector3& p : x)
    box.extend(p);
  const double size = box.diagonal().norm();
  const auto bulge = bulging(scene, first);
  const double radius = *measured(first).length / std::sqrt(std::numbers::pi); // of a circle of its area
  const double farthest = bulge ? 1.5 * radius : 10 * size;                    // from the middle
  const std::vector<std::size_t> probes = probes_of(first);
  const auto meets_solid = [&](std::size_t v) {
    const Vector3 from_middle = x[v] - box.center();
    const Vector3 out = bulge ? into_half_space(from_middle / radius, *bulge) : Vector3(from_middle.normalized());
    Vector3 place = bulge ? box.center() : x[v];
    for (int i = 0; i < most && (place - box.center()).norm() < farthest; ++i) {
      double distance = farthest;
      for (std::size_t s = 0; s < solids.size(); ++s)
        distance = std::min(distance, solids.at(s, place, first.time).distance);
      if (distance < near * size)
        return true;
      place += distance * out;
    }
    return false;
  };
  return !probes.empty() && 4 * std::ranges::count_if(probes, meets_solid) >= 3 * std::ssize(probes);
}

std::optional<double> blow_up_time(const Scene& scene) {
  std::optional<double> first;
  const std::string& only = scene.environment.pressure_sheet;
  for (const scene::SheetTable& sheet : scene.sheets)
    if (scene.environment.pressure && (only.empty() || sheet.name == only))
      if (const auto time = blow_up_time_of(sheet, scene::with_material_of(scene, sheet)))
        first = std::min(sheet.enters.value_or(0) + *time, first.value_or(std::numeric_limits<double>::infinity()));
  return first;
}

} // namespace sheet
