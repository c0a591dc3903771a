// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/drop_densities.h"

#include "libsheet/base/error.h"

namespace sheet::scene {

std::vector<double> densities_of(std::span<const Drop> drops, const Scene& scene) {
  const std::vector<Liquid> liquids = liquids_of(scene);
  std::vector<double> densities;
  for (const Drop& drop : drops) {
    if (drop.liquid >= liquids.size())
      fail(ExitCode::bad_input, "array \"drop_liquid\": drop {} is of liquid {}, the scene has {} (from 0)",
           densities.size(), drop.liquid, liquids.size());
    densities.push_back(liquids[drop.liquid].density);
  }
  return densities;
}

} // namespace sheet::scene
