// SPDX-License-Identifier: GPL-3.0-or-later
// What several steps took is the sum of what each took.
#include "libsheet/solve/step_report.h"

#include <gtest/gtest.h>

namespace sheet {
namespace {

TEST(StepReport, CountsAndTimesAddUp) {
  StepReport one, two;
  one.substeps = 1, one.rejected = 2, one.inaccurate = 1, one.seconds_analysis = 0.5;
  one.terms = {{"membrane", 1}, {"gathering", 2}};
  two.substeps = 4, two.rejected = 3, two.inaccurate = 1, two.seconds_analysis = 0.25;
  two.terms = {{"gathering", 3}, {"inertia", 5}};
  two.newton.iterations = 7;
  one += two;
  EXPECT_EQ(one.substeps, 5);
  EXPECT_EQ(one.rejected, 5);
  EXPECT_EQ(one.inaccurate, 2);
  EXPECT_EQ(one.newton.iterations, 7);
  EXPECT_EQ(one.seconds_analysis, 0.75);
  ASSERT_EQ(one.terms.size(), 3u);
  EXPECT_EQ(one.terms[1].seconds, 5);
  EXPECT_EQ(one.terms[2].name, "inertia");
}

TEST(StepReport, TheWorstVertexIsThatOfTheGreaterError) {
  StepReport little, much;
  little.error = 1e-3, little.worst = 3;
  much.error = 1e-2, much.worst = 8;
  StepReport both = little;
  both += much;
  EXPECT_EQ(both.worst, 8u);
  both += little;
  EXPECT_EQ(both.error, 1e-2);
  EXPECT_EQ(both.worst, 8u);
}

} // namespace
} // namespace sheet
