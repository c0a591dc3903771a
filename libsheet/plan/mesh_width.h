// SPDX-License-Identifier: GPL-3.0-or-later
// How wide a solid of any shape is for what lies on it, as scene/solid_width.h says of simple ones: legs, fingers,
// handles.
#pragma once
#include "libsheet/solid/distance.h"

namespace sheet {

// Of its body, at places spread over its faces: the greater of what it measures straight through there and the least
// that it measures across, in the middle of that way. A plate is as wide as its face, however thin it is. The width
// below which a fiftieth of the places lie [m]: tips do not count. Infinite for a body so angular that it has none. The
// solid must be bounded.
[[nodiscard]] double narrow_width(const solid::SolidDistance& solid);

} // namespace sheet
