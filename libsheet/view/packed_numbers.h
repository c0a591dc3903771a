// SPDX-License-Identifier: GPL-3.0-or-later
// Whole numbers packed for the page: differences, zigzag (0, -1, 1, -2 become 0, 1, 2, 3), the lowest byte of all, then
// the next of all, four planes; what has been packed is compressed in one piece (zlib, RFC 1950) and written as base64.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace sheet::view {

class PackedNumbers {
public:
  // Each number's difference from the one before it (from 0 the first).
  void add(std::span<const std::int32_t> numbers);
  // Each number's difference from that of the same row in `before`, which has as many.
  void add(std::span<const std::int32_t> numbers, std::span<const std::int32_t> before);
  // Bytes as they are.
  void add_bytes(std::span<const std::uint8_t> bytes);
  // Compressed, in base64.
  [[nodiscard]] std::string text() const;

private:
  std::string bytes_;
};

} // namespace sheet::view
