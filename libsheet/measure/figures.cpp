// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/figures.h"

#include <numbers>

#include <fmt/format.h>

#include "libsheet/quantities/fields.h"
#include "libsheet/quantities/scaled_unit.h"

namespace sheet {
namespace {

using Form = Figure::Form;
using Values = std::vector<double>;

constexpr double degrees = 180 / std::numbers::pi;

Values vector_values(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Values range_values(const Range& r) { return {r.least, r.mean, r.greatest}; }

std::vector<Figure> make_figures() {
  using M = Measurements;
  using F = Figure;
  std::vector<Figure> all = {
      {"area", "area", "m^2", Form::scalar, [](const M& m, const F&) { return Values{m.area}; }, "area"},
      {"volume", "volume", "m^3", Form::scalar, [](const M& m, const F&) { return Values{m.volume}; }, "volume"},
  };
  for (const Field& field : fields())
    if (field.in_figures)
      all.push_back({std::string(field.name), std::string(field.caption), std::string(field.unit), Form::range,
                     [](const M& m, const F& f) { return range_values(m.fields[f.field].range); },
                     field.needs == Needs::law ? "" : std::string(field.caption), true, false, all.size() - 2,
                     field.needs});
  const std::vector<Figure> others = {
      {"thickness_p", "thickness by area", "m", Form::percentiles,
       [](const M& m, const F&) {
         return Values{m.thickness_percentiles.begin(), m.thickness_percentiles.end()};
       }},
      {"thickness_min_at", "thinnest at", "m", Form::vector,
       [](const M& m, const F&) { return vector_values(m.thinnest_at); }},
      {"thickness_max_at", "thickest at", "m", Form::vector,
       [](const M& m, const F&) { return vector_values(m.thickest_at); }},
      {"part_at_rest", "part at rest", "1", Form::scalar, [](const M& m, const F&) { return Values{m.part_at_rest}; },
       "", true, false, 0, Needs::law},
      {"heat", "heat", "J", Form::scalar, [](const M& m, const F&) { return Values{m.heat}; }, "heat", true, false, 0,
       Needs::heat},
      {"drops", "drops", "1", Form::scalar, [](const M& m, const F&) { return Values{m.drops}; }, "", true, false, 0,
       Needs::drops},
      {"drop_volume", "volume of drops", "m^3", Form::scalar,
       [](const M& m, const F&) { return Values{m.drop_volume}; }, "", true, false, 0, Needs::drops},
      {"gas_pressure", "pressure of gas", "Pa", Form::scalar,
       [](const M& m, const F&) { return Values{m.gas_pressure}; }, "", true, false, 0, Needs::gas},
      {"gas_amount", "gas", "m^3", Form::scalar, [](const M& m, const F&) { return Values{m.gas_amount}; }, "", true,
       false, 0, Needs::gas},
      {"gas_escaped", "gas that escaped", "m^3", Form::scalar,
       [](const M& m, const F&) { return Values{m.gas_escaped}; }, "", true, false, 0, Needs::gas},
      {"kinetic_energy", "kinetic energy", "J", Form::scalar,
       [](const M& m, const F&) { return Values{m.kinetic_energy}; }, "energy", true, true},
      {"gravity_energy", "energy of height", "J", Form::scalar,
       [](const M& m, const F&) { return Values{m.gravity_energy}; }, "energy", false},
      {"surface_energy", "energy of surface", "J", Form::scalar,
       [](const M& m, const F&) { return Values{m.surface_energy}; }, "energy", false},
      {"momentum", "momentum", "kg m/s", Form::vector, [](const M& m, const F&) { return vector_values(m.momentum); },
       "", true, true},
      {"angular_momentum", "angular momentum", "kg m^2/s", Form::vector,
       [](const M& m, const F&) { return vector_values(m.angular_momentum); }, "", true, true},
      {"box", "bounding box", "m", Form::box,
       [](const M& m, const F&) { return Values{m.low[0], m.low[1], m.low[2], m.high[0], m.high[1], m.high[2]}; }},
      {"edge", "edges", "m", Form::range, [](const M& m, const F&) { return range_values(m.edge); }},
      {"angle_degrees", "angles", "degrees", Form::ends,
       [](const M& m, const F&) {
         return Values{m.angle_min * degrees, m.angle_max * degrees};
       }},
      {"aspect_max", "worst aspect", "1", Form::scalar, [](const M& m, const F&) { return Values{m.aspect_max}; }},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::string line_of(std::string_view name, std::string_view where, std::string_view unit, std::string_view caption,
                    std::span<const PaletteStop> stops = {}) {
  std::string units, colours;
  for (const ScaledUnit& scaled : scaled_units(unit))
    units += fmt::format("{}{} {}", units.empty() ? "" : ", ", scaled.name.empty() ? "1" : scaled.name, scaled.size);
  for (const auto& [place, colour] : stops)
    colours += fmt::format("{}{} {} {} {}", colours.empty() ? "" : ", ", place, colour[0], colour[1], colour[2]);
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", name, where, unit, caption, units, colours);
}

// Of one of its columns.
std::string caption_of(const Figure& figure, std::size_t i) {
  switch (figure.form) {
  case Form::range:
    return fmt::format("{} {}", std::array{"least", "mean", "greatest"}[i], figure.caption);
  case Form::percentiles:
    return fmt::format("{} % of the {}", percents[i], figure.caption);
  default:
    return figure.caption;
  }
}

} // namespace

std::vector<std::string> Figure::columns() const {
  switch (form) {
  case Form::scalar:
    break;
  case Form::vector:
    return {name + "_x", name + "_y", name + "_z"};
  case Form::range:
    return {name + "_min", name + "_mean", name + "_max"};
  case Form::percentiles: {
    std::vector<std::string> names;
    for (const int percent : percents)
      names.push_back(fmt::format("{}{}", name, percent));
    return names;
  }
  case Form::ends: // the unit stands last
    return {"angle_min_degrees", "angle_max_degrees"};
  case Form::box:
    return {"x_min", "y_min", "z_min", "x_max", "y_max", "z_max"};
  }
  return {name};
}

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = make_figures();
  return all;
}

std::string list_of_quantities() {
  std::string text;
  for (const Field& field : fields())
    text += line_of(field.name, name_of(field.where), field.unit, field.caption, field.palette.stops);
  for (const Figure& figure : figures()) {
    const std::vector<std::string> columns = figure.columns();
    for (std::size_t i = 0; i < columns.size(); ++i)
      text += line_of(columns[i], "frame", figure.unit, caption_of(figure, i));
  }
  return text;
}

} // namespace sheet
