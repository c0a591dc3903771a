// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/release.h"

#include <algorithm>

namespace sheet::collide {

namespace {

// Of each vertex, whether it shares a triangle with one that touches nothing.
std::vector<std::uint8_t> beside_free(const StepPath& path) {
  std::vector<std::uint8_t> beside(path.touch.size(), 0);
  for (const Corners& corners : path.triangles)
    if (std::ranges::any_of(corners, [&](std::uint32_t v) { return path.touch[v] == no_solid; }))
      for (const std::uint32_t v : corners)
        beside[v] = 1;
  return beside;
}

} // namespace

std::vector<std::uint32_t> pulled_off(const StepPath& path, const solid::Solids& solids, std::span<const Vector3> force,
                                      std::span<const Vector3> load, double adhesion, std::span<const double> area) {
  const std::vector<std::uint8_t> air = load.empty() ? std::vector<std::uint8_t>{} : beside_free(path);
  std::vector<std::uint32_t> off;
  for (std::uint32_t v = 0; v < force.size(); ++v) {
    if (path.touch[v] == no_solid || force[v].isZero(0))
      continue;
    const auto solid = static_cast<std::size_t>(path.touch[v]);
    const bool wet = !load.empty() && air[v] == 0 && solids.scene(solid).contact != SolidContact::stick;
    const Vector3& held = wet ? load[v] : force[v];
    const Vector3 normal = solids.at(solid, path.end[v], path.end_time).normal;
    if (-held.dot(normal) > adhesion * area[v])
      off.push_back(v);
  }
  return off;
}

} // namespace sheet::collide
