// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/pressure_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "libsheet/base/error.h"
#include "libsheet/base/overloaded.h"
#include "libsheet/geometry/capped_volume.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/gas_holes.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;

// Of an enclosure, from the frame's array of that name; none if it has none.
std::optional<double> of_enclosure(const Frame& frame, std::string_view name, std::size_t number) {
  const auto values = of_enclosures(frame, name);
  return number < values.size() ? std::optional(values[number]) : std::nullopt;
}

// The volume of the gas in the sheet, and what it fills besides [m³].
double room_in(const PressureLaw& law, const Frame& frame, const Connectivity& mesh) {
  return capped_volume(mesh, positions(frame), law.part) + law.gas.more_volume;
}

// The amount of gas in an enclosure: that in the frame where some has escaped, else as the scene says, or as it starts
// it.
double amount_in(const scene::GasPressure& gas, const PressureLaw& law, const Frame& frame, const Connectivity& mesh) {
  const auto amount = of_enclosure(frame, "gas.amount", law.number);
  if (amount && (!gas.amount || of_enclosure(frame, "gas.escaped", law.number).value_or(0) != 0))
    return *amount;
  if (gas.amount)
    return *gas.amount;
  const double volume = room_in(law, frame, mesh);
  if (!(volume > 0))
    fail(ExitCode::bad_input,
         "pressure: piece {} of the sheet (from 0) encloses {:.3g} m^3 on the side that its triangles' normals point "
         "away from, so there is no room for gas: turn it round, or give more_volume",
         law.number, volume);
  return amount_of_gas(law.gas, gas.value, volume);
}

// Arrays get a row for each enclosure up to the last. The first frame has no more than triangles, later ones have rows.
void refuse_unknown(const PressureLaw& law, const Frame& frame) {
  const std::size_t known = std::max(frame.triangles, of_enclosures(frame, "gas.amount").size());
  if (law.number >= known)
    fail(ExitCode::bad_input, "array \"enclosure\": there is no enclosure {}, as the frame has at most {} of them",
         law.number + 1, known);
}

// The area of the middle section of the ball that holds as much [m²].
double section(double volume) {
  const double r = std::cbrt(3 * std::max(0.0, volume) / (4 * std::numbers::pi));
  return std::numbers::pi * r * r;
}

// Density times gravity [Pa/m].
double weight_of_bath(const Scene& scene) {
  const scene::Environment& around = scene.environment;
  return around.bath && around.gravity ? around.bath->density * around.gravity->norm() : 0;
}

// What the holes leave of the gas and of what encloses it. While there are holes, and in the step after, pressure goes
// on as it was though caps and pieces are others than before: what volume is gained or lost by that has this pressure.
void add_holes(const Scene& scene, const Frame& frame, const Connectivity& mesh, const RimClearances& rims,
               PressureLaw& law) {
  const auto x = positions(frame);
  const double pressure = of_enclosure(frame, "gas.pressure", law.number).value_or(0);
  const auto clearances = clearances_at(rims, mesh, x, law.part, weight_of_bath(scene), pressure);
  GasHoles holes = gas_holes(mesh, x, clearances, law.part);
  const double before = of_enclosure(frame, "gas.amount", law.number).value_or(law.gas.amount);
  const bool had_holes = of_enclosure(frame, "gas.hole_area", law.number).value_or(0) > 0 || before == 0;
  if (holes.area == 0 && !had_holes)
    return;
  Gas start{.escaped = of_enclosure(frame, "gas.escaped", law.number).value_or(0)};
  start.pressure = of_enclosure(frame, "gas.pressure", law.number)
                       .value_or(gas_in(law.gas, room_in(law, frame, mesh), law.gas.amount, 0).pressure);
  if (holes.area > 0) {
    law.part = still_enclosing(mesh, x, clearances, law.part);
    holes = gas_holes(mesh, x, clearances, law.part);
  }
  const double volume = room_in(law, frame, mesh);
  law.gas.hole = holes.area;
  law.hole_place = holes.place;
  law.gas.open = !(volume > 0) || holes.area >= section(volume - law.gas.more_volume);
  start.amount = law.gas.open ? std::max(0.0, volume) : amount_of_gas(law.gas, start.pressure, volume);
  start.escaped += before - start.amount;
  law.gas.amount = start.amount;
  law.gas_at_start = start;
}

} // namespace

PressureLaw pressure_law(const scene::Environment& environment) {
  const scene::Pressure& pressure = *environment.pressure;
  PressureLaw law;
  std::visit(Overloaded{[&](const scene::ConstantPressure& p) { law.value = p.value; },
                        [&](const scene::InverseSquarePressure& p) {
                          law.kind = PressureLaw::Kind::inverse_square;
                          law.value = p.value;
                          law.reference_radius = p.reference_radius;
                        },
                        [&](const scene::DrainingPressure& p) {
                          law.kind = PressureLaw::Kind::draining;
                          law.conductance = p.conductance;
                        },
                        [&](const scene::GasPressure& p) {
                          law.kind = PressureLaw::Kind::gas;
                          law.gas = {.amount = p.amount.value_or(0),
                                     .ambient = p.ambient,
                                     .exponent = p.exponent,
                                     .leak = p.leak,
                                     .more_volume = p.more_volume};
                        }},
             pressure);
  if (environment.air)
    law.gas.outside = environment.air->density;
  return law;
}

std::vector<PressureLaw> pressure_laws(const Scene& scene, const Frame& frame, const Connectivity& mesh,
                                       const solid::Solids* solids) {
  const scene::Pressure& pressure = *scene.environment.pressure;
  const auto* gas = std::get_if<scene::GasPressure>(&pressure);
  const auto numbers = enclosures(frame);
  const RimClearances rims = gas != nullptr ? rim_clearances(scene, frame, mesh, solids) : RimClearances{};
  if (numbers.empty()) {
    if ((depends_on_volume(pressure) && scene.sheets.size() > 1) || !scene.environment.pressure_sheet.empty() ||
        (gas != nullptr && !gas->amount))
      fail(ExitCode::bad_input, "pressure: the frame does not say which triangles enclose what, or how much gas (array "
                                "\"enclosure\", gas.amount): make the first frame with sheet-init");
    PressureLaw law = pressure_law(scene.environment);
    if (gas != nullptr) {
      law.gas.amount = amount_in(*gas, law, frame, mesh);
      add_holes(scene, frame, mesh, rims, law);
    }
    return {std::move(law)};
  }
  std::vector<PressureLaw> laws;
  for (const std::uint32_t number : enclosure_numbers(frame)) {
    PressureLaw law = pressure_law(scene.environment);
    law.number = number - 1;
    for (const std::uint32_t of : numbers)
      law.part.push_back(of == number ? 1 : 0);
    if (gas != nullptr) {
      refuse_unknown(law, frame);
      law.gas.amount = amount_in(*gas, law, frame, mesh);
      add_holes(scene, frame, mesh, rims, law);
    }
    laws.push_back(std::move(law));
  }
  return laws;
}

std::vector<Gas> gas_of(const Frame& frame) {
  const auto amounts = of_enclosures(frame, "gas.amount");
  std::vector<Gas> gas(amounts.size());
  for (std::size_t k = 0; k < gas.size(); ++k) {
    gas[k].amount = amounts[k];
    gas[k].escaped = of_enclosure(frame, "gas.escaped", k).value_or(0);
  }
  return gas;
}

void settle_gas(std::span<const PressureLaw> laws, std::vector<Gas>& gas) {
  for (const PressureLaw& law : laws)
    if (law.gas_at_start) {
      gas.resize(std::max(gas.size(), law.number + 1));
      gas[law.number] = *law.gas_at_start;
    }
}

void put_gas(std::span<const Gas> gas, Frame& frame) {
  const auto put = [&](std::string_view name, std::string_view unit, double Gas::*quantity) {
    Array array = formats::make_array(name, formats::Place::frame, formats::Type::float64, 1, unit,
                                      formats::Transfer::copy, gas.size());
    std::ranges::transform(gas, array.values<double>().begin(), [&](const Gas& g) { return g.*quantity; });
    frame.put(std::move(array));
  };
  if (gas.empty())
    return;
  put("gas.amount", "m^3", &Gas::amount);
  put("gas.pressure", "Pa", &Gas::pressure);
  if (std::ranges::any_of(gas, [](const Gas& g) { return g.escaped != 0; }))
    put("gas.escaped", "m^3", &Gas::escaped);
}

void put_gas_holes(std::span<const PressureLaw> laws, Frame& frame) {
  frame.erase("gas.hole_area");
  frame.erase("gas.hole_place");
  if (std::ranges::none_of(laws, [](const PressureLaw& law) { return law.gas.hole > 0; }))
    return;
  const std::size_t rows = frame.find("gas.amount")->rows;
  Array area = formats::make_array("gas.hole_area", formats::Place::frame, formats::Type::float64, 1, "m^2",
                                   formats::Transfer::copy, rows);
  Array place = formats::make_array("gas.hole_place", formats::Place::frame, formats::Type::float64, 3, "m",
                                    formats::Transfer::copy, rows);
  for (const PressureLaw& law : laws) {
    area.values<double>()[law.number] = law.gas.hole;
    place.values<Vector3>()[law.number] = law.hole_place;
  }
  frame.put(std::move(area));
  frame.put(std::move(place));
}

} // namespace sheet
