// SPDX-License-Identifier: MIT
// The standard arrays of version 1 and what their values must obey (formats/sheet.md, section 5).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "formats/cpp/stream_frame.h"

namespace sheet::formats {

namespace {

// As many components as the scene asks for.
constexpr std::uint32_t any_number = 0;

struct Standard {
  std::string_view name;
  Place place;
  Type type;
  std::uint32_t components;
  std::string_view unit;
  Transfer transfer;
  bool required;
};

constexpr std::array standards{
    Standard{"position", Place::vertex, Type::float64, 3, "m", Transfer::interpolate, true},
    Standard{"triangle", Place::triangle, Type::uint32, 3, "1", Transfer::drop, true},
    Standard{"volume", Place::triangle, Type::float64, 1, "m^3", Transfer::conserve, true},
    Standard{"liquid", Place::triangle, Type::uint32, 1, "1", Transfer::copy, false},
    Standard{"sheet", Place::triangle, Type::uint32, 1, "1", Transfer::copy, false},
    Standard{"temperature", Place::triangle, Type::float64, 1, "K", Transfer::mean, false},
    Standard{"temperature_rate", Place::triangle, Type::float64, 1, "K/s", Transfer::mean, false},
    Standard{"temperature_mode", Place::triangle, Type::float64, any_number, "K", Transfer::mean, false},
    Standard{"temperature_mode_rate", Place::triangle, Type::float64, any_number, "K/s", Transfer::mean, false},
    Standard{"velocity", Place::vertex, Type::float64, 3, "m/s", Transfer::interpolate, false},
    Standard{"start_position", Place::vertex, Type::float64, 3, "m", Transfer::drop, false},
    Standard{"start_time", Place::frame, Type::float64, 1, "s", Transfer::copy, false},
    Standard{"hold", Place::vertex, Type::uint64, 1, "1", Transfer::common, false},
    Standard{"hold_force", Place::vertex, Type::float64, 3, "N", Transfer::conserve, false},
    Standard{"touch", Place::vertex, Type::uint64, any_number, "1", Transfer::common, false},
    Standard{"touch_force", Place::vertex, Type::float64, 3, "N", Transfer::conserve, false},
    Standard{"touch_load", Place::vertex, Type::float64, 3, "N", Transfer::conserve, false},
    Standard{"solid_force", Place::frame, Type::float64, 3, "N", Transfer::copy, false},
    Standard{"touch_overshoot", Place::vertex, Type::float64, 3, "m", Transfer::interpolate, false},
    Standard{"touch_overshoot_time", Place::vertex, Type::float64, 1, "s", Transfer::interpolate, false},
    Standard{"inlet", Place::vertex, Type::uint64, 1, "1", Transfer::common, false},
    Standard{"inlet_origin", Place::vertex, Type::float64, 3, "m", Transfer::interpolate, false},
    Standard{"swept_volume", Place::vertex, Type::float64, 1, "m^3", Transfer::conserve, false},
    Standard{"contact_vertex", Place::frame, Type::uint32, 4, "1", Transfer::drop, false},
    Standard{"contact_weight", Place::frame, Type::float64, 4, "1", Transfer::drop, false},
    Standard{"contact_normal", Place::frame, Type::float64, 3, "1", Transfer::drop, false},
    Standard{"contact_rest", Place::frame, Type::float64, 1, "m", Transfer::drop, false},
    Standard{"contact_anchor", Place::frame, Type::float64, 3, "m", Transfer::drop, false},
    Standard{"contact_stiffness", Place::frame, Type::float64, 2, "N/m", Transfer::drop, false},
    Standard{"contact_since", Place::frame, Type::float64, 1, "s", Transfer::drop, false},
    Standard{"drop_position", Place::frame, Type::float64, 3, "m", Transfer::copy, false},
    Standard{"drop_velocity", Place::frame, Type::float64, 3, "m/s", Transfer::copy, false},
    Standard{"drop_volume", Place::frame, Type::float64, 1, "m^3", Transfer::copy, false},
    Standard{"drop_liquid", Place::frame, Type::uint32, 1, "1", Transfer::copy, false},
    Standard{"drop_temperature", Place::frame, Type::float64, 1, "K", Transfer::copy, false},
    Standard{"drop_touch", Place::frame, Type::uint32, 1, "1", Transfer::copy, false},
    Standard{"drop_start_position", Place::frame, Type::float64, 3, "m", Transfer::drop, false},
    Standard{"director_angle", Place::edge, Type::float64, 1, "rad", Transfer::drop, false},
    Standard{"next_output_time", Place::frame, Type::float64, 1, "s", Transfer::copy, false},
    Standard{"step_size", Place::frame, Type::float64, 1, "s", Transfer::copy, false},
    Standard{"health", Place::frame, Type::float64, 12, "1", Transfer::copy, false},
    Standard{"scene", Place::frame, Type::text, 1, "1", Transfer::copy, false},
    Standard{"provenance", Place::frame, Type::text, 1, "1", Transfer::copy, false},
};

const Standard* find_standard(std::string_view name) {
  for (const Standard& s : standards)
    if (s.name == name)
      return &s;
  return nullptr;
}

// The first row with a component that is not finite, or rows if there is none.
std::size_t first_not_finite(std::span<const double> values, std::size_t components) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000; // all of these bits: infinite or NaN
  bool found = false;
  for (const double x : values) // a pass without branches in the usual case
    found |= (std::bit_cast<std::uint64_t>(x) & exponent) == exponent;
  if (!found)
    return values.size() / components;
  const auto at = std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  return static_cast<std::size_t>(at - values.begin()) / components;
}

// The distinct unordered pairs of vertices that are a side of some triangle: sorted by the lower vertex, of each of
// which every higher one counts once.
std::size_t count_edges(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint64_t vertices) {
  const auto each_side = [&](auto&& visit) {
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i)
        visit(std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3]));
  };
  std::vector<std::size_t> start(vertices + 1, 0);
  each_side([&](std::uint32_t low, std::uint32_t) { ++start[low + 1]; });
  for (std::size_t v = 0; v < vertices; ++v)
    start[v + 1] += start[v];
  std::vector<std::uint32_t> highs(3 * triangles.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  each_side([&](std::uint32_t low, std::uint32_t high) { highs[next[low]++] = high; });
  std::size_t count = 0;
  std::vector<std::uint64_t> seen_with(vertices, vertices); // as the higher one, with this lower one last
  for (std::uint64_t v = 0; v < vertices; ++v)
    for (std::size_t i = start[v]; i < start[v + 1]; ++i)
      count += std::exchange(seen_with[highs[i]], v) != v;
  return count;
}

std::string find_triangle_error(const Frame& frame, const Array& array) {
  const auto corners = array.values<std::array<std::uint32_t, 3>>();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& t = corners[i];
    for (const std::uint32_t v : t)
      if (v >= frame.vertices)
        return fmt::format("array \"triangle\": triangle {} names vertex {}, the frame has {}", i, v, frame.vertices);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      return fmt::format("array \"triangle\": triangle {} names vertex {} twice", i, t[0] == t[1] ? t[0] : t[2]);
  }
  return {};
}

// Rows of an array at place frame. The contact arrays go together: whichever is there has as many as contact_vertex;
// those of drops as many as drop_volume. Health and forces of solids have any number.
std::uint64_t rows_wanted(const Frame& frame, const Standard& standard, const Array& array) {
  if (standard.name == "health" || standard.name == "solid_force")
    return array.rows;
  for (const auto& [kind, leader] : {std::pair<std::string_view, std::string_view>{"contact_", "contact_vertex"},
                                     std::pair<std::string_view, std::string_view>{"drop_", "drop_volume"}})
    if (standard.name.starts_with(kind)) {
      const Array* leads = frame.find(leader);
      return leads == nullptr ? 0 : leads->rows;
    }
  return 1;
}

std::string find_contact_error(const Frame& frame, const Array& array) {
  const auto vertices = array.values<std::uint32_t>();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (vertices[i] >= frame.vertices)
      return fmt::format("array \"contact_vertex\": contact {} names vertex {}, the frame has {}", i / 4, vertices[i],
                         frame.vertices);
  for (const std::string_view other :
       {"contact_weight", "contact_normal", "contact_rest", "contact_anchor", "contact_stiffness"})
    if (frame.find(other) == nullptr)
      return fmt::format("array \"{}\" is missing beside \"contact_vertex\"", other);
  return {};
}

// Of a drop there is at least where it is and how large it is.
std::string find_drop_error(const Frame& frame, const Array& array) {
  for (const std::string_view other : {"drop_position", "drop_volume"})
    if (frame.find(other) == nullptr)
      return fmt::format("array \"{}\" is missing beside \"{}\"", other, array.name);
  return {};
}

// The first of these numbers that is not positive, said as `format` says it of its row and value; empty if all are.
std::string find_not_positive(std::span<const double> values, fmt::format_string<std::size_t&, const double&> format) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0))
      return fmt::format(format, i, values[i]);
  return {};
}

// Dates are finite, or -inf.
std::string find_date_error(std::string_view name, std::span<const double> dates) {
  for (std::size_t i = 0; i < dates.size(); ++i)
    if (!(dates[i] < std::numeric_limits<double>::infinity()))
      return fmt::format("array \"{}\": row {} is neither finite nor -inf", name, i);
  return {};
}

std::string find_error(const Frame& frame, const Standard& standard, const Array& array) {
  const std::uint32_t components = standard.components == any_number ? array.components : standard.components;
  if (array.place != standard.place || array.type != standard.type || array.components != components)
    return fmt::format("array \"{}\" is {} {} x {}, it must be {} {} x {}", array.name, name_of(array.place),
                       name_of(array.type), array.components, name_of(standard.place), name_of(standard.type),
                       components);
  if (array.unit != standard.unit)
    return fmt::format("array \"{}\" has unit \"{}\", it must be \"{}\"", array.name, array.unit, standard.unit);
  if (array.transfer != standard.transfer)
    return fmt::format("array \"{}\" has transfer \"{}\", it must be \"{}\"", array.name, name_of(array.transfer),
                       name_of(standard.transfer));
  if (array.name == "triangle")
    return find_triangle_error(frame, array);
  if (array.name == "contact_vertex")
    return find_contact_error(frame, array);
  if (array.type == Type::text)
    return {};
  if (const std::uint64_t rows = rows_wanted(frame, standard, array); array.place == Place::frame && array.rows != rows)
    return fmt::format("array \"{}\" has {} rows, it must have {}", array.name, array.rows, rows);
  if (array.name.starts_with("drop_"))
    if (std::string error = find_drop_error(frame, array); !error.empty())
      return error;
  if (array.type != Type::float64)
    return {};
  const auto values = array.values<double>();
  if (array.name == "contact_since")
    return find_date_error(array.name, values);
  const std::size_t row = first_not_finite(values, array.components);
  if (row < array.rows)
    return fmt::format("array \"{}\": row {} is not finite", array.name, row);
  if (array.name == "volume")
    return find_not_positive(values, "array \"volume\": triangle {} has volume {} m^3, it must be positive");
  if (array.name == "temperature")
    return find_not_positive(values, "array \"temperature\": triangle {} has {} K, it must be above 0");
  if (array.name == "drop_volume")
    return find_not_positive(values, "array \"drop_volume\": drop {} has volume {} m^3, it must be positive");
  if (array.name == "drop_temperature")
    return find_not_positive(values, "array \"drop_temperature\": drop {} has {} K, it must be above 0");
  if (array.name == "step_size" && !(values[0] > 0))
    return fmt::format("array \"step_size\" is {} s, it must be positive", values[0]);
  return {};
}

} // namespace

std::string find_value_error(const Frame& frame) {
  for (const Standard& s : standards)
    if (s.required && frame.find(s.name) == nullptr)
      return fmt::format("array \"{}\" is missing", s.name);
  for (const Array& array : frame.arrays)
    if (const std::string error = find_array_error(frame, array); !error.empty())
      return error;
  if (frame.edges != 0) {
    const std::size_t edges =
        count_edges(frame.find("triangle")->values<std::array<std::uint32_t, 3>>(), frame.vertices);
    if (edges != frame.edges)
      return fmt::format("the frame counts {} edges, its triangles have {}", frame.edges, edges);
  }
  return {};
}

bool is_standard_array(std::string_view name) { return find_standard(name) != nullptr; }

Array make_standard_array(std::string_view name, std::uint64_t rows, std::uint32_t components) {
  const Standard* s = find_standard(name);
  if (s == nullptr)
    throw std::logic_error(fmt::format("\"{}\" is no standard array", name));
  return make_array(s->name, s->place, s->type, s->components == any_number ? components : s->components, s->unit,
                    s->transfer, rows);
}

std::string find_array_error(const Frame& frame, const Array& array) {
  const Standard* standard = find_standard(array.name);
  return standard == nullptr ? std::string() : find_error(frame, *standard, array);
}

std::string find_critical_error(const Frame& frame) {
  for (const Array& array : frame.arrays)
    if (array.critical && find_standard(array.name) == nullptr)
      return fmt::format("array \"{}\" is critical and unknown to version {}.{}: a newer sheet is needed", array.name,
                         version_major, version_minor);
  return {};
}

} // namespace sheet::formats
