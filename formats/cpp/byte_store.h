// SPDX-License-Identifier: MIT
// Numbers appended to binary files in little endian order.
#pragma once
#include <bit>
#include <cstring>
#include <string>

namespace sheet::formats {

template <class T> void store_number(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big)
    for (std::size_t i = sizeof(T); i-- > 0;)
      bytes += raw[i];
  else
    bytes.append(raw, sizeof(T));
}

} // namespace sheet::formats
