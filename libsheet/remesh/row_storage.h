// SPDX-License-Identifier: GPL-3.0-or-later
// An array used as rows by slot: it grows by more than is asked for, so that many small growths stay cheap.
#pragma once
#include <algorithm>

#include "formats/cpp/stream_frame.h"

namespace sheet::remesh {

inline std::size_t row_size(const formats::Array& array) { return formats::size_of(array.type) * array.components; }
inline std::byte* row_at(formats::Array& array, std::size_t row) { return array.data.data() + row * row_size(array); }
inline void grow_rows(formats::Array& array, std::size_t rows) {
  if (rows <= array.rows)
    return;
  array.rows = std::max<std::size_t>(rows, array.rows + array.rows / 2);
  array.data.resize(array.rows * row_size(array));
}

} // namespace sheet::remesh
