// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/drowned_inlets.h"

#include <algorithm>

#include "libsheet/flow/inlet.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/box.h"
#include "libsheet/geometry/triangle_pair.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/scene/prescribed.h"

namespace sheet::flow {

namespace {

// How far the layer is looked at: what enters is pushed against it, and is thinner than it for some rows.
constexpr int rows_before = 4;
constexpr double fastest = 1.05; // by how much the depth may change in a step

// Where an inlet lies.
struct LayerBefore {
  double depth = 0;             // [m]; 0: no layer
  std::int32_t wall = no_solid; // on which it lies
};

LayerBefore layer_before(const formats::Frame& frame, const Scene& scene, std::size_t number) {
  const auto bits = masks(frame, "inlet");
  const auto x = positions(frame);
  const std::vector<std::int32_t> touched = touched_solids(frame, scene.solids.size());
  const auto flows = [&](std::uint32_t v) {
    return of_inlet(bits[v], number) == 0 && touched[v] != no_solid &&
           scene.solids[static_cast<std::size_t>(touched[v])].contact == SolidContact::flow;
  };
  std::vector<std::uint8_t> reached(frame.vertices); // by the rows so far
  for (std::size_t v = 0; v < bits.size(); ++v)
    reached[v] = (of_inlet(bits[v], number) & behind_inlet) != 0 ? 1 : 0;
  LayerBefore layer;
  for (int row = 0; row < rows_before; ++row) {
    double volume = 0, area = 0;
    std::vector<std::uint32_t> next;
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const Corners& c = triangles(frame)[t];
      const auto known = std::ranges::count_if(c, [&](std::uint32_t v) { return reached[v] != 0; });
      if (known == 0 || known == 3 ||
          !std::ranges::all_of(c, [&](std::uint32_t v) { return reached[v] != 0 || flows(v); }))
        continue;
      volume += volumes(frame)[t];
      area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
      std::ranges::copy_if(c, std::back_inserter(next), flows);
    }
    for (const std::uint32_t v : next) {
      reached[v] = 1;
      if (layer.wall == no_solid)
        layer.wall = touched[v];
    }
    if (area > 0)
      layer.depth = std::max(layer.depth, volume / area);
  }
  return layer;
}

// Moves the strip of an inlet by `rise` [m] out of the wall.
void raise(formats::Frame& frame, std::size_t number, const solid::Solids& solids, std::int32_t wall, double rise) {
  const auto bits = frame.find("inlet")->values<std::uint64_t>();
  const auto origins = frame.find("inlet_origin")->values<Vector3>();
  const auto x = positions(frame);
  for (std::size_t v = 0; v < bits.size(); ++v)
    if (of_inlet(bits[v], number) != 0) {
      const Vector3 way = rise * solids.at(static_cast<std::size_t>(wall), x[v], frame.time).normal;
      x[v] += way;
      origins[v] += way;
    }
}

// Whether triangles at the inlet's strip meet others.
bool crosses(const formats::Frame& frame, std::size_t number) {
  const auto x = positions(frame);
  const auto bits = masks(frame, "inlet");
  const auto corners = triangles(frame);
  const auto moved = [&](std::uint32_t v) { return of_inlet(bits[v], number) != 0; };
  std::vector<Box> boxes;
  for (const Corners& c : corners)
    boxes.push_back(box_of(x, c));
  for (std::size_t t = 0; t < corners.size(); ++t)
    if (std::ranges::any_of(corners[t], moved))
      for (std::size_t other = 0; other < corners.size(); ++other)
        if (other != t && boxes[t].overlaps(boxes[other]) && triangles_intersect(x, corners[t], corners[other]))
          return true;
  return false;
}

} // namespace

void drown_inlets(formats::Frame& frame, const Scene& scene, const solid::Solids& solids) {
  if (frame.find("inlet") == nullptr)
    return;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    if (!scene::in_force(scene.inflows[i], frame.time))
      continue;
    const LayerBefore layer = layer_before(frame, scene, i);
    if (layer.wall == no_solid)
      continue;
    const double before = scene::inlet_depth(frame, scene, i);
    const double depth =
        std::clamp(std::max(scene.inflows[i].thickness, layer.depth), before / fastest, before * fastest);
    if (depth == before)
      continue;
    raise(frame, i, solids, layer.wall, (depth - before) / 2);
    if (crosses(frame, i))
      raise(frame, i, solids, layer.wall, (before - depth) / 2);
    else
      scene::put_inlet_depth(frame, scene, i, depth);
  }
}

} // namespace sheet::flow
