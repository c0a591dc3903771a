// SPDX-License-Identifier: GPL-3.0-or-later
// A hundredth of the liquid may err by twice the error of a step.
#include "libsheet/solve/step_error.h"

#include <vector>

#include <gtest/gtest.h>

namespace sheet {
namespace {

TEST(StepError, OfFewVerticesIsTheGreatest) {
  const StepError error = step_error(std::vector{1e-3, 7e-3, 2e-3}, std::vector{1.0, 1.0, 1.0});
  EXPECT_EQ(error.value, 7e-3);
  EXPECT_EQ(error.vertex, 1u);
}

TEST(StepError, LeavesOutAHundredthOfTheLiquid) {
  std::vector<double> errors(1000, 5e-3), volumes(1000, 1.0);
  for (std::size_t v = 100; v < 110; ++v)
    errors[v] = 8e-3 + 1e-5 * static_cast<double>(v);
  const StepError ten = step_error(errors, volumes);
  EXPECT_EQ(ten.value, 5e-3);
  EXPECT_EQ(ten.vertex, 109u);
  volumes[109] = 2; // more than a hundredth of all now
  EXPECT_EQ(step_error(errors, volumes).value, errors[100]);
  volumes[109] = 20;
  EXPECT_EQ(step_error(errors, volumes).value, errors[109]);
}

TEST(StepError, IsHalfOfTheGreatestAtLeast) {
  std::vector<double> errors(1000, 1e-5);
  errors[3] = 0.02;
  EXPECT_DOUBLE_EQ(step_error(errors, std::vector(1000, 1.0)).value, 0.01);
}

TEST(StepError, OfNothingIsNone) {
  EXPECT_EQ(step_error({}, {}).value, 0);
  EXPECT_EQ(step_error(std::vector{0.0, 0.0}, std::vector{1.0, 1.0}).value, 0);
}

} // namespace
} // namespace sheet
