// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/recorded_ring.h"

#include <gtest/gtest.h>

#include "libsheet/base/error.h"

namespace sheet {
namespace {

TEST(RecordedRing, LeavesOutTheStagesThreads) {
  EXPECT_EQ(without_threads("a --threads 2 --dt 1 | b --threads=16|c --threads 1"), "a --dt 1 | b|c");
  EXPECT_EQ(without_threads("a --threads-of 2 | b --threads x"), "a --threads-of 2 | b --threads x");
}

TEST(RecordedRing, IsTheLastOne) {
  formats::Frame frame;
  EXPECT_EQ(recorded_ring(frame), std::nullopt);
  frame.put_text("provenance", "1 sheet-loop (0.1.0) --fps 24\n3 sheet-step (0.1.0)");
  EXPECT_EQ(recorded_ring(frame), std::nullopt);
  const RecordedRing first{"a | b 'c'", 24.0, ""}, second{"a", {}, "last"};
  record_ring(frame, first);
  record_ring(frame, second);
  EXPECT_EQ(recorded_ring(frame), second);
  const std::string before(frame.find("provenance")->text());
  record_ring(frame, second);
  EXPECT_EQ(frame.find("provenance")->text(), before);
  record_ring(frame, first);
  EXPECT_EQ(recorded_ring(frame), first);
  record_change(frame, first, {"a.b=1 # 2"});
  EXPECT_EQ(recorded_ring(frame), first);
}

TEST(RecordedRing, RunsSheetsOwnStagesOnly) {
  for (const char* ours : {"sheet-step", "sheet-remesh --smooth|sheet-emit | sheet-step --tolerance 1e-3 -v",
                           " sheet-step --dt=0.01 | sheet-collide | sheet-tear ", "sheet-merge | sheet-pass"})
    EXPECT_TRUE(is_harmless(ours)) << ours;
  for (const char* others :
       {"", "rm x", "sheet-step; rm x", "sheet-step $(rm x)", "sheet-step `rm x`", "sheet-step > x", "sheet-step -o x",
        "sheet-step --output x", "sheet-step --failed x", "sheet-step --failed=x", "sheet-step | ./mine",
        "./sheet-step", "sheet-step\nrm x", "sheet-step | | sheet-step", "sheet-step 'a'", "sheet-export x",
        "sheet-step &", "sheet-steps", "A=1 sheet-step"})
    EXPECT_FALSE(is_harmless(others)) << others;
}

TEST(RecordedRing, RefusesWhatIsNoRate) {
  formats::Frame frame;
  frame.put_text("provenance", "1 sheet-loop (0.1.0) --fps x -- a");
  EXPECT_THROW((void)recorded_ring(frame), Error);
}

} // namespace
} // namespace sheet
