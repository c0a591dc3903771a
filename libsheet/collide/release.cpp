// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/release.h"

namespace sheet::collide {

std::vector<std::uint32_t> pulled_off(const StepPath& path, const solid::Solids& solids, std::span<const Vector3> force,
                                      double adhesion, std::span<const double> area) {
  std::vector<std::uint32_t> off;
  for (std::uint32_t v = 0; v < force.size(); ++v) {
    if (path.touch[v] == no_solid || force[v].isZero(0))
      continue;
    const auto solid = static_cast<std::size_t>(path.touch[v]);
    const Vector3 normal = solids.at(solid, path.end[v], path.end_time).normal;
    if (-force[v].dot(normal) > adhesion * area[v])
      off.push_back(v);
  }
  return off;
}

} // namespace sheet::collide
