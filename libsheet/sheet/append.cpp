// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/append.h"

#include <algorithm>

#include "libsheet/base/error.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

using formats::Array;
using formats::Frame;
using formats::Place;

namespace {

std::size_t bytes_of_row(const Array& array) { return formats::size_of(array.type) * array.components; }

Array with_rows(const Array& array, std::uint64_t rows) {
  return formats::make_array(array.name, array.place, array.type, array.components, array.unit, array.transfer, rows,
                             array.critical);
}

// The rows of one array behind those of another; either may be missing, then they are zero.
Array joined(const Array* first, std::uint64_t rows, const Array* second, std::uint64_t more_rows) {
  if (first != nullptr && second != nullptr && (first->type != second->type || first->components != second->components))
    fail(ExitCode::bad_input, "the array \"{}\" has not the shape that a sheet which enters has it in", first->name);
  Array result = with_rows(first != nullptr ? *first : *second, rows + more_rows);
  if (first != nullptr)
    std::copy_n(first->data.data(), first->data.size(), result.data.data());
  if (second != nullptr)
    std::copy_n(second->data.data(), second->data.size(), result.data.data() + rows * bytes_of_row(result));
  return result;
}

} // namespace

void append(const Frame& more, Frame& frame) {
  const std::uint64_t vertices = frame.vertices, triangles = frame.triangles;
  for (const Array& array : more.arrays)
    if ((array.place == Place::vertex || array.place == Place::triangle) && frame.find(array.name) == nullptr)
      frame.put(with_rows(array, frame.rows_at(array.place)));
  const std::uint64_t new_edges = frame.edges == 0 ? 0 : connect(more.vertices, sheet::triangles(more)).edges.size();
  for (Array& array : frame.arrays)
    if (array.place == Place::vertex || array.place == Place::triangle)
      array = joined(&array, frame.rows_at(array.place), more.find(array.name), more.rows_at(array.place));
    else if (array.place == Place::edge) // those of the new vertices, which come last, come last
      array = joined(&array, frame.edges, nullptr, new_edges);
  frame.vertices += more.vertices;
  frame.triangles += more.triangles;
  frame.edges += new_edges;
  for (std::uint64_t t = triangles; t < frame.triangles; ++t)
    for (std::uint32_t& v : frame.find("triangle")->values<Corners>()[t])
      v += static_cast<std::uint32_t>(vertices);
  if (Array* start = frame.find("start_position"))
    std::ranges::copy(positions(more),
                      start->values<Eigen::Vector3d>().begin() + static_cast<std::ptrdiff_t>(vertices));
}

} // namespace sheet
