// SPDX-License-Identifier: GPL-3.0-or-later
// Running sums in a frame, for what enters and leaves the sheet: an array at place frame with two rows, the sums and
// what rounding has left out of them [Kahan 1965], so that a million small amounts add up to the last digit.
#pragma once
#include <span>

#include "libsheet/sheet/sheet.h"

namespace sheet {

// Adds amounts, a component each; the account is opened at zero. Throws Error (bad_input) where an array of that name
// is something else.
void add_to_account(formats::Frame& frame, std::string_view name, std::string_view unit,
                    std::span<const double> amounts);

} // namespace sheet
