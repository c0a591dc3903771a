// SPDX-License-Identifier: GPL-3.0-or-later
// [material], [environment], [model]
#include "libsheet/scene/read_flow_law.h"
#include "libsheet/scene/read_temperature_law.h"
#include "libsheet/scene/tables.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr double standard_atmosphere = 101325; // [Pa]

GasPressure read_gas(TableReader& table) {
  GasPressure gas{};
  gas.amount = table.quantity("amount", Bound::positive);
  const auto value = table.quantity("value", Bound::any);
  if (gas.amount && value)
    table.wrong("value", "either the amount of the gas is given, or its pressure at the start");
  else if (!gas.amount && !value)
    table.missing("value", "\"10 Pa\" (pressure at the start), or amount = \"1 l\"");
  gas.value = value.value_or(0);
  gas.ambient = table.quantity_or("ambient", standard_atmosphere, Bound::positive);
  if (gas.value <= -gas.ambient)
    table.wrong("value", "gas cannot have less than no pressure: give more than -ambient");
  gas.exponent = table.quantity_or("exponent", 1);
  if (gas.exponent < 1)
    table.wrong("exponent", "a polytropic exponent is at least 1 (constant temperature)");
  gas.leak = table.quantity_or("leak", 0, Bound::not_negative);
  gas.more_volume = table.quantity_or("more_volume", 0, Bound::not_negative);
  return gas;
}

// `sheet`: on which it acts.
std::optional<Pressure> read_pressure(TableReader& parent, std::string& sheet) {
  auto table = parent.table("pressure");
  if (!table)
    return {};
  if (table->absent("law"))
    table->missing("law", "\"constant\"");
  const auto law = table->choice("law");
  sheet = table->text("sheet").value_or("");
  std::optional<Pressure> result;
  std::string because = "the law is not known";
  if (law == 0) {
    result = ConstantPressure{table->required("value", Bound::any)};
    because = "law \"constant\" takes value";
  } else if (law == 1) {
    const double value = table->required("value", Bound::any);
    result = InverseSquarePressure{value, table->required("reference_radius")};
    because = "law \"inverse_square\" takes value, reference_radius";
  } else if (law == 2) {
    result = DrainingPressure{table->required("conductance")};
    because = "law \"draining\" takes conductance";
  } else if (law == 3) {
    result = read_gas(*table);
    because = "law \"gas\" takes value or amount, ambient, exponent, leak, more_volume";
  }
  table->has_no_meaning(
      {"value", "reference_radius", "conductance", "amount", "ambient", "exponent", "leak", "more_volume"}, because);
  table->finish();
  return result;
}

} // namespace

Liquid read_material(TableReader table, const Files& files) {
  Liquid material;
  read_temperature_law(table, files, material);
  read_flow_law(table, files, material);
  material.density = table.quantity_or("density", 0, Bound::positive);
  material.surface_tension = table.quantity_or("surface_tension", 0, Bound::not_negative);
  if (material.surface_tension_slope != 0 && !(material.surface_tension > 0))
    table.missing("surface_tension", "\"0.3 N/m\"");
  table.finish();
  return material;
}

namespace {

Air read_air(TableReader table) {
  Air air;
  air.density = table.required("density", Bound::positive, "\"1.2 kg/m^3\"");
  air.drag_coefficient = table.quantity_or("drag_coefficient", air.drag_coefficient, Bound::not_negative);
  air.friction_coefficient = table.quantity_or("friction_coefficient", air.friction_coefficient, Bound::not_negative);
  air.wind = table.timed_velocity("wind").value_or(Timed<Vector3d>{});
  if (air.drag_coefficient == 0 && air.friction_coefficient == 0)
    table.wrong("drag_coefficient", "with neither drag nor friction air does nothing: leave the table out");
  table.finish();
  return air;
}

} // namespace

Environment read_environment(TableReader table) {
  Environment environment;
  environment.gravity = table.vector("gravity");
  if (environment.gravity && environment.gravity->isZero(0))
    environment.gravity.reset(); // no such term
  environment.pressure = read_pressure(table, environment.pressure_sheet);
  if (auto bath = table.table("bath")) {
    const double density = bath->required("density");
    const double level = bath->quantity_or("level", 0);
    const bool clings = bath->boolean("clings").value_or(false);
    environment.bath = BathLiquid{density, level, clings, bath->boolean("spreads").value_or(!clings),
                                  bath->quantity_or("drag", 0, Bound::not_negative)};
    bath->finish();
  }
  if (auto air = table.table("air"))
    environment.air = read_air(std::move(*air));
  table.finish();
  return environment;
}

Model read_model(TableReader table) {
  Model model;
  model.inertia = table.boolean("inertia").value_or(true);
  model.bending = table.boolean("bending").value_or(true);
  model.forces = table.boolean("forces").value_or(false);
  model.faces = table.boolean("faces").value_or(false);
  table.finish();
  return model;
}

} // namespace sheet::scene
