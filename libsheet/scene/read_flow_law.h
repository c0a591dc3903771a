// SPDX-License-Identifier: GPL-3.0-or-later
// The part of [material] that says how viscosity depends on the rate of strain.
#pragma once
#include "libsheet/material/liquid.h"
#include "libsheet/scene/tables.h"

namespace sheet::scene {

// Viscosity and law into the liquid, whose temperature law is known; what is wrong is reported by the table. The rows
// of a `file` are the liquid's own from then on.
void read_flow_law(TableReader& table, const Files& files, Liquid& liquid);

} // namespace sheet::scene
