// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/bath_clinging.h"

#include <algorithm>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

std::string bath_clinging_warning(const Scene& scene, const formats::Frame& first) {
  constexpr double most = 3; // thicknesses
  const auto up = scene::up(scene.environment);
  const auto& bath = scene.environment.bath;
  if (!bath || !bath->clings || !up)
    return "";
  double height = 0;
  for (const Vector3& x : positions(first))
    height = std::max(height, up->dot(x) - bath->level);
  if (height <= most * *measured(first).thickness)
    return "";
  return fmt::format(
      "the sheet starts up to {:.2g} m above the bath, which clings: as if it reached up to the sheet it "
      "pulls that down from any height, by {:.2g} Pa there, and what stands upright in it folds. Without "
      "clings the sheet may fall on it, and come out of it",
      height, bath->density * scene.environment.gravity->norm() * height);
}

} // namespace sheet
