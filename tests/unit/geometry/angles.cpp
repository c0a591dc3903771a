// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

using namespace sheet;

namespace {

// From -range to range, not a whole number of vectors or blocks.
std::vector<double> spread(double range) {
  constexpr int count = 5003;
  std::vector<double> result(count);
  for (int i = 0; i < count; ++i)
    result[static_cast<std::size_t>(i)] = range * (2.0 * i / (count - 1) - 1);
  return result;
}

} // namespace

TEST(Angles, SinesAndCosinesAreThoseOfTheStandardLibrary) {
  for (const double range : {1e-8, 1.0, 4.0, 1000.0}) {
    const std::vector<double> angles = spread(range);
    std::vector<double> sine(angles.size()), cosine(angles.size());
    sines_and_cosines(angles, sine, cosine);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      EXPECT_NEAR(sine[i], std::sin(angles[i]), 1e-15 * std::min(1.0, range)) << angles[i];
      EXPECT_NEAR(cosine[i], std::cos(angles[i]), 1e-15) << angles[i];
    }
  }
}

TEST(Angles, OfPointsAllAroundAreThoseOfTheStandardLibrary) {
  const std::vector<double> wanted = spread(0.999999 * std::numbers::pi);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double radius = std::exp(0.01 * static_cast<double>(i % 1000) - 5);
    x.push_back(radius * std::cos(wanted[i]));
    y.push_back(radius * std::sin(wanted[i]));
  }
  const std::vector<double> sides = y;
  angles_of(x, y);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(y[i], std::atan2(sides[i], x[i]), 2e-15) << wanted[i];
  std::vector<double> nothing{0.0};
  angles_of(std::vector{1.0}, nothing);
  EXPECT_EQ(nothing[0], 0);
}

TEST(Angles, HaveTheSameBitsForAnyNumberOfThreads) {
  const std::vector<double> angles = spread(3);
  std::vector<double> sine(angles.size()), cosine(angles.size()), first_sine, first_cosine;
  for (const int threads : {1, 2, 3, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    sines_and_cosines(angles, sine, cosine);
    if (first_sine.empty())
      first_sine = sine, first_cosine = cosine;
    EXPECT_EQ(sine, first_sine) << threads;
    EXPECT_EQ(cosine, first_cosine) << threads;
  }
}
