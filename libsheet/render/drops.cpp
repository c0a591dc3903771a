// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/drops.h"

#include <algorithm>

#include "libsheet/sheet/drop_shells.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::render {

namespace {

constexpr DropShells balls{.part = 1, .partings = 3};
constexpr double mean_chord = 4.0 / 3; // of a ball, in radii

} // namespace

formats::Frame with_balls(const formats::Frame& frame) { return with_drop_shells(frame, balls); }

OwnParts own_parts(const formats::Frame& frame) {
  const formats::Array* marks = frame.find("drop.shell");
  if (marks == nullptr)
    return {frame.vertices, frame.triangles};
  const auto values = marks->values<std::uint8_t>();
  const std::size_t drops = static_cast<std::size_t>(std::ranges::count(values, std::uint8_t{1})) / balls.triangles();
  return {frame.vertices - drops * (balls.triangles() / 2 + 2), frame.triangles - drops * balls.triangles()};
}

Middle own_middle(const formats::Frame& frame) {
  const auto [vertices, triangles] = own_parts(frame);
  Middle middle = middle_of(frame);
  const auto own = std::ranges::lower_bound(middle.source_triangle, triangles) - middle.source_triangle.begin();
  middle.positions.resize(vertices);
  middle.thickness.resize(vertices);
  middle.triangles.resize(static_cast<std::size_t>(own));
  middle.source_triangle.resize(static_cast<std::size_t>(own));
  return middle;
}

void add_balls(const formats::Frame& frame, Surface& surface) {
  const auto [vertices, triangles] = own_parts(frame);
  const auto x = positions(frame);
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  const std::size_t of_ball = balls.triangles() / 2 + 2;
  for (std::size_t begin = vertices; begin < frame.vertices; begin += of_ball) {
    Vector3 middle = Vector3::Zero();
    for (std::size_t v = begin; v < begin + of_ball; ++v)
      middle += x[v] / static_cast<double>(of_ball);
    for (std::size_t v = begin; v < begin + of_ball; ++v) {
      surface.positions.push_back(x[v]);
      surface.normals.push_back((x[v] - middle).normalized().cast<float>());
      surface.source_vertex.push_back(static_cast<std::uint32_t>(surface.thickness.size()));
      surface.thickness.push_back(static_cast<float>(mean_chord * (x[v] - middle).norm()));
    }
  }
  for (std::size_t t = triangles; t < frame.triangles; ++t) {
    Corners corners = sheet::triangles(frame)[t];
    for (std::uint32_t& c : corners)
      c = first + c - static_cast<std::uint32_t>(vertices);
    surface.triangles.push_back(corners);
    surface.source_triangle.push_back(static_cast<std::uint32_t>(t));
    surface.on_bead.push_back(false);
  }
}

} // namespace sheet::render
