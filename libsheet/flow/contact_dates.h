// SPDX-License-Identifier: GPL-3.0-or-later
// Since when the vertices of a sheet touch another layer. SI units.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::flow {

// Towards the positive face and towards the other one [s]; ContactSpring::undated where nothing touches.
using Dates = std::array<double, 2>;

// For each vertex, by the array contact_since (absent: now): of several contacts on one side the oldest counts. What
// touches among neighbours that all have touched for longer has so, too: the mesh has got a vertex there. Where there
// is no contact, as in a bend, the youngest of the neighbours' that have one. areas: of the mesh's triangles.
[[nodiscard]] std::vector<Dates> contact_dates(const formats::Frame& frame, const Connectivity& mesh,
                                               std::span<const TriangleArea> areas);

} // namespace sheet::flow
