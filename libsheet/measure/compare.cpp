// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/compare.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;
using formats::Type;

template <class T> double distance(T a, T b) {
  if constexpr (std::is_floating_point_v<T>) {
    if (a == b || (std::isnan(a) && std::isnan(b)))
      return 0;
    if (std::isnan(a) || std::isnan(b))
      return std::numeric_limits<double>::infinity();
    return std::abs(static_cast<double>(a) - static_cast<double>(b));
  } else { // exact also where the difference leaves the type
    const auto [low, high] = std::minmax(a, b);
    return static_cast<double>(static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low));
  }
}

// Relative to the larger of the two; infinite where one is.
template <class T> double relative(double distance, T a, T b) {
  if (distance == 0)
    return 0;
  const double size = std::max(std::abs(static_cast<double>(a)), std::abs(static_cast<double>(b)));
  return std::isfinite(distance) ? distance / size : distance;
}

// The largest of the differences and where it is.
struct Largest {
  double value = 0;
  std::size_t at = 0;
  void see(double difference, std::size_t i) {
    if (difference > value) {
      value = difference;
      at = i;
    }
  }
};

template <class T> std::string compare_values(const Array& a, const Array& b, const Tolerance& tolerance) {
  const auto va = a.values<T>(), vb = b.values<T>();
  std::size_t differing = 0;
  Largest absolute, in_proportion;
  for (std::size_t i = 0; i < va.size(); ++i) {
    const double d = distance(va[i], vb[i]);
    const double r = relative(d, va[i], vb[i]);
    if (d <= tolerance.absolute || r <= tolerance.relative)
      continue;
    ++differing;
    absolute.see(d, i);
    in_proportion.see(r, i);
  }
  if (differing == 0)
    return {};
  const auto place = [&](const Largest& l) {
    return fmt::format("{:.6g} at row {}{} ({} and {})", l.value, l.at / a.components,
                       a.components > 1 ? fmt::format(", component {}", l.at % a.components) : "", +va[l.at],
                       +vb[l.at]);
  };
  return fmt::format("array \"{}\": {} of {} values differ; largest difference {}; largest relative difference {}",
                     a.name, differing, va.size(), place(absolute), place(in_proportion));
}

std::string compare_text(const Array& a, const Array& b) {
  const std::string_view ta = a.text(), tb = b.text();
  if (ta == tb)
    return {};
  const auto at = std::mismatch(ta.begin(), ta.end(), tb.begin(), tb.end()).first - ta.begin();
  const auto lines = std::count(ta.begin(), ta.begin() + at, '\n');
  return fmt::format("array \"{}\": the texts differ from line {} on", a.name, lines + 1);
}

std::string compare_data(const Array& a, const Array& b, const Tolerance& tolerance) {
  switch (a.type) {
  case Type::int8:
    return compare_values<std::int8_t>(a, b, tolerance);
  case Type::uint8:
    return compare_values<std::uint8_t>(a, b, tolerance);
  case Type::int32:
    return compare_values<std::int32_t>(a, b, tolerance);
  case Type::uint32:
    return compare_values<std::uint32_t>(a, b, tolerance);
  case Type::int64:
    return compare_values<std::int64_t>(a, b, tolerance);
  case Type::uint64:
    return compare_values<std::uint64_t>(a, b, tolerance);
  case Type::float32:
    return compare_values<float>(a, b, tolerance);
  case Type::float64:
    return compare_values<double>(a, b, tolerance);
  case Type::text:
    return compare_text(a, b);
  }
  return {};
}

std::string describe(const Array& array) {
  return fmt::format("{} {} x {}, {}, {}{}", name_of(array.place), name_of(array.type), array.components, array.unit,
                     name_of(array.transfer), array.critical ? ", critical" : "");
}

std::string compare_arrays(const Array& a, const Array& b, const CompareOptions& options) {
  if (const std::string da = describe(a), db = describe(b); da != db)
    return fmt::format("array \"{}\" is {} in the first, {} in the second", a.name, da, db);
  if (a.type != Type::text && a.rows != b.rows)
    return fmt::format("array \"{}\" has {} rows in the first, {} in the second", a.name, a.rows, b.rows);
  const bool is_float = a.type == Type::float32 || a.type == Type::float64;
  const auto own = options.arrays.find(a.name);
  return compare_data(a, b, own != options.arrays.end() ? own->second : is_float ? options.floats : Tolerance{});
}

std::optional<double> parse(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0))
    return {};
  return value;
}

} // namespace

void add_tolerance(CompareOptions& options, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t comma = std::min(text.find(',', equals), text.size());
  std::optional<double> absolute, relative = 0.0;
  if (equals != std::string::npos && equals > 0) {
    absolute = parse(std::string_view(text).substr(equals + 1, comma - equals - 1));
    if (comma < text.size())
      relative = parse(std::string_view(text).substr(comma + 1));
  }
  if (!absolute || !relative)
    fail(ExitCode::usage, "\"{}\" is not NAME=ABS or NAME=ABS,REL with numbers from 0 up", text);
  options.arrays[text.substr(0, equals)] = {*absolute, *relative};
}

std::vector<std::string> compare(const Frame& a, const Frame& b, const CompareOptions& options) {
  std::vector<std::string> differences;
  const auto add = [&](std::string text) {
    if (!text.empty())
      differences.push_back(std::move(text));
  };
  const auto own = options.arrays.find("time");
  const Tolerance& t = own != options.arrays.end() ? own->second : options.floats;
  const double d = distance(a.time, b.time);
  if (!options.ignored.contains("time") && !(d <= t.absolute || relative(d, a.time, b.time) <= t.relative))
    add(fmt::format("time {} s in the first, {} s in the second", a.time, b.time));
  const auto count = [&](const char* what, std::uint64_t in_a, std::uint64_t in_b) {
    if (in_a != in_b)
      add(fmt::format("{} {} in the first, {} in the second", what, in_a, in_b));
  };
  if (!options.ignored.contains("step"))
    count("step", a.step, b.step);
  count("vertices", a.vertices, b.vertices);
  count("triangles", a.triangles, b.triangles);
  for (const Array& array : a.arrays) {
    if (options.ignored.contains(array.name))
      continue;
    if (const Array* other = b.find(array.name); other != nullptr)
      add(compare_arrays(array, *other, options));
    else
      add(fmt::format("array \"{}\" is missing in the second", array.name));
  }
  for (const Array& array : b.arrays)
    if (!options.ignored.contains(array.name) && a.find(array.name) == nullptr)
      add(fmt::format("array \"{}\" is missing in the first", array.name));
  return differences;
}

} // namespace sheet
