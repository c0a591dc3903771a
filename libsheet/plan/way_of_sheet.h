// SPDX-License-Identifier: GPL-3.0-or-later
// Where a sheet comes by itself.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/solid/distance.h"

namespace sheet {

// Of a frame with its thickness, from its place to where it is after a fall by `fall` [m]; empty of an empty frame.
[[nodiscard]] solid::Box3 way_of_sheet(const formats::Frame& frame, const Vector3& fall);

// The middle one of a box's three sizes [m]: of a flat sheet, its width.
[[nodiscard]] double middle_size(const solid::Box3& box);

} // namespace sheet
