// SPDX-License-Identifier: GPL-3.0-or-later
// A thickness that is wanted, from which the deviation is measured and shown.
#pragma once
#include <optional>

#include "formats/cpp/stream_frame.h"
#include "libsheet/base/tool.h"

namespace sheet {

// --wanted LENGTH [m]; positive.
void declare_wanted(Tool& tool, std::optional<double>& wanted);

// Gives the frame the array "deviation", thickness less `wanted` [m] of each triangle.
void want_thickness(formats::Frame& frame, double wanted);

} // namespace sheet
