// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/loop/loop.h"
#include "libsheet/loop/pipeline.h"
#include "libsheet/loop/progress.h"

namespace sheet {
namespace {

using testing::ElementsAre;

TEST(SplitPipeline, FindsTheStages) {
  EXPECT_THAT(split_pipeline("a"), ElementsAre("a"));
  EXPECT_THAT(split_pipeline(" a -x 1 |b|  c "), ElementsAre("a -x 1", "b", "c"));
  EXPECT_THAT(split_pipeline("a 'x|y' \"p|\\\"q\" | b \\| c"), ElementsAre("a 'x|y' \"p|\\\"q\"", "b \\| c"));
  EXPECT_THAT(split_pipeline("a | (b | c) | { d | e; }"), ElementsAre("a", "(b | c)", "{ d | e; }"));
  EXPECT_THAT(split_pipeline("a 2>&1 | b"), ElementsAre("a 2>&1", "b"));
}

TEST(SplitPipeline, RefusesMoreThanOnePipeline) {
  for (const char* command : {"a; b", "a && b", "a || b", "a & b", "a | b\nc", "a |& b", "a | | b", "| a", ""})
    EXPECT_THROW((void)split_pipeline(command), Error) << command;
}

TEST(FirstFailure, BlamesTheOneThatDiedFirst) {
  PipelineEnd end;
  end.stages = {{"a", 4, false}, {"b", 141, true}, {"c", 137, true}, {"d", 4, true}};
  ASSERT_NE(first_failure(end, true), nullptr);
  EXPECT_EQ(first_failure(end, true)->command, "c");
  EXPECT_EQ(first_failure(end, false)->command, "a");
  end.stages = {{"a", 4, false}, {"b", 0, true}};
  EXPECT_EQ(first_failure(end, true), nullptr);
}

TEST(NextOutputTime, IsTheNextMultipleAndNeverTheSame) {
  for (const double fps : {1.0, 24.0, 29.97, 30.0, 1000.0, 1e-3}) {
    double time = 0;
    for (int k = 1; k <= 2000; ++k) {
      const double next = next_output_time(time, fps);
      ASSERT_EQ(next, k / fps) << "fps " << fps << ", k " << k;
      // A time just before its output time must not be passed over.
      ASSERT_EQ(next_output_time(std::nextafter(next, 0), fps), next);
      time = next;
    }
  }
  EXPECT_EQ(next_output_time(-0.3, 10), -0.2);
}

TEST(NextOutputTime, IsRefusedWhereNumbersCannotTellItFromTheLast) {
  EXPECT_EQ(next_output_time(0, 1e300), 1e-300);
  EXPECT_EQ(next_output_time(1, 1e15), 1 + 1e-15);
  for (const double fps : {1e16, 1e17, 1e300})
    for (const double time : {1.0, -1.0, 1e10})
      EXPECT_THROW(static_cast<void>(next_output_time(time, fps)), Error) << fps << " at " << time;
}

TEST(DurationText, IsForPeople) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(59.2), "59 s");
  EXPECT_EQ(duration_text(200), "3:20 min");
  EXPECT_EQ(duration_text(7500), "2:05 h");
}

TEST(Progress, TellsTheTimeLeft) {
  const Progress by_time(0, 0, 2.0, {});
  EXPECT_EQ(by_time.line(0.5, 10, 3, 6), "step 10, t = 0.5 of 2 s, 3 frames, 0.6 s a step, 18 s left");
  const Progress by_steps(0, 100, {}, 200);
  EXPECT_EQ(by_steps.line(0.5, 150, 3, 60), "step 150 of 200, t = 0.5 s, 3 frames, 1.2 s a step, 1:00 min left");
  EXPECT_EQ(by_steps.line(0, 100, 1, 0), "step 100 of 200, t = 0 s, 1 frames");
}

} // namespace
} // namespace sheet
