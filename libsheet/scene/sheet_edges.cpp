// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/sheet_edges.h"

#include <algorithm>

#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

constexpr const char* name = "remesh.sheet_edge";

} // namespace

std::optional<double> shortest_stated_edge(const Scene& scene) {
  std::optional<double> shortest;
  for (const SheetTable& sheet : scene.sheets)
    if (sheet.edge_length)
      shortest = std::min(*sheet.edge_length, shortest.value_or(*sheet.edge_length));
  return shortest;
}

void put_sheet_edge(const Scene& scene, const SheetTable& sheet, formats::Frame& frame) {
  const auto shortest = shortest_stated_edge(scene);
  if (!shortest || std::ranges::all_of(scene.sheets, [&](const SheetTable& each) {
        return each.edge_length.value_or(*shortest) == *shortest;
      }))
    return;
  formats::Array array = formats::make_array(name, formats::Place::triangle, formats::Type::float64, 1, "m",
                                             formats::Transfer::copy, frame.triangles);
  std::ranges::fill(array.values<double>(), sheet.edge_length.value_or(*shortest));
  frame.put(std::move(array));
}

std::span<const double> sheet_edges(const formats::Frame& frame) {
  const formats::Array* array = frame.find(name);
  return array == nullptr || array->place != formats::Place::triangle || array->type != formats::Type::float64
             ? std::span<const double>()
             : array->values<double>();
}

} // namespace sheet::scene
