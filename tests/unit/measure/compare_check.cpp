// SPDX-License-Identifier: GPL-3.0-or-later
// compare() and check(); the golden files under tests/golden/diff and check show the rest.
#include <limits>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/measure/check.h"
#include "libsheet/measure/compare.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

using Eigen::Vector3d;

formats::Frame triangle(const std::vector<double>& volume = {0.001}) {
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return make_frame(x, std::vector<Corners>{{0, 1, 2}}, volume);
}

TEST(Compare, TolerancesAndNaN) {
  formats::Frame a = triangle(), b = triangle();
  EXPECT_TRUE(compare(a, b, {}).empty());
  positions(b)[1][0] = 1 + 1e-9;
  positions(a)[2][2] = positions(b)[2][2] = std::numeric_limits<double>::quiet_NaN();
  positions(b)[0][0] = -0.0;
  EXPECT_EQ(compare(a, b, {}).size(), 1);
  CompareOptions options;
  options.floats.absolute = 1e-8;
  EXPECT_TRUE(compare(a, b, options).empty());
  options.floats = {0, 1e-8};
  EXPECT_TRUE(compare(a, b, options).empty());
  options.arrays["position"] = {1e-12, 0};
  EXPECT_EQ(compare(a, b, options).size(), 1);
  options.ignored.insert("position");
  EXPECT_TRUE(compare(a, b, options).empty());
  positions(b)[2][2] = 0; // NaN against a number is beyond every finite tolerance
  options = {};
  options.floats = {1e300, 1};
  EXPECT_EQ(compare(a, b, options).size(), 1);
}

TEST(Compare, IntegersNeedAToleranceOfTheirOwn) {
  formats::Frame a = triangle(), b = triangle();
  for (auto [frame, value] : {std::pair{&a, INT64_MIN}, std::pair{&b, INT64_MAX}}) {
    auto array =
        formats::make_array("count", formats::Place::frame, formats::Type::int64, 1, "1", formats::Transfer::copy, 1);
    array.values<std::int64_t>()[0] = value;
    frame->put(std::move(array));
  }
  CompareOptions options;
  options.floats.absolute = 1e300;
  ASSERT_EQ(compare(a, b, options).size(), 1);
  EXPECT_NE(compare(a, b, options)[0].find("1.84467e+19"), std::string::npos);
  add_tolerance(options, "count=2e19");
  EXPECT_TRUE(compare(a, b, options).empty());
}

TEST(Compare, ToleranceTexts) {
  CompareOptions options;
  add_tolerance(options, "volume=1e-9,0.5");
  EXPECT_EQ(options.arrays.at("volume").relative, 0.5);
  for (const char* bad : {"volume", "=1", "volume=", "volume=-1", "volume=1,", "volume=1,x", "volume=nan"})
    EXPECT_THROW(add_tolerance(options, bad), Error) << bad;
}

std::vector<std::string> kinds(const formats::Frame& frame) {
  std::vector<std::string> found;
  for (const Finding& f : check(frame, {}))
    found.emplace_back(f.kind);
  return found;
}
using Kinds = std::vector<std::string>;

TEST(Check, GoodFrames) {
  EXPECT_EQ(kinds(triangle()), Kinds{});
  EXPECT_EQ(kinds(make_frame({}, {}, {})), Kinds{});
}

TEST(Check, ShapesThatTheFormatRefuses) {
  formats::Frame frame = triangle();
  frame.erase("volume");
  EXPECT_EQ(kinds(frame), Kinds{"rule"});
  frame.put(
      formats::make_array("volume", formats::Place::frame, formats::Type::text, 1, "1", formats::Transfer::copy, 0));
  EXPECT_EQ(kinds(frame), Kinds{"rule"});
  frame = triangle();
  put_number(frame, "step_size", -1);
  put_number(frame, "next_output_time", "m", 1);
  EXPECT_EQ(check(frame, {})[0].count, 2);
  put_number(frame, "next_output_time", std::numeric_limits<double>::infinity());
  EXPECT_EQ(kinds(frame), (Kinds{"rule", "not_finite"}));
}

TEST(Check, BadNumbersDoNotHideTheRest) {
  formats::Frame frame = triangle({0});
  positions(frame)[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kinds(frame), (Kinds{"not_finite", "volume"}));
}

TEST(Check, LongListsAreCut) {
  std::vector<Vector3d> x(3000, Vector3d(1, 2, 3));
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 1000; ++i)
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  const auto findings = check(make_frame(x, t, std::vector<double>(1000, -1)), {.intersections = true, .examples = 4});
  ASSERT_EQ(findings.size(), 2);
  EXPECT_EQ(findings[0].count, 1000);
  EXPECT_EQ(findings[1].kind, "degenerate");
  EXPECT_EQ(findings[1].examples.size(), 4);
}

} // namespace
} // namespace sheet
