// SPDX-License-Identifier: GPL-3.0-or-later
// Sines, cosines and angles of many numbers at once, by the C library's vector functions where it has them (to 4 units
// in the last place). The same bits for any number of threads.
#pragma once
#include <span>

namespace sheet {

// sine, cosine: as long as `angles` [rad].
void sines_and_cosines(std::span<const double> angles, std::span<double> sine, std::span<double> cosine);

// The angles of the points (x, y) from the x axis, -π to π [rad]; y is replaced by them.
void angles_of(std::span<const double> x, std::span<double> y);

} // namespace sheet
