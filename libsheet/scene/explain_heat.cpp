// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/explain_heat.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "libsheet/material/shifted_liquid.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr double stefan_boltzmann = 5.670374419e-8; // [W/(m² K⁴)]
constexpr double hardly_moves = 1e12;               // [Pa s]: strained by its weight a part of 1e-8 a second

double start_temperature(const Scene& scene) {
  const auto& own = scene.sheets.front().temperature;
  const double* uniform = own ? std::get_if<double>(&*own) : nullptr;
  return uniform != nullptr ? *uniform : scene.heat->temperature;
}

// What goes through a square metre of both faces at most, by the difference from the temperature t to that around,
// which radiates as it is [W/(m² K)].
double mean_slope(const Heat& heat, double t, double around) {
  const double radiated = stefan_boltzmann * (t * t + around * around) * (t + around);
  const auto of = [&](const HeatedFace& face) { return range_of(face.transfer).second + face.emissivity * radiated; };
  return of(heat.upper) + of(heat.lower);
}

// How what leaves through both rises with the temperature [W/(m² K)], at most.
double loss_slope(const Heat& heat, double t) { return mean_slope(heat, t, t); }

// The temperatures between which anything around, or its start, may bring the sheet.
std::pair<double, double> temperatures_around(const Scene& scene) {
  double least = start_temperature(scene), most = least;
  const auto include = [&](const Varying& around) {
    const auto [low, high] = range_of(around);
    least = std::min(least, low);
    most = std::max(most, high);
  };
  for (const HeatedFace* face : {&scene.heat->upper, &scene.heat->lower}) {
    if (face->transfers())
      include(face->ambient);
    if (face->emissivity > 0)
      include(face->radiant);
  }
  for (const Solid& solid : scene.solids)
    if (solid.temperature)
      include(*solid.temperature);
  return {least, most};
}

double biot_number(const Scene& scene, double thickness) {
  return loss_slope(*scene.heat, start_temperature(scene)) / 2 * thickness / (2 * scene.heat->conductivity);
}

// By which solids heat or cool what touches them, at most [W/(m² K)]; 0: none does.
double contact_slope(const Scene& scene) {
  double most = 0;
  for (const Solid& solid : scene.solids)
    if (solid.temperature)
      most = std::max(most, solid.contact_conductance);
  return most;
}

// A solid heats one face alone, so the other one is all of the thickness away.
double biot_number_on_solids(const Scene& scene, double thickness) {
  return contact_slope(scene) * thickness / scene.heat->conductivity;
}

DimensionlessNumber viscosity_range(const Scene& scene) {
  const Liquid& liquid = scene.material;
  const double start = start_temperature(scene);
  const auto [cold, warm] = temperatures_around(scene);
  const ViscosityShift shift(liquid.temperature_law);
  const double first = liquid.viscosity * shift.factor(start), last = liquid.viscosity * shift.factor(cold);
  std::string meaning = fmt::format("From {} Pa s at {} K to {} Pa s at {} K, the coldest that is around.",
                                    brief(first), brief(start), brief(last), brief(cold));
  if (last > hardly_moves)
    meaning +=
        fmt::format(" Below {} K it has {} Pa s and will hardly move.",
                    brief(shift.temperature_of(hardly_moves / liquid.viscosity, cold, warm)), brief(hardly_moves));
  if (warm > start)
    meaning +=
        fmt::format(" At {} K, the warmest, {} Pa s.", brief(warm), brief(liquid.viscosity * shift.factor(warm)));
  return {"range of viscosity", "mu(coldest) / mu(start)", last / first, meaning};
}

// The scene with the liquids that its own are at that temperature [K].
Scene as_at(const Scene& scene, double temperature) {
  Scene result = scene;
  result.material = at_temperature(scene.material, temperature);
  for (SheetTable& sheet : result.sheets)
    if (sheet.material)
      sheet.material = at_temperature(*sheet.material, temperature);
  return result;
}

// What may bring heat to the sheet.
struct Source {
  Varying temperature; // [K]
  double transfer;     // at most [W/(m² K)]
};

std::vector<Source> sources_of_heat(const Scene& scene) {
  std::vector<Source> sources;
  const auto add = [&](const Varying& temperature) {
    sources.push_back({temperature, mean_slope(*scene.heat, start_temperature(scene), range_of(temperature).second)});
  };
  for (const HeatedFace* face : {&scene.heat->upper, &scene.heat->lower}) {
    if (face->transfers())
      add(face->ambient);
    if (face->emissivity > 0)
      add(face->radiant);
  }
  for (const Solid& solid : scene.solids)
    if (solid.temperature && solid.contact_conductance > 0)
      sources.push_back({*solid.temperature, solid.contact_conductance});
  return sources;
}

// The time from which on it is at its greatest [s].
double time_of_greatest(const Varying& varying) {
  const auto* timed = std::get_if<Timed<double>>(&varying.over);
  return timed != nullptr ? std::ranges::max_element(timed->entries, {}, &Timed<double>::Entry::value)->time : 0;
}

} // namespace

Scene as_it_starts(const Scene& scene) { return scene.heat ? as_at(scene, start_temperature(scene)) : scene; }

double change_of_viscosity(const Scene& scene, double time, double until) {
  const double start = start_temperature(scene), near = -std::expm1(-until / time);
  const auto [cold, warm] = temperatures_around(scene);
  double most = 0; // of its logarithm
  for (const Liquid& liquid : liquids_of(scene)) {
    const ViscosityShift shift(liquid.temperature_law);
    for (const double around : {cold, warm})
      most = std::max(most, std::abs(std::log(shift.factor(start + near * (around - start)) / shift.factor(start))));
  }
  return std::exp(most);
}

std::optional<double> setting_time(const Scene& scene, double thickness) {
  constexpr double set = 1000; // times the viscosity
  const bool later = !scene.inflows.empty() || std::ranges::any_of(scene.sheets, [](const SheetTable& sheet) {
    return sheet.enters.has_value();
  });
  if (!scene.heat || later || !(temperatures_around(scene).second <= start_temperature(scene)))
    return {};
  const double start = start_temperature(scene);
  double slope = 0, sum = 0; // of both faces [W/(m² K)]; weighted with what is around
  bool even = true;
  const auto add = [&](double least, const Varying& around) {
    const auto [low, high] = range_of(around);
    even = even && low == high;
    slope += least;
    sum += least * high;
  };
  for (const HeatedFace* face : {&scene.heat->upper, &scene.heat->lower}) {
    if (face->transfers())
      add(range_of(face->transfer).first, face->ambient);
    if (const double cold = range_of(face->radiant).second; face->emissivity > 0)
      add(face->emissivity * stefan_boltzmann * (start * start + cold * cold) * (start + cold), face->radiant);
  }
  double solid = 0; // the temperature at which the last of the liquids has set [K]
  for (const Liquid& liquid : liquids_of(scene)) {
    const ViscosityShift shift(liquid.temperature_law);
    const double cold = slope > 0 ? sum / slope : start;
    if (!even || liquid.temperature_law.constant() || !(shift.factor(cold) > set * shift.factor(start)))
      return {};
    const double sets = shift.temperature_of(set * shift.factor(start), cold, start);
    solid = solid == 0 ? sets : std::min(solid, sets);
  }
  const double around = sum / slope, capacity = scene.material.density * scene.heat->specific_heat;
  return capacity * thickness / slope * std::log((start - around) / (solid - around));
}

std::optional<Warming> warming_of(const Scene& scene, double thickness) {
  constexpr double near = 3; // times of warming: but for a twentieth
  if (!scene.heat ||
      std::ranges::all_of(liquids_of(scene), [](const Liquid& l) { return l.temperature_law.constant(); }))
    return {};
  const double start = start_temperature(scene), capacity = scene.material.density * scene.heat->specific_heat;
  double warmest = start, time = 0;
  for (const Source& source : sources_of_heat(scene)) {
    const double warm = range_of(source.temperature).second;
    if (!(warm > start))
      continue;
    warmest = std::max(warmest, warm);
    time = std::max(time, time_of_greatest(source.temperature) + near * capacity * thickness / source.transfer);
  }
  return warmest > start ? std::optional(Warming{as_at(scene, warmest), time}) : std::nullopt;
}

std::vector<double> heat_events(const Scene& scene) {
  std::vector<double> events;
  const auto add = [&](const Varying& varying) {
    if (const auto* timed = std::get_if<Timed<double>>(&varying.over))
      for (const auto& entry : timed->entries)
        events.push_back(entry.time);
  };
  if (scene.heat)
    for (const HeatedFace* face : {&scene.heat->upper, &scene.heat->lower})
      for (const Varying* varying : {&face->ambient, &face->transfer, &face->radiant})
        add(*varying);
  for (const Solid& solid : scene.solids)
    if (solid.temperature)
      add(*solid.temperature);
  return events;
}

std::vector<Scale> heat_scales(const Scene& scene, const Scales& scales) {
  if (!scene.heat || !scales.thickness)
    return {};
  const double t = start_temperature(scene), c = scene.material.density * scene.heat->specific_heat;
  const double slope = loss_slope(*scene.heat, t);
  std::vector<Scale> list;
  if (slope > 0)
    list.push_back({"t_h", "time of cooling", c * *scales.thickness / slope, "s",
                    "rho c h / (H + 4 emissivity sigma T^3) of both faces"});
  if (const double contact = contact_slope(scene); contact > 0)
    list.push_back({"t_s", "time in which solids cool or heat it", c * *scales.thickness / contact, "s",
                    "rho c h / contact_conductance"});
  return list;
}

std::vector<DimensionlessNumber> heat_numbers(const Scene& scene, const Scales& scales) {
  std::vector<DimensionlessNumber> list;
  if (!scene.heat)
    return list;
  const double t = start_temperature(scene), k = scene.heat->conductivity;
  if (!scene.material.temperature_law.constant())
    list.push_back(viscosity_range(scene));
  if (k > 0 && scales.thickness) {
    const double biot = biot_number(scene, *scales.thickness);
    list.push_back({"Biot", "H h / (2 k)", biot,
                    biot < 0.1 ? "It is as warm across its thickness as in the middle."
                    : biot < 1 ? "Its faces are colder than its middle; a parabola across the thickness takes that up."
                    : scene.heat->profile
                        ? "Its faces cool long before its middle, which its modes across the thickness follow."
                        : "Its faces cool long before its middle, which a parabola does not follow: profile = 3 in "
                          "[heat] gives it modes across the thickness."});
    if (const double on_solids = biot_number_on_solids(scene, *scales.thickness); on_solids > 0)
      list.push_back({"Biot on solids", "contact_conductance h / k", on_solids,
                      on_solids < 0.2 ? "It is as warm at a solid as at the face that does not touch."
                      : on_solids < 1 ? "What touches is nearer to the solid's temperature; a parabola takes that up."
                      : scene.heat->profile
                          ? "What touches has the solid's temperature long before the rest, which its modes follow."
                          : "What touches has the solid's temperature long before the rest, which a parabola does not "
                            "follow: profile = 3 in [heat] gives it modes across the thickness."});
  }
  if (k > 0 && scales.length && scales.speed > 0) {
    const double peclet = scene.material.density * scene.heat->specific_heat * scales.speed * *scales.length / k;
    list.push_back({"Peclet", "rho c V L / k", peclet,
                    peclet > 10 ? "Liquid carries its heat along; hardly any is conducted along the sheet."
                                : "Heat is conducted along the sheet while it flows."});
  }
  if (scene.heat->viscous_heating && k > 0 && scales.speed > 0 && !scene.material.temperature_law.constant()) {
    const double slope = -ViscosityShift(scene.material.temperature_law).at(t).log_slope;
    const double nahme = slope * scales.viscosity * scales.speed * scales.speed / k;
    list.push_back({"Nahme", "(-d ln mu / dT) mu V^2 / k", nahme,
                    nahme < 0.1 ? "What viscosity dissipates hardly warms it."
                                : "What viscosity dissipates makes it flow more easily where it flows most."});
  }
  return list;
}

std::optional<std::string> warning_of_biot(const Scene& scene, const Scales& scales) {
  if (!scene.heat || !(scene.heat->conductivity > 0) || scene.heat->profile || !scales.thickness)
    return {};
  if (const double biot = biot_number(scene, *scales.thickness); biot > 1)
    return fmt::format("the Biot number is {}: its faces cool long before its middle, which the parabola across the "
                       "thickness does not follow, so all of it cools and stiffens too soon: profile = 3 in [heat] "
                       "gives it modes of its own, as in the ring below",
                       brief(biot));
  if (const double biot = biot_number_on_solids(scene, *scales.thickness); biot > 1)
    return fmt::format("the Biot number on solids is {}: what touches them has their temperature long before the rest, "
                       "which the parabola across the thickness does not follow, so all of it flows by their "
                       "temperature too soon: profile = 3 in [heat] gives it modes of its own, as in the ring below",
                       brief(biot));
  return {};
}

std::optional<std::string> warning_of_thinning(const Scene& scene) {
  constexpr double of_water = 1e-3, viscous = 1; // [Pa s]
  if (!scene.heat || scene.material.temperature_law.constant())
    return {};
  const ViscosityShift shift(scene.material.temperature_law);
  const double start = start_temperature(scene), warm = temperatures_around(scene).second,
               thinnest = scene.material.viscosity * shift.factor(warm);
  if (!(thinnest < of_water) || scene.material.viscosity * shift.factor(start) < viscous)
    return {};
  return fmt::format(
      "at {} K, the warmest around, the liquid would have {} Pa s, less than water: its viscosity_law goes "
      "far beyond where it is known; viscosity_law = \"table\" stays what it is beyond its rows",
      brief(warm), brief(thinnest));
}

std::string heat_in_words(const Scene& scene) {
  const Heat& heat = *scene.heat;
  std::string text = fmt::format("from {} K", brief(start_temperature(scene)));
  const auto face = [](const HeatedFace& f) {
    return f.transfers() && f.emissivity > 0 ? "by air and radiation" : f.transfers() ? "by air" : "by radiation";
  };
  if (heat.upper.exchanges() && heat.upper == heat.lower)
    text += fmt::format(", both faces cool {}", face(heat.upper));
  else
    for (const bool upper : {true, false})
      if (const HeatedFace& f = upper ? heat.upper : heat.lower; f.exchanges())
        text += fmt::format(", the {} face cools {}", upper ? "upper" : "lower", face(f));
  if (std::ranges::any_of(scene.solids, [](const Solid& solid) { return solid.temperature.has_value(); }))
    text += ", solids take heat";
  if (heat.conductivity > 0)
    text += ", heat spreads along the sheet";
  if (heat.viscous_heating)
    text += ", viscosity heats";
  const auto law = static_cast<std::size_t>(scene.material.temperature_law.kind);
  return text + (law == 0 ? "; viscosity does not change with it"
                          : fmt::format("; viscosity by {}", words::temperature_laws[law]));
}

} // namespace sheet::scene
