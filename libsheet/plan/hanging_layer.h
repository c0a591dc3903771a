// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that hang below solids, as varnish below a ceiling: in nature their weight gathers them to drops.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of a sheet a tenth of which hangs at the start below a solid that does not turn, along which it flows or slips, where
// it would begin to gather to drops within five times the run, until `until` [s]. What deviates there grows at k by
// (h³/(3 mu)) (rho g k² - gamma k⁴), fastest at k² = rho g/(2 gamma), by e within 12 mu gamma/((rho g)² h³) [Fermigier,
// Limat, Wesfreid, Boudinet, Quilliet 1992, J. Fluid Mech. 236], and nothing faster than at k h = 1, within 3 mu/(rho g
// h); g is gravity's part away from the solid. Such a layer feels none of that (docs/flow-on-solids.md). "" where it is
// narrower than these drops are apart, or a yield stress bears it.
[[nodiscard]] std::string hanging_layer_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
