// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/shape_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"

namespace sheet {

void check_length(const char* shape, const char* what, double length) {
  if (!(length > 0.0) || !std::isfinite(length))
    fail(ExitCode::bad_input, "{}: {} = {:g} must be positive and finite", shape, what, length);
}

void check_edge_length(const char* shape, double edge_length, double largest, double area) {
  check_length(shape, "edge_length", edge_length);
  if (edge_length > largest * (1.0 + 1e-9))
    fail(ExitCode::bad_input, "{}: edge_length = {:g} m is too large for the shape; at most {:g} m", shape, edge_length,
         largest);
  constexpr double many = 3e5; // a ring takes many seconds a step
  const double smallest_area = 0.25 * std::numbers::sqrt3 * edge_length * edge_length, count = area / smallest_area;
  const std::string_view in_doubt = "numbers without unit are metres, if a length has lost its own";
  if (!(count <= static_cast<double>(most_triangles)))
    fail(ExitCode::bad_input,
         "{}: edge_length = {:g} m would make {:.3g} triangles, more than {}; use at least {:g} m ({})", shape,
         edge_length, count, most_triangles,
         std::sqrt(area / static_cast<double>(most_triangles) / (0.25 * std::numbers::sqrt3)), in_doubt);
  if (count > many)
    log::warning("{}: edge_length = {:g} m makes {:.2g} triangles of {:.3g} m², which takes long here, and longer in "
                 "a ring ({})",
                 shape, edge_length, count, area, in_doubt);
}

std::optional<std::array<std::uint32_t, 2>> explicit_segments(const char* shape, const MeshOptions& options,
                                                              std::array<std::uint32_t, 2> least, double triangles) {
  if (!options.segments)
    return std::nullopt;
  if (options.pattern != Pattern::structured)
    fail(ExitCode::bad_input, "{}: segments belong to the structured pattern; give an edge_length instead", shape);
  const auto [first, second] = *options.segments;
  if (first < least[0] || second < least[1])
    fail(ExitCode::bad_input, "{}: segments = [{}, {}] are too few; at least [{}, {}]", shape, first, second, least[0],
         least[1]);
  const double count = triangles * static_cast<double>(first) * static_cast<double>(second);
  if (count > static_cast<double>(most_triangles))
    fail(ExitCode::bad_input, "{}: segments = [{}, {}] would make {:.3g} triangles, more than {}", shape, first, second,
         count, most_triangles);
  return options.segments;
}

std::uint32_t segments_of(double length, double step, std::uint32_t least) {
  return std::max(least, static_cast<std::uint32_t>(std::lround(length / step)));
}

std::uint32_t even_segments_of(double length, double step, std::uint32_t least) {
  return std::max(least, 2 * static_cast<std::uint32_t>(std::lround(0.5 * length / step)));
}

} // namespace sheet
