// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

TEST(Enclosures, NumbersAreThoseThatThereAre) {
  formats::Frame frame;
  frame.triangles = 5;
  EXPECT_TRUE(enclosure_numbers(frame).empty());
  put_enclosures(std::vector<std::uint32_t>{4000000000, 0, 2, 4000000000, 2}, frame);
  EXPECT_EQ(enclosure_numbers(frame), (std::vector<std::uint32_t>{2, 4000000000}));
}

TEST(Enclosures, WhatIsSaidOfThemIsARowOfNumbersEach) {
  using namespace formats;
  Frame frame = make_frame({}, {}, {});
  EXPECT_TRUE(of_enclosures(frame, "gas.amount").empty());
  frame.put(make_array("gas.amount", Place::frame, Type::float64, 1, "m^3", Transfer::copy, 3));
  EXPECT_EQ(of_enclosures(frame, "gas.amount").size(), 3);
  frame.put(make_array("gas.amount", Place::frame, Type::int8, 1, "m^3", Transfer::copy, 3));
  EXPECT_THROW(static_cast<void>(of_enclosures(frame, "gas.amount")), Error);
  frame.put(make_array("gas.amount", Place::frame, Type::float64, 3, "m^3", Transfer::copy, 3));
  EXPECT_THROW(static_cast<void>(of_enclosures(frame, "gas.amount")), Error);
}

TEST(Masks, AreBitsOfVertices) {
  using namespace formats;
  Frame frame = make_frame({}, {}, {});
  frame.put(make_array("gas.sealed", Place::vertex, Type::uint64, 1, "1", Transfer::common, 0));
  EXPECT_TRUE(masks(frame, "gas.sealed").empty());
  frame.put(make_array("gas.sealed", Place::frame, Type::int8, 1, "1", Transfer::copy, 1));
  EXPECT_THROW(static_cast<void>(masks(frame, "gas.sealed")), Error);
}

} // namespace
} // namespace sheet
