// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/arc_rest.h"

namespace sheet {
namespace {

formats::Frame one_triangle() {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Corners> t{{0, 1, 2}};
  return make_frame(x, t, std::vector<double>{0.01});
}

// How many of the next steps rest, the state going through the frame, where arcs fail whenever they are tried.
int rests_until_tried(formats::Frame& frame) {
  for (int count = 0;; ++count) {
    ArcRest rest(frame);
    const bool rested = rest.rests();
    rest.note(true);
    rest.put(frame);
    if (!rested)
      return count;
  }
}

TEST(ArcRest, IsTwiceAsLongEachTimeThatArcsFailAgain) {
  formats::Frame frame = one_triangle();
  const formats::Frame without = frame;
  for (const int steps : {0, 1, 2, 4, 8, 16, 32, 32})
    EXPECT_EQ(rests_until_tried(frame), steps);
  for (int k = 0; k < 33; ++k) {
    ArcRest rest(frame);
    EXPECT_EQ(rest.rests(), k < 32);
    rest.note(false);
    rest.put(frame);
  }
  EXPECT_EQ(frame, without); // nothing is left of it
}

} // namespace
} // namespace sheet
