// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/packed_numbers.h"

#include <vector>
#include <zlib.h>

#include "formats/cpp/base64.h"
#include "libsheet/base/error.h"

namespace sheet::view {
namespace {

// Differences wrap around, so every 32-bit number can be packed and comes back.
std::uint32_t zigzag(std::uint32_t difference) { return difference << 1 ^ (difference >> 31 != 0 ? ~0U : 0U); }

void add_planes(std::span<const std::uint32_t> numbers, std::string& bytes) {
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t n : numbers)
      bytes.push_back(static_cast<char>(n >> shift & 0xff));
}

} // namespace

void PackedNumbers::add(std::span<const std::int32_t> numbers) {
  std::vector<std::uint32_t> differences;
  std::uint32_t before = 0;
  for (const std::int32_t n : numbers) {
    const auto now = static_cast<std::uint32_t>(n);
    differences.push_back(zigzag(now - before));
    before = now;
  }
  add_planes(differences, bytes_);
}

void PackedNumbers::add(std::span<const std::int32_t> numbers, std::span<const std::int32_t> before) {
  std::vector<std::uint32_t> differences;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    differences.push_back(zigzag(static_cast<std::uint32_t>(numbers[i]) - static_cast<std::uint32_t>(before[i])));
  add_planes(differences, bytes_);
}

void PackedNumbers::add_bytes(std::span<const std::uint8_t> bytes) {
  bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::string PackedNumbers::text() const {
  uLongf size = compressBound(bytes_.size());
  std::string compressed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(bytes_.data()),
                bytes_.size(), 6) != Z_OK)
    fail(ExitCode::internal, "zlib could not compress {} bytes", bytes_.size());
  compressed.resize(size);
  std::string text;
  formats::append_base64(text, compressed);
  return text;
}

} // namespace sheet::view
