// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/near_layers.h"

#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace sheet::render {
namespace {

constexpr float start_inside = 0.25F; // in thicknesses: from there a point of the surface looks out for other layers
constexpr int ways_around = 6;        // besides the normal
constexpr float tilt = 0.6F;          // of these, from the normal [rad]

// What a ray out of the sheet, from close below a point of its surface, hits first of other parts of the sheet.
Hit beyond_own(const World& world, std::uint32_t point, const Ray& ray) {
  const Surface& s = world.surface();
  const std::uint32_t own = s.source_vertex[point];
  constexpr float unending = std::numeric_limits<float>::infinity();
  float beyond = 0;
  for (int faces = 0; faces < 16; ++faces) {
    const Hit hit = world.nearest_sheet(ray, beyond, unending);
    if (!hit.anything())
      break;
    const Corners& t = s.triangles[hit.triangle];
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t p) { return s.source_vertex[p] == own; }))
      return hit;
    beyond = std::nextafter(hit.distance, unending);
  }
  return {};
}

// Another layer beyond a point of the surface.
struct Neighbour {
  std::uint32_t triangle = 0;
  float closeness = 0;
};

// In a direction that leans by an angle of this cosine from the normal.
Neighbour neighbour(const World& world, std::uint32_t point, std::uint32_t liquid, const Vec& direction, float cosine,
                    float mean) {
  const Surface& s = world.surface();
  const auto unit = static_cast<float>(world.unit());
  const float h = s.thickness[s.source_vertex[point]], inside = start_inside * h / unit;
  const Hit hit = beyond_own(world, point, {world.to_world(s.positions[point]) - inside * s.normals[point], direction});
  if (!hit.anything() || s.liquid(hit.triangle) != liquid)
    return {};
  const bool in_another = hit.face.dot(direction) > 0; // it is a way out of that
  return {hit.triangle, in_another ? 1 : closeness((hit.distance * cosine - inside) / (std::max(h, mean) / unit))};
}

// The mean closeness of others along the normal and in directions around it.
float covered(const World& world, std::uint32_t point, std::uint32_t liquid, float mean, float ahead) {
  const Basis basis(world.surface().normals[point]);
  float sum = ahead;
  for (int way = 0; way < ways_around; ++way) {
    const float angle = 2 * float_pi * static_cast<float>(way) / ways_around, cosine = std::cos(tilt);
    const Vec direction = basis.world(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), cosine);
    sum += neighbour(world, point, liquid, direction, cosine, mean).closeness;
  }
  return sum / (1 + ways_around);
}

// Of the surface's points, those of one of their triangles.
std::vector<std::uint32_t> liquids_of_points(const Surface& s) {
  std::vector<std::uint32_t> result(s.positions.size(), 0);
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (const std::uint32_t p : s.triangles[t])
      result[p] = s.liquid(t);
  return result;
}

// The greatest at each vertex of what is near on either side, there or seen from there.
std::vector<float> at_vertices(const Surface& s, const std::vector<Neighbour>& near) {
  std::vector<float> result(s.thickness.size());
  const auto raise = [&](std::uint32_t point, float value) {
    float& at = result[s.source_vertex[point]];
    at = std::max(at, value);
  };
  for (std::uint32_t p = 0; p < near.size(); ++p)
    if (near[p].closeness > 0) {
      raise(p, near[p].closeness);
      for (const std::uint32_t q : s.triangles[near[p].triangle])
        raise(q, near[p].closeness);
    }
  return result;
}

// The greatest of each vertex and those around it: layers may touch between the vertices.
std::vector<float> spread(const Surface& s, const std::vector<float>& values) {
  std::vector<float> result = values;
  for (const Corners& t : s.triangles)
    for (const std::uint32_t p : t)
      for (const std::uint32_t q : t)
        result[s.source_vertex[p]] = std::max(result[s.source_vertex[p]], values[s.source_vertex[q]]);
  return result;
}

} // namespace

NearLayers near_layers(const World& world, float mean) {
  const Surface& s = world.surface();
  const std::vector<std::uint32_t> liquids = liquids_of_points(s);
  std::vector<Neighbour> near(s.positions.size());
  tbb::parallel_for(std::size_t{0}, near.size(), [&](std::size_t p) {
    near[p] = neighbour(world, static_cast<std::uint32_t>(p), liquids[p], s.normals[p], 1, mean);
  });
  NearLayers result;
  result.closeness = spread(s, at_vertices(s, near));
  if (std::none_of(result.closeness.begin(), result.closeness.end(), [](float c) { return c > 0; }))
    return {};
  for (const Neighbour& n : near)
    result.ahead.push_back(n.closeness);
  return result;
}

std::vector<float> covered_by_others(const World& world, float mean, const NearLayers& near) {
  const Surface& s = world.surface();
  const std::vector<std::uint32_t> liquids = liquids_of_points(s);
  std::vector<float> result(near.ahead.size());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t p) {
    if (near.closeness[s.source_vertex[p]] > 0)
      result[p] = covered(world, static_cast<std::uint32_t>(p), liquids[p], mean, near.ahead[p]);
  });
  return result;
}

} // namespace sheet::render
