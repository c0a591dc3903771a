// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/check.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "libsheet/base/error.h"
#include "libsheet/measure/intersections.h"
#include "libsheet/measure/topology.h"
#include "libsheet/scene/read.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;

class Findings {
public:
  explicit Findings(std::size_t examples) : examples_(examples) {}
  template <class... Args>
  void add(std::string_view kind, std::string_view text, fmt::format_string<Args...> format, Args&&... args) {
    if (found_.empty() || found_.back().kind != kind)
      found_.push_back({kind, text, 0, {}});
    Finding& finding = found_.back();
    if (finding.count++ < examples_)
      finding.examples.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  // Places that have been counted but are not at hand.
  void add_uncounted(std::uint64_t count) { found_.back().count += count; }
  [[nodiscard]] std::vector<Finding> take() { return std::move(found_); }

private:
  std::size_t examples_;
  std::vector<Finding> found_;
};

template <class T> bool all_finite(const Array& array) {
  const auto values = array.values<T>();
  return std::all_of(values.begin(), values.end(), [](T x) { return std::isfinite(x); });
}

// Dates of contacts may be -inf: the format has a rule of its own for them.
bool has_dates(const Array& array) { return array.name == "contact_since"; }

bool all_finite(const Array& array) {
  return has_dates(array)                       ? true
         : array.type == formats::Type::float64 ? all_finite<double>(array)
         : array.type == formats::Type::float32 ? all_finite<float>(array)
                                                : true;
}

// True if positions, triangles and volumes have the shape that the specification says, whatever their values.
bool has_shape(const Frame& frame) {
  Frame shape; // the same arrays without rows: nothing is left to be wrong but the entries
  for (const std::string_view name : {"position", "triangle", "volume"}) {
    const Array* a = frame.find(name);
    if (a == nullptr)
      return false;
    shape.put(formats::make_array(name, a->place, a->type, a->components, a->unit, a->transfer, 0));
  }
  return find_value_error(shape).empty();
}

void check_rules(const Frame& frame, Findings& found) {
  constexpr std::string_view text = "broken rules of the format";
  for (const std::string_view name : {"position", "triangle", "volume"})
    if (frame.find(name) == nullptr)
      found.add("rule", text, "array \"{}\" is missing", name);
  for (const Array& array : frame.arrays) {
    // What has a kind of its own is left to it; here only the entry counts, with values that nobody minds.
    const bool own_kind = array.name == "triangle" || array.name == "volume" || !all_finite(array);
    Array entry = formats::make_array(array.name, array.place, array.type, array.components, array.unit, array.transfer,
                                      array.place == formats::Place::frame ? array.rows : 0);
    if (entry.type == formats::Type::float64)
      std::ranges::fill(entry.values<double>(), 1.0);
    if (const std::string error = find_array_error(frame, own_kind ? entry : array); !error.empty())
      found.add("rule", text, "{}", error);
  }
}

void check_scene(const Frame& frame, Findings& found) {
  const Array* scene = frame.find("scene");
  if (scene == nullptr || scene->type != formats::Type::text)
    return;
  try {
    (void)parse_scene(scene->text(), "scene");
  } catch (const Error& error) {
    found.add("scene", "scenes that cannot be read", "{}", error.what());
  }
}

template <class T> void check_finite(const Array& array, Findings& found) {
  const auto values = array.values<T>();
  for (std::size_t i = 0; i < values.size() && !has_dates(array); ++i)
    if (!std::isfinite(values[i]))
      found.add("not_finite", "values that are not finite", "array \"{}\", row {}, component {} is {}", array.name,
                i / array.components, i % array.components, values[i]);
}

// Marks the triangles that have a shape; reports those that have none, and everything about vertices' names.
std::vector<bool> check_indices(const Frame& frame, Findings& found) {
  const auto corners = triangles(frame);
  const auto x = positions(frame);
  std::vector<bool> usable(corners.size(), true), used(frame.vertices, false);
  for (std::uint64_t t = 0; t < corners.size(); ++t)
    for (const std::uint32_t v : corners[t])
      if (v < frame.vertices) {
        used[v] = true;
      } else {
        usable[t] = false;
        found.add("out_of_range", "corners at vertices that do not exist", "triangle {} names vertex {} of {}", t, v,
                  frame.vertices);
      }
  for (std::uint64_t t = 0; t < corners.size(); ++t) {
    const Corners& c = corners[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
      usable[t] = false;
      found.add("repeated", "triangles that name a vertex twice", "triangle {} names vertices {} {} {}", t, c[0], c[1],
                c[2]);
    }
  }
  const auto v = volumes(frame);
  for (std::uint64_t t = 0; t < v.size(); ++t)
    if (v[t] <= 0) // what is not a number has been found already
      found.add("volume", "volumes that are not positive", "triangle {} has {} m^3", t, v[t]);
  for (std::uint64_t i = 0; i < used.size(); ++i)
    if (!used[i])
      found.add("unused", "vertices that belong to no triangle", "vertex {}", i);
  for (std::uint64_t t = 0; t < corners.size(); ++t)
    usable[t] = usable[t] &&
                std::all_of(corners[t].begin(), corners[t].end(), [&](std::uint32_t i) { return x[i].allFinite(); });
  return usable;
}

void check_duplicates(std::span<const Side> sides, std::span<const Corners> corners, Findings& found) {
  // Duplicates of a triangle are among the sides of its lowest edge, so they need no sorting of their own.
  for_each_edge(sides, [&](std::span<const Side> edge) {
    std::map<std::uint32_t, std::uint64_t> first; // by the third vertex
    for (std::size_t i = 0; edge.size() > 1 && i < edge.size(); ++i) {
      const std::uint32_t third = corners[edge[i].triangle][edge[i].opposite];
      const auto [at, is_new] = first.try_emplace(third, edge[i].triangle);
      if (!is_new && third > edge[i].high)
        found.add("duplicate", "triangles with the same vertices as another", "triangle {} as triangle {}",
                  edge[i].triangle, at->second);
    }
  });
}

void check_connections(const Frame& frame, Findings& found) {
  const auto corners = triangles(frame);
  const std::vector<Side> sides = sorted_sides(corners, frame.vertices);
  check_duplicates(sides, corners, found);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() > 2)
      found.add("non_manifold", "edges with more than two triangles", "edge {} {} has {}: {}, {}, {}{}", edge[0].low,
                edge[0].high, edge.size(), edge[0].triangle, edge[1].triangle, edge[2].triangle,
                edge.size() > 3 ? ", ..." : "");
  });
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() == 2 && edge[0].ascending == edge[1].ascending)
      found.add("orientation", "edges whose triangles have opposite positive sides", "edge {} {}: triangles {} and {}",
                edge[0].low, edge[0].high, edge[0].triangle, edge[1].triangle);
  });
  const Fans fans(corners, sides);
  for (const std::uint32_t v : find_pinched(corners, frame.vertices, fans))
    found.add("pinched", "vertices that join triangles which are no neighbours there", "vertex {}", v);
}

void check_geometry(const Frame& frame, std::vector<bool> usable, const CheckOptions& options, Findings& found) {
  const auto corners = triangles(frame);
  const auto x = positions(frame);
  for (const std::uint64_t t : find_degenerate(x, corners, usable)) {
    usable[t] = false;
    found.add("degenerate", "triangles with their corners on a line", "triangle {} at vertices {} {} {}", t,
              corners[t][0], corners[t][1], corners[t][2]);
  }
  if (!options.intersections)
    return;
  const Intersections result = find_intersections(x, corners, usable, options.examples);
  for (const auto& [first, second] : result.pairs)
    found.add("intersection", "pairs of triangles that intersect", "triangles {} and {}", first, second);
  if (result.count > result.pairs.size()) {
    if (result.pairs.empty())
      found.add("intersection", "pairs of triangles that intersect", "");
    found.add_uncounted(result.count - std::max<std::size_t>(result.pairs.size(), 1));
  }
}

} // namespace

std::vector<Finding> check(const Frame& frame, const CheckOptions& options) {
  Findings found(options.examples);
  check_rules(frame, found);
  const bool shape = has_shape(frame);
  if (shape && frame.edges != 0) {
    std::uint64_t edges = 0;
    for_each_edge(sorted_sides(triangles(frame), frame.vertices), [&](std::span<const Side>) { ++edges; });
    if (edges != frame.edges)
      found.add("rule", "broken rules of the format", "the frame counts {} edges, its triangles have {}", frame.edges,
                edges);
  }
  check_scene(frame, found);
  for (const Array& array : frame.arrays) {
    if (array.type == formats::Type::float64)
      check_finite<double>(array, found);
    if (array.type == formats::Type::float32)
      check_finite<float>(array, found);
  }
  if (!shape)
    return found.take();
  const std::vector<bool> usable = check_indices(frame, found);
  check_connections(frame, found);
  check_geometry(frame, usable, options, found);
  return found.take();
}

} // namespace sheet
