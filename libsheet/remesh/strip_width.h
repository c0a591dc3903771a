// SPDX-License-Identifier: GPL-3.0-or-later
// How wide the sheet is where it is a narrow strip: a strand between two holes, what a tear has left.
#pragma once
#include <vector>

#include "libsheet/remesh/editable_sheet.h"

namespace sheet::remesh {

// At each vertex how wide the strip is to which it belongs [m]: of a triangle that reaches from rim to rim (one side on
// a rim, the apex on a rim, the other sides within the sheet) its height on its rim side, across a vertex between two
// rows the way from rim to rim (flow/strand_width.h), the least of these around it; infinite at others. Ears, with two
// sides on the rim, do not count, nor does the wedge behind a corner of the rim below 60 degrees, as far as it opens a
// quarter as fast as at its tip: what is there is no better than the corner itself, however fine. A corner below
// `least_wedge` [rad] is none, but the end of a strip.
[[nodiscard]] std::vector<double> strip_widths(const EditableSheet& sheet, double least_wedge = 0);

} // namespace sheet::remesh
