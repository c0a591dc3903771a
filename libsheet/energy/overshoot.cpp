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

void make_up_for(State& state, std::vector<Overshoot> overshoots) {
  const auto area_vector = [&](const Corners& t, bool back) {
    std::array<Vector3, 3> x;
    for (std::size_t c = 0; c < 3; ++c)
      x[c] = back ? Vector3(state.positions[t[c]] + overshoots[t[c]].way) : state.positions[t[c]];
    return Vector3((x[1] - x[0]).cross(x[2] - x[0]));
  };
  const auto counts = [&](std::uint32_t v) { return !overshoots[v].way.isZero(0); };
  // Without one corner, another triangle may change too much.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Corners& t : state.mesh->triangles) {
      if (std::ranges::none_of(t, counts) || similar(area_vector(t, false), area_vector(t, true)))
        continue;
      for (const std::uint32_t v : t)
        overshoots[v] = {};
      changed = true;
    }
  }
  if (std::ranges::all_of(overshoots, [](const Overshoot& o) { return o.way.isZero(0); }))
    overshoots.clear();
  state.to_make_up = std::move(overshoots);
}

State put_back(const State& state, double dt) {
  constexpr double round_off = 1e-9;
  State result = state;
  result.overshoot.assign(state.to_make_up.size(), Vector3::Zero());
  bool left = false;
  for (std::size_t v = 0; v < state.to_make_up.size(); ++v) {
    const auto& [way, time] = state.to_make_up[v];
    const bool all = time <= (1 + round_off) * dt;
    result.overshoot[v] = all ? way : Vector3(dt / time * way);
    result.positions[v] += result.overshoot[v];
    result.to_make_up[v] = all ? Overshoot{} : Overshoot{way - result.overshoot[v], time - dt};
    left = left || !result.to_make_up[v].way.isZero(0);
  }
  if (!left)
    result.to_make_up.clear();
  return result;
}

void forget_overshoot(State& state) { state.to_make_up.clear(); }

} // namespace sheet
