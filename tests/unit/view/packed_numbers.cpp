// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/packed_numbers.h"

#include <gtest/gtest.h>
#include <limits>
#include <vector>
#include <zlib.h>

#include "formats/cpp/base64.h"

namespace sheet::view {
namespace {

std::string unpacked(const std::string& text, std::size_t size) {
  const std::string compressed = formats::decode_base64(text, text.size()).value();
  std::string bytes(size, '\0');
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                       reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return bytes;
}

// What the page does (page/numbers.js).
std::vector<std::int32_t> numbers(const std::string& bytes, std::size_t from, std::size_t count,
                                  const std::vector<std::int32_t>& before = {}) {
  std::vector<std::int32_t> out;
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t z = 0;
    for (std::size_t plane = 0; plane < 4; ++plane)
      z |= std::uint32_t{static_cast<std::uint8_t>(bytes[from + plane * count + i])} << 8 * plane;
    last = (before.empty() ? last : static_cast<std::uint32_t>(before[i])) + (z >> 1 ^ (0U - (z & 1)));
    out.push_back(static_cast<std::int32_t>(last));
  }
  return out;
}

constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min(),
                       most = std::numeric_limits<std::int32_t>::max();

TEST(PackedNumbers, ComeBackWhateverTheyAre) {
  const std::vector<std::int32_t> first = {0, 1, -1, 300, -70000, least, most, least, 0},
                                  second = {most, least, 5, 5, 5, most, least, -1, 0};
  PackedNumbers packed;
  packed.add(first);
  packed.add(second, first);
  packed.add_bytes(std::vector<std::uint8_t>{7, 255});
  const std::string bytes = unpacked(packed.text(), 4 * 18 + 2);
  EXPECT_EQ(numbers(bytes, 0, 9), first);
  EXPECT_EQ(numbers(bytes, 36, 9, first), second);
  EXPECT_EQ(bytes.substr(72), "\x07\xff");
}

TEST(PackedNumbers, OfNothingAreNothing) { EXPECT_EQ(unpacked(PackedNumbers().text(), 0), ""); }

TEST(PackedNumbers, ThatStayTakeNextToNoRoom) {
  const std::vector<std::int32_t> same(100000, 123456);
  PackedNumbers packed;
  packed.add(same, same);
  EXPECT_LT(packed.text().size(), 1000U);
}

} // namespace
} // namespace sheet::view
