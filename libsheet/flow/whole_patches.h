// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that may be taken from a sheet without leaving anything odd.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/geometry/connectivity.h"

namespace sheet::flow {

// Gives back triangles until none is `odd` (asked anew each time), patches that hang together across edges are
// no crumbs (tear_cuts.h), nothing with fewer is left over beside them, and what stays around a vertex is one fan.
void leave_whole_patches(const Connectivity& mesh, const std::function<bool(std::uint32_t)>& odd,
                         std::vector<bool>& taken);

} // namespace sheet::flow
