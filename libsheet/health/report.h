// SPDX-License-Identifier: GPL-3.0-or-later
// Trouble in words.
#pragma once
#include <string>

#include "libsheet/health/record.h"

namespace sheet::health {

// "thin: the sheet is down to 1e-05 of its thickness at the start, at (0, 0.1, 0) m, t = 0.5 s, on 3 % of its area",
// and what to do about it. Precondition: the row's kind is known.
[[nodiscard]] std::string sentence(const Row& row);
[[nodiscard]] std::string remedy(const Row& row);

// All that the frame's run has seen and that is worth a word, the serious first, with counts; "" if there is nothing.
[[nodiscard]] std::string report(const formats::Frame& frame);

} // namespace sheet::health
