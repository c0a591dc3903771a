// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/scales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libsheet/base/overloaded.h"
#include "libsheet/material/driven_rate.h"
#include "libsheet/material/flow_curve.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"

namespace sheet::scene {
namespace {

double curvature_of(const SheetShape& shape) {
  return std::visit(Overloaded{[](const Sphere& s) { return 1 / s.radius; }, [](const Cap& s) { return 1 / s.radius; },
                               [](const Tube& s) { return 1 / s.radius; }, [](const auto&) { return 0.0; }},
                    shape);
}

double stated(const Pressure& pressure) {
  return std::visit(Overloaded{[](const ConstantPressure& p) { return std::abs(p.value); },
                               [](const InverseSquarePressure& p) { return std::abs(p.value); },
                               [](const DrainingPressure&) { return 0.0; },
                               [](const GasPressure& p) { return std::abs(p.value); }},
                    pressure);
}

void offer(Scales& scales, double speed, std::string_view source) {
  if (!std::isfinite(speed) || speed <= scales.speed)
    return;
  scales.speed = speed;
  scales.speed_source = source;
}

void offer(Scales& scales, const Motion& motion, std::string_view source) {
  constexpr double ever = std::numeric_limits<double>::max();
  const MotionBounds most = bounds(motion, -ever, ever);
  offer(scales, most.speed + most.turning * scales.length.value_or(0), source);
}

// The speed that gravity gives without drag on a way of the sheet's length, with inertia [m/s].
double freely(const Scene& scene, const Scales& scales) {
  return scene.model.inertia && scene.material.density > 0 ? std::sqrt(2 * scales.gravity * scales.length.value_or(0))
                                                           : std::numeric_limits<double>::infinity();
}

void offer_forces(Scales& scales, const Scene& scene) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const double density = scene.material.density;
  const double tension = scene.material.surface_tension;
  const double L = scales.length.value_or(0), h = scales.thickness.value_or(0);
  const bool inertia = scene.model.inertia && density > 0;
  const auto least = [&](double stress, double borne, double inertial) {
    const double viscous = scene.material.viscous() ? L * stretching_rate(scene.material, stress, borne) : unlimited;
    return std::min(viscous, inertia ? inertial : unlimited);
  };
  if (L <= 0)
    return;
  if (!scene.environment.bath && !scales.lies)
    offer(scales, least(density * scales.gravity * L, std::numbers::sqrt3, std::sqrt(scales.gravity * L)), "gravity");
  if (h <= 0)
    return;
  offer(scales, least(2 * tension / h, 2, std::sqrt(2 * tension / (density * h))), "surface tension");
  const bool free = scene.holds.empty() && scene.inflows.empty(); // wind takes it along, however viscous it is
  const auto& bath = scene.environment.bath;
  const bool floats = bath && scales.above_bath == 0; // then wind rubs on its upper face
  if (const auto& air = scene.environment.air)
    for (const auto& entry : air->wind.entries) {
      const double drag = floats ? air->friction_coefficient / 2 : air->drag_coefficient;
      const double force = drag * air->density * entry.value.squaredNorm() / 2, stress = force * L / h;
      const double sliding = floats && bath->drag > 0 ? force / bath->drag : unlimited;
      const double flying = std::min(sliding, inertia ? std::sqrt(stress / density) : unlimited);
      offer(scales, std::min(entry.value.norm(), free ? flying : least(stress, 2, flying)), "wind");
    }
  offer(scales, least(scales.pressure * L / h, 2, std::sqrt(scales.pressure * L / (density * h))), "pressure");
}

} // namespace

Scales scales_of(const Scene& scene, const SheetTable& sheet, const Measured& measured) {
  Scales scales;
  const auto size = size_of(sheet.shape);
  const auto* uniform = std::get_if<double>(&sheet.thickness);
  scales.length = size ? std::optional(size->length) : measured.length;
  scales.thickness = uniform ? std::optional(*uniform) : measured.thickness;
  scales.curvature = size ? curvature_of(sheet.shape) : measured.curvature.value_or(0);
  scales.along = measured.along;
  scales.lies = measured.lies;
  scales.above_bath = measured.above_bath;
  if (scene.environment.gravity)
    scales.gravity = scene.environment.gravity->norm();
  if (scene.environment.pressure)
    scales.pressure = stated(*scene.environment.pressure);

  for (const Inflow& inflow : scene.inflows) {
    const InletVelocity velocity = inlet_velocity(scene, inflow);
    for (const double time : velocity.times())
      offer(scales, velocity.speed(time), "inflow");
  }
  for (const SheetTable& each : scene.sheets) {
    offer(scales, std::hypot(each.velocity.norm(), each.radial_velocity), "the sheet's velocity at the start");
    offer(scales, each.angular_velocity.norm() * scales.length.value_or(0), "the sheet's turning at the start");
  }
  for (const Hold& hold : scene.holds)
    offer(scales, hold.motion, "a moving hold");
  for (const Solid& solid : scene.solids) {
    offer(scales, solid.motion, "a moving solid");
    offer(scales, solid.surface_velocity.norm(), "a belt");
  }
  offer_forces(scales, scene);
  if (const auto layer = scales.lies ? layer_scales_of(scene, scales) : std::nullopt)
    offer(scales, std::min(layer->speed, freely(scene, scales)), "its weight on the solid");
  const auto rate = scales.rate();
  scales.viscosity = rate ? viscosity_of(scene.material, {*rate * *rate}) : scene.material.viscosity;
  return scales;
}

std::vector<Scales> scales_of_sheets(const Scene& scene, std::span<const Measured> measured) {
  std::vector<Scales> scales;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    scales.push_back(scales_of(with_material_of(scene, scene.sheets[i]), scene.sheets[i],
                               measured.empty() ? Measured{} : measured[i]));
  return scales;
}

} // namespace sheet::scene
