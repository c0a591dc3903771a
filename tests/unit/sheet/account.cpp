// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/sheet/account.h"

namespace sheet {
namespace {

TEST(Account, AMillionSmallAmountsAddUp) {
  formats::Frame frame = make_frame({}, {}, {});
  const double large = 1e6, small = 0.1;
  add_to_account(frame, "test.volume", "m^3", {&large, 1});
  for (int i = 0; i < 1000000; ++i)
    add_to_account(frame, "test.volume", "m^3", {&small, 1});
  // 0.1 as a number is 0.1 + 5.55e-18, so the exact sum is 1.1e6 + 5.55e-12
  EXPECT_EQ(number(frame, "test.volume", 0), 1.1e6);
  EXPECT_EQ(formats::find_value_error(frame), "");
}

TEST(Account, ComponentsAreApartAndForeignArraysAreRefused) {
  formats::Frame frame = make_frame({}, {}, {});
  const std::array<double, 3> momentum{1, -2, 0.5};
  add_to_account(frame, "test.momentum", "kg*m/s", momentum);
  add_to_account(frame, "test.momentum", "kg*m/s", momentum);
  const auto values = frame.find("test.momentum")->values<double>();
  EXPECT_EQ(std::vector(values.begin(), values.end()), (std::vector<double>{2, -4, 1, 0, 0, 0}));
  put_number(frame, "test.volume", "m^3", 1);
  EXPECT_THROW(add_to_account(frame, "test.volume", "m^3", std::span(momentum).first(1)), Error);
}

TEST(Number, IsOfTheFrameAndThere) {
  using namespace formats;
  Frame frame = make_frame({}, {}, {});
  EXPECT_EQ(number(frame, "test.number", 7), 7);
  put_number(frame, "test.number", "m", 3);
  EXPECT_EQ(number(frame, "test.number", 7), 3);
  frame.put(make_array("test.number", Place::frame, Type::float64, 1, "m", Transfer::copy, 0));
  EXPECT_THROW(static_cast<void>(number(frame, "test.number", 7)), Error);
  frame.put(make_array("test.number", Place::frame, Type::int8, 1, "m", Transfer::copy, 1));
  EXPECT_THROW(static_cast<void>(number(frame, "test.number", 7)), Error);
}

} // namespace
} // namespace sheet
