// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/threads.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "libsheet/flow/strand_width.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr double longest_side = 2, greatest_height = 0.5; // of the shortest edge
constexpr double greatest_volume = 1e-3;                  // of the triangles' mean
constexpr double greatest_section = 1;                    // of the height's square
constexpr double round_section = 4 / std::numbers::pi;    // of a round thread's, π/4 of its thickness wide

// Triangles as small as those of threads of such edges, with less than `most` of the mean volume, and with a section
// below `section` times the square of the greatest height.
std::vector<bool> small_ones(const Frame& frame, double shortest_edge, double most, double section) {
  const auto x = positions(frame);
  const auto volume = volumes(frame);
  const double mean =
      std::accumulate(volume.begin(), volume.end(), 0.0) / static_cast<double>(std::max<std::size_t>(1, volume.size()));
  const double height = greatest_height * shortest_edge;
  std::vector<bool> small(frame.triangles, false);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    if (!(volume[t] < most * mean))
      continue;
    const Corners& c = triangles(frame)[t];
    const double side = std::max({(x[c[1]] - x[c[0]]).norm(), (x[c[2]] - x[c[1]]).norm(), (x[c[0]] - x[c[2]]).norm()});
    const double area = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area, own = 2 * area / side;
    small[t] =
        side < longest_side * shortest_edge && own < height && own * volume[t] < section * height * height * area;
  }
  return small;
}

// Triangles of strands that are narrower than the scene lets them be; those of which that could be.
std::vector<bool> snapping_ones(const Frame& frame, const Scene& scene) {
  if (!scene.tear || !scene.tear->snap)
    return std::vector<bool>(frame.triangles, false);
  return small_ones(frame, *scene.tear->snap / greatest_height, std::numeric_limits<double>::infinity(), round_section);
}

// Of these, those that are, measured across the strand.
void leave_wide_ones(const Frame& frame, const Connectivity& mesh, double snap, std::vector<bool>& snapping) {
  const auto x = positions(frame);
  const std::vector<double> width = strand_widths(mesh, x);
  for (std::size_t t = 0; t < snapping.size(); ++t)
    if (snapping[t]) {
      const Corners& c = mesh.triangles[t];
      const double thickness = volumes(frame)[t] / TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
      snapping[t] = width[t] < snap && width[t] * thickness < round_section * snap * snap;
    }
}

// Vertices of the inlet, and what is held.
std::vector<bool> prescribed(const Frame& frame, const Scene& scene) {
  std::vector<bool> result;
  for (const Axes axes : scene::prescribed_axes(frame, scene, frame.time))
    result.push_back(axes != 0);
  return result;
}

// Of the small ones, those that hang together across edges with others of which each has a corner on a rim: strands of
// two triangles' width. What is fine within, too, is no strand.
std::vector<bool> in_strands(const Connectivity& mesh, const std::vector<bool>& small, const std::vector<bool>& fixed) {
  std::vector<bool> on_rim(mesh.vertices, false), leaves(small.size(), false), wide(small.size(), false);
  DisjointSets strands(small.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [one, other] = mesh.edge_triangles[e];
    if (mesh.on_rim(e))
      on_rim[mesh.edges[e][0]] = on_rim[mesh.edges[e][1]] = true;
    else if (small[one] && small[other])
      strands.join(one, other);
  }
  const auto any = [](const Corners& c, const std::vector<bool>& of) { return of[c[0]] || of[c[1]] || of[c[2]]; };
  for (std::uint32_t t = 0; t < small.size(); ++t)
    if (small[t] && !any(mesh.triangles[t], on_rim))
      wide[strands.find(t)] = true;
  for (std::uint32_t t = 0; t < small.size(); ++t)
    leaves[t] = small[t] && !wide[strands.find(t)] && !any(mesh.triangles[t], fixed);
  return leaves;
}

// Of the pieces that are left, those that leave too: smaller than a crumb, free, and beside what leaves.
void add_crumbs(const Connectivity& mesh, const std::vector<bool>& fixed, std::vector<bool>& leaves) {
  DisjointSets pieces(leaves.size());
  for (const auto& [one, other] : mesh.edge_triangles)
    if (one != no_index && other != no_index && !leaves[one] && !leaves[other])
      pieces.join(one, other);
  std::vector<bool> beside(mesh.vertices, false);
  for (std::size_t t = 0; t < leaves.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      beside[v] = beside[v] || leaves[t];
  std::vector<std::size_t> size(leaves.size(), 0);
  std::vector<bool> came_off(leaves.size(), false), stays(leaves.size(), false);
  for (std::uint32_t t = 0; t < leaves.size(); ++t) {
    const std::uint64_t piece = pieces.find(t);
    ++size[piece];
    for (const std::uint32_t v : mesh.triangles[t]) {
      came_off[piece] = came_off[piece] || beside[v];
      stays[piece] = stays[piece] || (!leaves[t] && fixed[v]);
    }
  }
  for (std::uint32_t t = 0; t < leaves.size(); ++t)
    if (const std::uint64_t piece = pieces.find(t); size[piece] < crumb && came_off[piece] && !stays[piece])
      leaves[t] = true;
}

} // namespace

Shed cut_threads(Frame& frame, const Scene& scene, double shortest_edge) {
  std::vector<bool> small = small_ones(frame, shortest_edge, greatest_volume, greatest_section),
                    snapping = snapping_ones(frame, scene);
  const bool any_snapping = std::ranges::count(snapping, true) > 0;
  if (std::ranges::count(small, true) == 0 && !any_snapping)
    return {};
  const Connectivity mesh = connect(frame.vertices, triangles(static_cast<const Frame&>(frame)));
  if (any_snapping)
    leave_wide_ones(frame, mesh, *scene.tear->snap, snapping);
  for (std::size_t t = 0; t < small.size(); ++t)
    small[t] = small[t] || snapping[t];
  const std::vector<bool> fixed = prescribed(frame, scene);
  std::vector<bool> leaves = in_strands(mesh, small, fixed);
  if (std::ranges::count(leaves, true) == 0)
    return {};
  add_crumbs(mesh, fixed, leaves);
  if (std::ranges::count(leaves, false) == 0)
    return {};
  return shed_off(frame, std::move(leaves), scene);
}

} // namespace sheet::flow
