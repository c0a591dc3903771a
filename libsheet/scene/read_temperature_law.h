// SPDX-License-Identifier: GPL-3.0-or-later
// The part of [material] that says how viscosity and surface tension depend on temperature.
#pragma once
#include "libsheet/material/liquid.h"
#include "libsheet/scene/tables.h"

namespace sheet::scene {

// The law, and `surface_tension_slope`, into the liquid; what is wrong is reported by the table. To be read before the
// flow law: the viscosity is the law's own, where it has one and the liquid is Newtonian.
void read_temperature_law(TableReader& table, const Files& files, Liquid& liquid);

} // namespace sheet::scene
