// SPDX-License-Identifier: GPL-3.0-or-later
// Necks: where what was a bag or a tube has drawn so narrow that three edges go round it. Nothing narrower is a
// manifold, so its triangles sharpen as it draws out, unless their edges get as short as it is wide.
#pragma once
#include <vector>

#include "libsheet/remesh/editable_sheet.h"

namespace sheet::remesh {

// At each vertex of three edges that go round a neck, the least of their lengths [m], where that is below `widest` and
// none is longer than twice that; infinite at others. A neck has at least a few dozen triangles on either side: what
// three edges close with less is a pocket, which the repairs see to.
[[nodiscard]] std::vector<double> neck_widths(const EditableSheet& sheet, double widest);

} // namespace sheet::remesh
