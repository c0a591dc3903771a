// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/sheet_edges.h"

#include <algorithm>

#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

constexpr const char* name = "remesh.sheet_edge";

} // namespace

double mean_edge(const formats::Frame& frame) {
  const auto x = positions(frame);
  double sum = 0;
  for (const Corners& c : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      sum += (x[c[(i + 1) % 3]] - x[c[i]]).norm();
  return frame.triangles > 0 ? sum / (3.0 * static_cast<double>(frame.triangles)) : 0;
}

std::optional<double> shortest_stated_edge(const Scene& scene) {
  std::optional<double> shortest;
  for (const SheetTable& sheet : scene.sheets) {
    if (!sheet.edge_length)
      return {};
    shortest = std::min(*sheet.edge_length, shortest.value_or(*sheet.edge_length));
  }
  return shortest;
}

void put_sheet_edge(const Scene& scene, const SheetTable& sheet, formats::Frame& frame) {
  const auto shortest = shortest_stated_edge(scene);
  if (scene.sheets.size() == 1 || (shortest && std::ranges::all_of(scene.sheets, [&](const SheetTable& each) {
                                     return each.edge_length == shortest;
                                   })))
    return;
  formats::Array array = formats::make_array(name, formats::Place::triangle, formats::Type::float64, 1, "m",
                                             formats::Transfer::copy, frame.triangles);
  std::ranges::fill(array.values<double>(), sheet.edge_length.value_or(mean_edge(frame)));
  frame.put(std::move(array));
}

std::span<const double> sheet_edges(const formats::Frame& frame) {
  const formats::Array* array = frame.find(name);
  return array == nullptr || array->place != formats::Place::triangle || array->type != formats::Type::float64
             ? std::span<const double>()
             : array->values<double>();
}

double shortest_own_edge(const formats::Frame& frame) {
  const auto edges = sheet_edges(frame);
  return edges.empty() ? mean_edge(frame) : *std::ranges::min_element(edges);
}

} // namespace sheet::scene
