// SPDX-License-Identifier: GPL-3.0-or-later
// An array used as rows by slot: it grows by more than is asked for, so that many small growths stay cheap.
#pragma once
#include <algorithm>
#include <cstring>

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

// One component of a row of floating point numbers.
inline double number_at(const formats::Array& array, std::size_t row, std::uint32_t component) {
  const std::size_t at = row * array.components + component;
  const std::byte* number = array.data.data() + at * formats::size_of(array.type);
  if (array.type == formats::Type::float64) {
    double value;
    std::memcpy(&value, number, sizeof value);
    return value;
  }
  float value;
  std::memcpy(&value, number, sizeof value);
  return value;
}
inline void set_number_at(formats::Array& array, std::size_t row, std::uint32_t component, double number) {
  std::byte* to = array.data.data() + (row * array.components + component) * formats::size_of(array.type);
  const auto single = static_cast<float>(number);
  if (array.type == formats::Type::float64)
    std::memcpy(to, &number, sizeof number);
  else
    std::memcpy(to, &single, sizeof single);
}

} // namespace sheet::remesh
