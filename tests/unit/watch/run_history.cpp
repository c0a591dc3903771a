// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/run_history.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace {

using sheet::watch::Clock;
using sheet::watch::RunHistory;
using std::chrono::seconds;

const Clock::time_point start{};

void add_steps(RunHistory& history, int steps, double dt) {
  for (int i = 0; i < steps; ++i)
    history.add({.time = i * dt, .step = static_cast<std::uint64_t>(i)}, start + seconds(i));
}

TEST(RunHistory, HasAllStepsWhileTheyAreFew) {
  RunHistory history(10);
  add_steps(history, 10, 0.1);
  ASSERT_EQ(history.steps().size(), 10);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(history.steps()[i].step, i);
}

TEST(RunHistory, IsBoundedAscendsEvenlyAndEndsWithTheLastStep) {
  for (int steps = 1; steps < 300; ++steps) {
    RunHistory history(10);
    add_steps(history, steps, 0.1);
    const auto& kept = history.steps();
    ASSERT_LE(kept.size(), 11);
    EXPECT_GE(kept.size(), std::min(steps, 5));
    EXPECT_EQ(kept.front().step, 0);
    EXPECT_EQ(kept.back().step, static_cast<std::uint64_t>(steps - 1));
    for (std::size_t i = 2; i + 1 < kept.size(); ++i)
      EXPECT_EQ(kept[i].step - kept[i - 1].step, kept[1].step) << steps;
  }
}

TEST(RunHistory, TellsSpeedAndTimeLeftOfTheLastMinute) {
  RunHistory history;
  EXPECT_FALSE(history.speed());
  history.add({.time = 0}, start);
  EXPECT_FALSE(history.seconds_left(1));
  add_steps(history, 30, 0.01);
  EXPECT_DOUBLE_EQ(*history.speed(), 0.01);
  EXPECT_NEAR(*history.seconds_left(1), 71, 1e-9);
  EXPECT_EQ(*history.seconds_left(0.1), 0); // it is past
  for (int i = 0; i < 200; ++i)             // ten times slower
    history.add({.time = 0.29 + 0.001 * i}, start + seconds(30 + i));
  EXPECT_NEAR(*history.speed(), 0.001, 1e-12);
}

} // namespace
