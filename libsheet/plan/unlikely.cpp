// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/unlikely.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "libsheet/geometry/types.h"
#include "libsheet/scene/inlet_velocity.h"

namespace sheet {

namespace {

constexpr double lightest = 10, heaviest = 25'000; // foam has 20, osmium 22,600 [kg/m³]
constexpr double tightest = 3;                     // tungsten has 2.5 [N/m]
constexpr double strongest = 100;                  // gravity, ten times that of the Earth [m/s²]
constexpr double fastest = 50;                     // [m/s]
constexpr double thickest = 2;                     // flow index

// Of a plane whose surface is to move out of it, of which only what is along it counts; "" of another.
std::string surface_out_of_plane(const scene::Solid& solid, std::size_t number) {
  constexpr double least = 0.9; // of the velocity, along the plane
  const auto* plane = std::get_if<scene::HalfSpace>(&solid.shape);
  if (plane == nullptr || solid.surface_velocity.isZero())
    return "";
  const Vector3& v = solid.surface_velocity;
  const Vector3 normal = plane->normal.normalized(), along = v - v.dot(normal) * normal;
  if (along.norm() > least * v.norm())
    return "";
  return fmt::format(
      "solid {} (plane) has a surface_velocity of which only {:.3g} of {:.3g} m/s are along it, and those "
      "alone count: a belt moves in its plane, here across ({:.3g}, {:.3g}, {:.3g})",
      number, along.norm(), v.norm(), normal.x(), normal.y(), normal.z());
}

} // namespace

std::vector<std::string> unlikely_values(const Scene& scene) {
  std::vector<std::string> found;
  const auto tell = [&](const std::string& what) {
    if (std::ranges::find(found, what) == found.end())
      found.push_back(what);
  };
  const auto tell_of_density = [&](double density, std::string_view whose) {
    if (density > 0 && density < lightest)
      tell(fmt::format("a density{} of {:.3g} kg/m^3 is less than that of any liquid: if it is in g/cm^3, write "
                       "\"{:.3g} g/cm^3\"",
                       whose, density, density));
    if (density > heaviest)
      tell(fmt::format("a density{} of {:.3g} kg/m^3 is more than that of any matter on Earth: water has 1000 kg/m^3, "
                       "which is 1 g/cm^3",
                       whose, density));
  };
  if (scene.environment.bath)
    tell_of_density(scene.environment.bath->density, " of the bath");
  for (const scene::SheetTable& sheet : scene.sheets) {
    const Liquid liquid = scene::with_material_of(scene, sheet).material;
    tell_of_density(liquid.density, "");
    if (liquid.surface_tension > tightest)
      tell(fmt::format("a surface tension of {:.3g} N/m is more than that of any liquid: water has 0.072 N/m, which is "
                       "72 mN/m",
                       liquid.surface_tension));
    if (const double index = liquid.law.flow_index; index >= thickest)
      tell(
          fmt::format("a flow_index of {:.3g} thickens: stress grows as the rate to that power. By Glen's law the rate "
                      "grows as stress to the power n, and flow_index is 1/n, here {:.4g}",
                      index, 1 / index));
    if (const double speed = sheet.velocity.norm(); speed > fastest)
      tell(fmt::format("a sheet that starts with {:.3g} m/s: if that is in mm/s, write \"{:.3g} mm/s\"", speed, speed));
  }
  if (constexpr double densest = 100; scene.environment.air && scene.environment.air->density > densest)
    tell(fmt::format("air of {:.3g} kg/m^3: that around us has 1.2 kg/m^3; a liquid below the sheet is a bath",
                     scene.environment.air->density));
  if (const double gravity = scene.environment.gravity.value_or(Vector3::Zero()).norm(); gravity > strongest)
    tell(fmt::format("a gravity of {:.3g} m/s^2 is {:.4g} times that of the Earth, 9.81 m/s^2", gravity,
                     gravity / 9.81));
  for (const scene::Inflow& inflow : scene.inflows)
    if (const double speed = scene::inlet_velocity(scene, inflow).speed(0); speed > fastest)
      tell(fmt::format("an inflow of {:.3g} m/s: if that is in mm/s, write \"{:.3g} mm/s\"", speed, speed));
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (const std::string out = surface_out_of_plane(scene.solids[i], i); !out.empty())
      tell(out);
  return found;
}

} // namespace sheet
