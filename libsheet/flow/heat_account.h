// SPDX-License-Identifier: GPL-3.0-or-later
// Running sums of the heat ρ c V T [J] that liquid takes along where it enters or leaves a sheet.
#pragma once
#include "libsheet/scene/scene.h"
#include "libsheet/sheet/account.h"

namespace sheet {

// Adds the heat of `warmth`, a sum of volume x temperature, of liquids by their densities over that of the scene's own
// (FrameLiquids::relative_density) [m³ K]; nothing in scenes without heat.
inline void add_heat_to_account(formats::Frame& frame, std::string_view name, const Scene& scene, double warmth) {
  if (!scene.heat)
    return;
  const double heat = scene.material.density * scene.heat->specific_heat * warmth;
  add_to_account(frame, name, "J", {&heat, 1});
}

} // namespace sheet
