// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/overshoot.h"

#include <algorithm>

namespace sheet {

namespace {

bool similar(const Vector3& area, const Vector3& other) {
  return area.dot(other) >= 0.5 * area.norm() * other.norm() && other.norm() >= 0.5 * area.norm() &&
         other.norm() <= 2 * area.norm();
}

} // namespace

void put_back(State& state, std::span<const Vector3> by) {
  std::vector<Vector3> overshoot(by.begin(), by.end());
  const auto area_vector = [&](const Corners& t, bool back) {
    std::array<Vector3, 3> x;
    for (std::size_t c = 0; c < 3; ++c)
      x[c] = back ? Vector3(state.positions[t[c]] + overshoot[t[c]]) : state.positions[t[c]];
    return Vector3((x[1] - x[0]).cross(x[2] - x[0]));
  };
  // Without one corner, another triangle may change too much.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Corners& t : state.mesh->triangles) {
      const bool moves = std::ranges::any_of(t, [&](std::uint32_t v) { return !overshoot[v].isZero(0); });
      if (!moves || similar(area_vector(t, false), area_vector(t, true)))
        continue;
      for (const std::uint32_t v : t)
        overshoot[v].setZero();
      changed = true;
    }
  }
  if (std::ranges::all_of(overshoot, [](const Vector3& x) { return x.isZero(0); }))
    return;
  for (std::size_t v = 0; v < overshoot.size(); ++v)
    state.positions[v] += overshoot[v];
  state.overshoot = std::move(overshoot);
}

void forget_overshoot(State& state) {
  for (std::size_t v = 0; v < state.overshoot.size(); ++v)
    state.positions[v] -= state.overshoot[v];
  state.overshoot.clear();
}

} // namespace sheet
