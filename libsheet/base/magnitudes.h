// SPDX-License-Identifier: GPL-3.0-or-later
// Frames whose numbers are valid but too large for any stage to compute with.
#pragma once
#include "formats/cpp/stream_frame.h"

namespace sheet {

// Throws Error (bad_input) at a position, start, velocity or volume of 1e30 (SI) and more: areas, volumes and energies
// made of them leave the range of double precision. Names array and row.
void check_magnitudes(const formats::Frame& frame);

} // namespace sheet
