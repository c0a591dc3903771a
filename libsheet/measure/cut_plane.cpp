// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/cut_plane.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "libsheet/base/error.h"
#include "libsheet/base/units.h"

namespace sheet {

namespace {

constexpr std::string_view axes = "xyz";

std::string without_blanks(std::string_view text) {
  std::string kept(text);
  std::erase_if(kept, [](char c) { return c == ' ' || c == '\t'; });
  return kept;
}

// Nothing of what is none, or not finite.
std::optional<double> read_number(std::string_view text, const Quantity& expected) {
  std::string problem;
  const std::optional<double> value = read_quantity(text, expected, problem);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// What stands before a coordinate: "", "-", "+0.3", "2*".
std::optional<double> read_factor(std::string_view text) {
  if (text.ends_with('*'))
    text.remove_suffix(1);
  const double sign = text.starts_with('-') ? -1 : 1;
  if (text.starts_with('-') || text.starts_with('+'))
    text.remove_prefix(1);
  if (text.empty())
    return sign;
  const auto size = read_number(text, quantity::number);
  return size ? std::optional(sign * *size) : std::nullopt;
}

// The sum of coordinates with factors; nothing of what is none.
std::optional<Vector3> read_normal(std::string_view sum) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t start = 0; start < sum.size();) {
    const std::size_t at = sum.find_first_of(axes, start);
    if (at == std::string_view::npos || (start > 0 && sum[start] != '+' && sum[start] != '-'))
      return std::nullopt;
    const auto factor = read_factor(sum.substr(start, at - start));
    if (!factor)
      return std::nullopt;
    normal[static_cast<Eigen::Index>(axes.find(sum[at]))] += *factor;
    start = at + 1;
  }
  return normal == Vector3::Zero() ? std::nullopt : std::optional(normal);
}

} // namespace

CutPlane parse_cut_plane(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const auto normal = read_normal(without_blanks(text.substr(0, equals)));
  const auto offset = read_number(text.substr(std::min(equals + 1, text.size())), quantity::length);
  if (!normal || !offset)
    fail(ExitCode::usage, "--cut: \"{}\" is no plane such as \"x=0\", \"y = 2 mm\" or \"0.3x+y=1mm\"", text);
  return {*normal, *offset};
}

Vector3 parse_point(std::string_view text) {
  Vector3 point;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? text.find(',') : text.size();
    const auto coordinate = read_number(text.substr(0, comma), quantity::length);
    if (comma == std::string_view::npos || !coordinate)
      fail(ExitCode::usage, "--at: give a point such as 0,2mm,-0.1, three lengths with commas between them");
    point[i] = *coordinate;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return point;
}

} // namespace sheet
