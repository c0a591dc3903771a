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

// The integral of c/rate(s) over ln r from the start on, s = (tension/c) (r/r0)^k; none if it does not yield.
std::optional<double> time_under(const Liquid& liquid, double tension, double c, double k) {
  constexpr double step = 0.05, enough = 1e-4; // of ln r; of what is summed up
  if (!(driven_rate(liquid, tension / c) > 0))
    return {};
  double time = 0, part = 0, at = 0.5 * step;
  do {
    part = c * step / driven_rate(liquid, tension / c * std::exp(k * at));
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

// Of one that the pressure acts on, from when it is there.
std::optional<double> blow_up_time_of(const scene::SheetTable& sheet, const Scene& scene) {
  const auto* thickness = std::get_if<double>(&sheet.thickness);
  if (thickness != nullptr && half_width(sheet.shape))
    return blow_up_time_of_flat(sheet, scene, *thickness);
  const auto* sphere = std::get_if<scene::Sphere>(&sheet.shape);
  const auto* cap = std::get_if<scene::Cap>(&sheet.shape);
  const auto* tube = std::get_if<scene::Tube>(&sheet.shape);
  if (thickness == nullptr || (sphere == nullptr && cap == nullptr && tube == nullptr))
    return {};
  const double radius = sphere != nullptr ? sphere->radius : cap != nullptr ? cap->radius : tube->radius;
  const auto law = pressing(*scene.environment.pressure, radius);
  const double tension = 2 * scene.material.surface_tension * (tube != nullptr ? 1 : 2) / radius;
  if (!law || !(law->value > tension) || (tube != nullptr && law->falls > 0))
    return {};
  // dr/dt = p r^n / c, h having thinned: with it r passes every bound at c / ((n - 1) p r^(n - 1)).
  if (!scene.material.law.newtonian())
    return tube != nullptr
               ? time_under(scene.material, law->value * radius / *thickness, 2, 2)
               : time_under(scene.material, law->value * radius / *thickness, 2 * std::numbers::sqrt3, 3 - law->falls);
  const double viscous = scene.material.viscosity * *thickness / (law->value * radius);
  return tube != nullptr ? 2 * viscous : 12 / (3 - law->falls) * viscous;
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
