// SPDX-License-Identifier: GPL-3.0-or-later
// Films that are drawn up out of an inlet, and sink back through it.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of the first inflow out of which holds draw up, of a Newtonian liquid, what is too heavy before `until` [s]. What
// stands H above the inlet is stretched by the weight rho g x below each x, 4 mu dv/dx = rho g x [Trouton 1906, of a
// sheet], so at the inlet it sinks at rho g H²/(8 mu) less than what holds it rises; and tension carries 2 gamma/h of
// rho g H, as thick as it enters. It sinks back where it is higher than either allows. "" without gravity, on a bath,
// or where solids or pressure may carry it.
[[nodiscard]] std::string sinking_back_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
