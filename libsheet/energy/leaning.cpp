// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/leaning.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/mean_normals.h"

namespace sheet {

namespace {

constexpr double kGreatestLean = 80 * std::numbers::pi / 180;

// The angle from the mean of the normals at the edge to those of its triangles [rad].
double half_fold(const State& state, std::size_t edge, const Vector3& mean) {
  double greatest = 0;
  for (const auto side : state.mesh->edge_triangles[edge])
    if (side != kNone) {
      const Triangle& t = state.mesh->triangles[side];
      const Vector3 normal = TriangleArea(state.positions[t[0]], state.positions[t[1]], state.positions[t[2]]).normal;
      greatest = std::max(greatest, std::acos(std::clamp(normal.dot(mean), -1.0, 1.0)));
    }
  return greatest;
}

} // namespace

void limit_leaning(State& state, const std::vector<Hold>& holds) {
  std::vector<double>& angles = state.director_angles;
  if (std::ranges::all_of(angles, [](double angle) { return angle == 0; }))
    return;
  const std::vector<double> before = angles;
  const std::vector<EdgeFrame> means = mean_normal_frames(*state.mesh, state.positions);
  for (std::size_t e = 0; e < angles.size(); ++e) {
    const double most = std::max(0.0, kGreatestLean - half_fold(state, e, means[e].director));
    angles[e] = std::clamp(angles[e], -most, most);
  }
  for (const Hold& hold : holds)
    for (const std::uint32_t edge : hold.clamped_edges)
      angles[edge] = before[edge];
}

} // namespace sheet
