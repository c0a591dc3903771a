// SPDX-License-Identifier: GPL-3.0-or-later
// How wide an inlet is.
#pragma once
#include <cstddef>

#include "formats/cpp/stream_frame.h"

namespace sheet {

// The length of the border of the inlet of that number [m].
[[nodiscard]] double width_of_inlet(const formats::Frame& first, std::size_t inflow);

} // namespace sheet
