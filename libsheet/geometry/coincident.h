// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie on each other, as those of a mesh that is not welded.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

// Of each point, whether another one is at most `close` away. They are sorted along x: those of one x cost the square
// of their number.
[[nodiscard]] std::vector<bool> coincident(std::span<const Vector3> points, double close);

} // namespace sheet
