// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/leaning.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libsheet/base/each.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/mean_normals.h"

namespace sheet {

namespace {

constexpr double greatest_lean = 80 * std::numbers::pi / 180;

std::vector<Vector3> normals_of(const State& state) {
  std::vector<Vector3> normals(state.mesh->triangles.size());
  each_in_parallel(normals.size(), [&](std::size_t i) {
    const Corners& t = state.mesh->triangles[i];
    normals[i] = TriangleArea(state.positions[t[0]], state.positions[t[1]], state.positions[t[2]]).normal;
  });
  return normals;
}

// Most sheets have nothing to limit, which shows at little cost: folds of less than 114 degrees, where the mean is less
// than 57 from either normal, and directors within 23 degrees of that mean.
bool may_lean_far(const State& state, std::span<const Vector3> normals) {
  constexpr double small = greatest_lean - 57 * std::numbers::pi / 180, fold = -0.4; // cos 113.6°
  for (std::size_t e = 0; e < state.director_angles.size(); ++e) {
    const auto& [a, b] = state.mesh->edge_triangles[e];
    if (std::abs(state.director_angles[e]) > small ||
        (a != no_index && b != no_index && normals[a].dot(normals[b]) < fold))
      return true;
  }
  return false;
}

} // namespace

void limit_leaning(State& state, const std::vector<Hold>& holds) {
  std::vector<double>& angles = state.director_angles;
  if (std::ranges::all_of(angles, [](double angle) { return angle == 0; }))
    return;
  const std::vector<Vector3> normals = normals_of(state);
  if (!may_lean_far(state, normals))
    return;
  const std::vector<double> before = angles;
  const std::vector<EdgeFrame> means = mean_normal_frames(*state.mesh, state.positions);
  each_in_parallel(angles.size(), [&](std::size_t e) {
    double cosine = 1; // of the angle from the mean to the normals of the edge's triangles
    for (const auto side : state.mesh->edge_triangles[e])
      if (side != no_index)
        cosine = std::min(cosine, normals[side].dot(means[e].director));
    const double most = std::max(0.0, greatest_lean - std::acos(std::max(cosine, -1.0)));
    angles[e] = std::clamp(angles[e], -most, most);
  });
  for (const Hold& hold : holds)
    for (const std::uint32_t edge : hold.clamped_edges)
      angles[edge] = before[edge];
}

} // namespace sheet
