// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/stop_condition.h"

#include <array>
#include <cmath>

#include <fmt/ranges.h>

#include "libsheet/base/error.h"
#include "libsheet/base/units.h"
#include "libsheet/measure/figures.h"

namespace sheet {

namespace {

constexpr std::array counts{"vertices", "triangles"};

// What figures are given in; others take numbers alone.
constexpr std::array given{quantity::length,
                           Quantity{"an area", {0, 2, 0}, "m^2", "2 cm^2"},
                           quantity::volume,
                           Quantity{"an energy", {1, 2, -2}, "J", "0.1 J"},
                           Quantity{"a momentum", {1, 1, -1}, "kg m/s", "0.1 kg*m/s"},
                           Quantity{"an angular momentum", {1, 2, -1}, "kg m^2/s", "0.1 kg*m^2/s"}};

// Of a column; nothing if there is none of this name.
std::optional<std::string> unit_of(const std::string& name) {
  for (const char* count : counts)
    if (name == count)
      return "1";
  for (const Figure& figure : figures())
    for (const std::string& column : figure.columns())
      if (column == name)
        return figure.unit;
  return std::nullopt;
}

std::string without_blanks(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end - begin + 1));
}

double read_bound(const std::string& text, const std::string& unit) {
  Quantity expected = quantity::number;
  for (const Quantity& quantity : given)
    if (unit == quantity.unit)
      expected = quantity;
  std::string problem;
  const std::optional<double> bound = read_quantity(text, expected, problem);
  if (!bound)
    fail(ExitCode::usage, "--stop-when: {}", problem);
  return *bound;
}

} // namespace

StopCondition::StopCondition(const std::string& text) {
  const std::size_t at = text.find_first_of("<>");
  if (at == std::string::npos)
    fail(ExitCode::usage, "--stop-when: \"{}\" is no condition such as \"y_max > 40 mm\"", text);
  comparison_ = text.substr(at, text.size() > at + 1 && text[at + 1] == '=' ? 2 : 1);
  name_ = without_blanks(std::string_view(text).substr(0, at));
  const std::optional<std::string> unit = unit_of(name_);
  if (!unit)
    fail(ExitCode::usage, "--stop-when: \"{}\" is not measured; what is: {}", name_, fmt::join(names(), ", "));
  unit_ = *unit;
  bound_ = read_bound(without_blanks(std::string_view(text).substr(at + comparison_.size())), unit_);
}

std::vector<std::string> StopCondition::names() {
  std::vector<std::string> names(counts.begin(), counts.end());
  for (const Figure& figure : figures())
    for (const std::string& column : figure.columns())
      names.push_back(column);
  return names;
}

std::optional<std::string> StopCondition::holds(const formats::Frame& frame) {
  const double value = value_in(frame);
  if (std::isnan(value))
    fail(ExitCode::usage,
         "--stop-when: {} is not known of the frame at step {}: its scene does not state what it needs", name_,
         frame.step);
  const bool beyond = comparison_[0] == '<' ? value < bound_ : value > bound_;
  if (!beyond && !(comparison_.size() == 2 && value == bound_))
    return std::nullopt;
  return fmt::format("{} is {:.6g}{}", name_, value, unit_ == "1" ? "" : " " + unit_);
}

double StopCondition::value_in(const formats::Frame& frame) {
  if (name_ == counts[0])
    return static_cast<double>(frame.vertices);
  if (name_ == counts[1])
    return static_cast<double>(frame.triangles);
  Measurements measured = measure(frame, density_.of(frame));
  if (const Scene* scene = scenes_.find(frame))
    measure_energies(frame, *scene, measured);
  for (const Figure& figure : figures()) {
    const std::vector<std::string> columns = figure.columns();
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] == name_)
        return figure.values(measured)[i];
  }
  return absent;
}

} // namespace sheet
