// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/blow_up.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libsheet/material/driven_rate.h"
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

// Of one that the pressure acts on, from when it is there.
std::optional<double> blow_up_time_of(const scene::SheetTable& sheet, const Scene& scene) {
  const auto* thickness = std::get_if<double>(&sheet.thickness);
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

} // namespace

bool is_blown_into_mould(const Scene& scene, const formats::Frame& first) {
  constexpr double farthest = 10, near = 0.01; // sizes of the sheet: from its middle; from a solid
  constexpr int most = 200;                    // steps
  const solid::Solids solids(scene);
  const auto x = positions(first);
  solid::Box3 box;
  for (const Vector3& p : x)
    box.extend(p);
  const double size = box.diagonal().norm();
  const std::vector<std::size_t> probes = probes_of(first);
  const auto meets_solid = [&](std::size_t v) {
    const Vector3 out = (x[v] - box.center()).normalized();
    Vector3 place = x[v];
    for (int i = 0; i < most && (place - box.center()).norm() < farthest * size; ++i) {
      double distance = farthest * size;
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
