// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/blow_up.h"

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

} // namespace

std::optional<double> blow_up_time(const Scene& scene) {
  const auto& environment = scene.environment;
  if (!environment.pressure)
    return {};
  const scene::SheetTable& sheet = sheet_named(scene, environment.pressure_sheet);
  const auto* thickness = std::get_if<double>(&sheet.thickness);
  const auto* sphere = std::get_if<scene::Sphere>(&sheet.shape);
  const auto* cap = std::get_if<scene::Cap>(&sheet.shape);
  const auto* tube = std::get_if<scene::Tube>(&sheet.shape);
  if (thickness == nullptr || (sphere == nullptr && cap == nullptr && tube == nullptr))
    return {};
  const double radius = sphere != nullptr ? sphere->radius : cap != nullptr ? cap->radius : tube->radius;
  const auto law = pressing(*environment.pressure, radius);
  const double tension = 2 * scene.material.surface_tension * (tube != nullptr ? 1 : 2) / radius;
  if (!law || !(law->value > tension) || (tube != nullptr && law->falls > 0))
    return {};
  // dr/dt = p r^n / c, h having thinned: with it r passes every bound at c / ((n - 1) p r^(n - 1)).
  const double viscous = scene.material.viscosity * *thickness / (law->value * radius);
  return tube != nullptr ? 2 * viscous : 12 / (3 - law->falls) * viscous;
}

} // namespace sheet
