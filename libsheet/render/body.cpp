// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/render/melted_normals.h"
#include "libsheet/render/near_layers.h"
#include "libsheet/render/rounded.h"

namespace sheet::render {
namespace {

constexpr float longest_gap = 4;               // along a ray, in gaps
constexpr double outset = 3e-6;                // in units of the world: some of the steps by which rays leave a face
constexpr double melting = 2.5;                // in mean thicknesses: so far normals are smoothed
constexpr std::size_t most_to_round = 100'000; // triangles of the surface
constexpr float long_edge = 3;    // in thicknesses: where edges are longer what is round goes over to flat,
constexpr float longest_edge = 5; // since their folds are sharp
constexpr int most_faces = 256;   // that a depth is looked for behind
constexpr float most_layers = 32; // that a body is told to be deep

// The longest edge at each vertex of the sheet [m].
std::vector<float> longest_edges(const Surface& s) {
  std::vector<float> result(s.thickness.size());
  for (const Corners& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t j : {i, (i + 1) % 3}) {
        float& longest = result[s.source_vertex[t[j]]];
        longest = std::max(longest, static_cast<float>((s.positions[t[(i + 1) % 3]] - s.positions[t[i]]).norm()));
      }
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

std::unique_ptr<World> world_of_bodies(const Surface& surface, const std::vector<SolidMesh>& meshes,
                                       const std::vector<Eigen::Isometry3d>& motions, const std::vector<Plane>& planes,
                                       const Box& box) {
  auto world = std::make_unique<World>(surface, meshes, motions, planes, box);
  const float mean = mean_thickness(surface);
  std::vector<float> roundness = surface.closed ? near_layers(*world, mean).closeness : std::vector<float>();
  if (roundness.empty())
    return world;
  const std::vector<float> edges = longest_edges(surface);
  float longest = 0; // of those that are made round, in thicknesses
  for (std::size_t v = 0; v < edges.size(); ++v) {
    const float length = edges[v] / std::max(surface.thickness[v], mean);
    roundness[v] *= 1 - smooth_step(long_edge, longest_edge, length);
    longest = roundness[v] > 0 ? std::max(longest, length) : longest;
  }
  Surface larger = surface;
  for (; longest > 1 && larger.triangles.size() <= most_to_round; longest /= 2)
    larger = rounded(larger, roundness);
  for (std::size_t p = 0; p < larger.positions.size(); ++p)
    larger.positions[p] += outset * world->unit() * larger.normals[p].cast<double>();
  return std::make_unique<World>(larger, meshes, motions, planes, box);
}

Body::Body(const World& world) {
  const Surface& s = world.surface();
  if (!s.closed)
    return;
  mean_ = mean_thickness(s);
  const NearLayers near = near_layers(world, mean_);
  if (near.closeness.empty())
    return;
  for (const Corners& t : s.triangles)
    touching_.push_back(static_cast<char>(
        std::any_of(t.begin(), t.end(), [&](std::uint32_t p) { return near.closeness[s.source_vertex[p]] > 0; })));
  normals_ =
      melted_normals(s, near.closeness, covered_by_others(world, mean_, near), melting * static_cast<double>(mean_));
}

Vec Body::normal_at(const World& world, const Hit& hit) const {
  if (!touches(hit))
    return hit.normal;
  const Corners& t = world.surface().triangles[hit.triangle];
  const Vec n = (1 - hit.u - hit.v) * normals_[t[0]] + hit.u * normals_[t[1]] + hit.v * normals_[t[2]];
  return n.norm() > 1e-3F ? Vec(n.normalized()) : hit.face;
}

// What gaps are measured by along a ray that leaves a layer at `hit`.
float Body::width_at(const World& world, const Face& hit, const Vec& direction) const {
  if (!touches(hit))
    return 0;
  const float width = std::max(world.thickness_at(hit), mean_) / static_cast<float>(world.unit());
  return width / std::max(std::abs(direction.dot(hit.face)), 1 / longest_gap);
}

namespace {

// The gap before the face that a ray hits, in widths. None before a face that leads out: that which leads in lies so
// near before it that rays skip it.
float gap_before(const Face& hit, const Vec& direction, const Within& within) {
  if (within.layer || within.layers > 0 || direction.dot(hit.face) > 0)
    return 0;
  return within.width > 0 ? hit.distance / within.width : std::numeric_limits<float>::infinity();
}

} // namespace

float Body::bridged(float number) { return narrow_gap + number * (wide_gap - narrow_gap); }

Within Body::after(const World& world, const Face& hit, const Vec& direction, bool enters, float bridged) const {
  const bool out = direction.dot(hit.face) > 0, inside = enters && !out, leaves = !enters && out;
  const std::uint32_t liquid = hit.id == sheet_id ? world.surface().liquid(hit.triangle) : 0;
  return {bridged, inside, inside ? 1 : 0, liquid, leaves ? width_at(world, hit, direction) : 0};
}

bool Body::is_by_chance(const Face& hit, const Vec& direction, const Within& within) {
  const float gap = hit.id == sheet_id ? gap_before(hit, direction, within) : 0;
  return gap > narrow_gap && gap < wide_gap;
}

bool Body::passes(const World& world, const Face& hit, const Vec& direction, Within& within) const {
  if (hit.id != sheet_id || !world.surface().closed)
    return false;
  const bool leaves = direction.dot(hit.face) > 0;
  if (within.layers > 0 && world.surface().liquid(hit.triangle) != within.liquid)
    return leaves; // layers of two liquids may overlap a little
  const bool inside = within.layer        ? leaves || touches(hit)
                      : within.layers > 0 ? leaves || hit.distance <= wide_gap * within.width
                                          : within.width > 0 && gap_before(hit, direction, within) <= within.bridged;
  if (inside) {
    const int layers = std::max(within.layers + (leaves ? -1 : 1), 0);
    within = after(world, hit, direction, !leaves, within.bridged);
    within.layers = layers;
  }
  return inside;
}

// The way of a ray that bridges all gaps; shorter ones of others end at one of these.
Depth Body::depth(const World& world, const Hit& hit, const Vec& way, float cosine, float bridged,
                  std::uint64_t& rays) const {
  const float own = world.thickness_at(hit), slab = cosine * static_cast<float>(world.unit());
  const bool enters = way.dot(hit.face) < 0;
  Within within = after(world, hit, way, enters, wide_gap);
  FacesAhead ahead(world, leave(hit, way));
  float inside = 0, widest = narrow_gap; // of the way; gap so far
  int faces = 0;
  Depth result;
  const auto end = [&](float gap) { // for rays that bridge what has been met, but not this gap
    const float deep = enters ? faces > 1 ? slab * inside : own : own + slab * inside;
    if (widest <= bridged)
      result.thickness = deep;
    if (result.parts < static_cast<int>(result.of_all.size()))
      result.of_all[static_cast<std::size_t>(result.parts++)] = {0, deep};
    result.of_all[static_cast<std::size_t>(result.parts - 1)].share += (gap - widest) / (wide_gap - narrow_gap);
    widest = gap;
  };
  for (; faces < most_faces; ++faces) {
    const Face next = ahead.next(rays);
    if (!next.anything())
      break;
    const float gap = gap_before(next, way, within);
    const bool ends_at_solid = within.layer && next.id != sheet_id;
    if (next.id == sheet_id && gap > widest && gap < wide_gap)
      end(gap);
    const bool goes_on = passes(world, next, way, within);
    if (gap == 0 && (goes_on || ends_at_solid))
      inside += next.distance;
    if (!goes_on)
      break;
  }
  end(wide_gap);
  return result;
}

float Body::deepest(float thickest) const { return touching_.empty() ? thickest : most_layers * thickest; }

} // namespace sheet::render
