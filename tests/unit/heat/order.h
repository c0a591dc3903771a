// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence.
#pragma once
#include <cmath>

#include <gtest/gtest.h>

namespace sheet::heat::test {

// That the error has fallen by this order since the resolution of half as many; the first has nothing before it.
inline void expect_order(double& before, double error, double order) {
  if (before > 0) {
    EXPECT_GT(std::log2(before / error), order) << before << " -> " << error;
  }
  before = error;
}

} // namespace sheet::heat::test
