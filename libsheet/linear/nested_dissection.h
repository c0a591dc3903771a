// SPDX-License-Identifier: GPL-3.0-or-later
// Nested dissection by CHOLMOD with METIS's separators.
#pragma once
#include <cstddef>
#include <vector>

#include "libsheet/linear/sparse_lower.h"

namespace sheet {

// A fill-reducing order of the rows of a matrix, of which only the structure is read [George 1973]; parts below `least`
// rows by minimum degree (CSYMAMD). order: at least as long as the rows. Throws Error (internal) where there is none.
void nested_dissection(const SparseLower& structure, std::size_t least, std::vector<int>& order);

} // namespace sheet
