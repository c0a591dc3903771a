// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "libsheet/render/melted_normals.h"

namespace sheet::render {
namespace {

constexpr float unending = std::numeric_limits<float>::infinity();
constexpr float widest_gap = 1.25F;   // between layers that touch, in thicknesses
constexpr float longest_gap = 4;      // along a ray, in widest gaps
constexpr float start_inside = 0.25F; // in thicknesses: from there a point of the surface looks out for other layers
constexpr float reach = 1.5F;         // in thicknesses: so far it looks
constexpr double melting = 2.5;       // in mean thicknesses: so far normals are smoothed
constexpr int most_faces = 256;       // that a depth is looked for behind
constexpr float most_layers = 32;     // that a body is told to be deep

// What a ray out of the sheet, from close below a point of its surface, hits first of other parts of the sheet.
Hit beyond_own(const World& world, std::uint32_t point, float start, float length) {
  const Surface& s = world.surface();
  const std::uint32_t own = s.source_vertex[point];
  const Ray ray{world.to_world(s.positions[point]) - start * s.normals[point], s.normals[point]};
  float beyond = 0;
  for (int faces = 0; faces < 16; ++faces) {
    const Hit hit = world.nearest_sheet(ray, beyond, length);
    if (!hit.anything())
      break;
    const Corners& t = s.triangles[hit.triangle];
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t p) { return s.source_vertex[p] == own; }))
      return hit;
    beyond = std::nextafter(hit.distance, unending);
  }
  return {};
}

// The triangle of another part of the sheet that is near a point of the surface.
std::optional<std::uint32_t> neighbour(const World& world, std::uint32_t point, float mean) {
  const Surface& s = world.surface();
  const auto unit = static_cast<float>(world.unit());
  const float h = s.thickness[s.source_vertex[point]], start = start_inside * h / unit;
  const Hit hit = beyond_own(world, point, start, start + reach * std::max(h, mean) / unit);
  return hit.anything() ? std::optional(hit.triangle) : std::nullopt;
}

// Whether a point that has no neighbour is in the liquid all the same, deep in another layer.
bool is_sunk(const World& world, std::uint32_t point) {
  return beyond_own(world, point, 0, unending).face.dot(world.surface().normals[point]) > 0;
}

// Triangles that have a marked vertex.
std::vector<char> around(const Surface& s, const std::vector<char>& marked) {
  std::vector<char> result(s.triangles.size());
  for (std::size_t t = 0; t < result.size(); ++t)
    result[t] = static_cast<char>(std::any_of(s.triangles[t].begin(), s.triangles[t].end(),
                                              [&](std::uint32_t p) { return marked[s.source_vertex[p]] != 0; }));
  return result;
}

// By area [m].
float mean_thickness(const Surface& s) {
  double volume = 0, sum = 0;
  for (const Corners& t : s.triangles) {
    const Vector3& x = s.positions[t[0]];
    const double area = (s.positions[t[1]] - x).cross(s.positions[t[2]] - x).norm();
    for (const std::uint32_t p : t)
      volume += area / 3 * static_cast<double>(s.thickness[s.source_vertex[p]]);
    sum += area;
  }
  return sum > 0 ? static_cast<float>(volume / sum) : 0;
}

} // namespace

Body::Body(const World& world) {
  const Surface& s = world.surface();
  if (!s.closed)
    return;
  mean_ = mean_thickness(s);
  std::vector<std::optional<std::uint32_t>> near(s.positions.size());
  tbb::parallel_for(std::size_t{0}, near.size(),
                    [&](std::size_t p) { near[p] = neighbour(world, static_cast<std::uint32_t>(p), mean_); });
  std::vector<char> marked(s.thickness.size());
  for (std::size_t p = 0; p < near.size(); ++p)
    if (near[p]) {
      marked[s.source_vertex[p]] = 1;
      for (const std::uint32_t q : s.triangles[*near[p]])
        marked[s.source_vertex[q]] = 1;
    }
  if (std::find(marked.begin(), marked.end(), 1) == marked.end())
    return;
  touching_ = around(s, marked);
  for (std::size_t t = 0; t < touching_.size(); ++t) // one ring more: layers may touch between the vertices
    if (touching_[t] != 0)
      for (const std::uint32_t p : s.triangles[t])
        marked[s.source_vertex[p]] = 1;
  touching_ = around(s, marked);
  std::vector<char> chosen(near.size()), bare(near.size());
  for (std::size_t p = 0; p < near.size(); ++p) {
    chosen[p] = marked[s.source_vertex[p]];
    bare[p] = static_cast<char>(!near[p] && !(chosen[p] != 0 && is_sunk(world, static_cast<std::uint32_t>(p))));
  }
  normals_ = melted_normals(s, chosen, bare, melting * static_cast<double>(mean_));
}

Vec Body::normal_at(const World& world, const Hit& hit) const {
  if (!touches(hit))
    return hit.normal;
  const Corners& t = world.surface().triangles[hit.triangle];
  const Vec n = (1 - hit.u - hit.v) * normals_[t[0]] + hit.u * normals_[t[1]] + hit.v * normals_[t[2]];
  return n.norm() > 1e-3F ? Vec(n.normalized()) : hit.face;
}

// So far along a ray that leaves a layer at `hit` the body goes on.
float Body::gap_at(const World& world, const Hit& hit, const Vec& direction) const {
  if (!touches(hit))
    return 0;
  const float widest = widest_gap * std::max(world.thickness_at(hit), mean_) / static_cast<float>(world.unit());
  return widest / std::max(std::abs(direction.dot(hit.face)), 1 / longest_gap);
}

Within Body::after(const World& world, const Hit& hit, const Vec& direction, bool inside) const {
  const bool leaves = !inside && direction.dot(hit.face) > 0;
  return {inside, leaves ? gap_at(world, hit, direction) : 0};
}

bool Body::passes(const World& world, const Hit& hit, const Vec& direction, Within& within) const {
  if (hit.id != sheet_id || !world.surface().closed)
    return false;
  const bool leaves = direction.dot(hit.face) > 0;
  // A face that leads out is passed from a gap too: that which leads in lies so near before it that rays skip it.
  const bool inside = within.layer ? leaves || touches(hit) : within.gap > 0 && (leaves || hit.distance <= within.gap);
  if (inside)
    within = after(world, hit, direction, !leaves);
  return inside;
}

float Body::depth(const World& world, const Hit& hit, const Vec& way, float cosine, std::uint64_t& rays) const {
  const float own = world.thickness_at(hit);
  const bool enters = way.dot(hit.face) < 0;
  Within within = after(world, hit, way, enters);
  Ray ray = leave(hit, way);
  float length = 0, inside = 0; // of the way, and up to the last face that leads out
  int faces = 0;
  for (; faces < most_faces; ++faces) {
    ++rays;
    const Hit next = world.nearest(ray);
    if (!next.anything())
      break;
    if (!passes(world, next, way, within)) {
      if (within.layer && next.id != sheet_id) // the liquid ends at a solid
        inside = length + next.distance;
      break;
    }
    length += next.distance;
    if (!within.layer)
      inside = length;
    ray = leave(next, way);
  }
  const float deep = inside * cosine * static_cast<float>(world.unit());
  if (enters)
    return faces > 1 ? deep : own;
  return own + deep;
}

float Body::deepest(float thickest) const { return touching_.empty() ? thickest : most_layers * thickest; }

} // namespace sheet::render
