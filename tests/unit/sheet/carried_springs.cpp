// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/carried_springs.h"

#include <numeric>

#include <gtest/gtest.h>

#include "libsheet/sheet/contact_spring.h"

namespace sheet {
namespace {

// Places that no double near them rounds, a thousand kilometres from the origin; a corner is moved across by 2^-10 m.
TEST(CarriedSprings, KeepTheirDigitsFarFromTheOrigin) {
  const Vector3 far(0x1p20, -0x1p20, 0x1p20);
  std::vector<Vector3> x{far,
                         far + Vector3(0, 0, -0.5),
                         far + Vector3(1, 0, -0.5),
                         far + Vector3(0, 1, -0.5),
                         far + Vector3(1, 0, 0),
                         far + Vector3(0, 1, 0)};
  formats::Frame frame = make_frame(x, std::vector<Corners>{{0, 4, 5}, {1, 2, 3}}, std::vector<double>{1, 1});
  ContactSpring spring{.vertices = {0, 1, 2, 3}, .weights = {1, -1.0 / 3, -1.0 / 3, -1.0 / 3}, .rest = 0.5};
  spring.weights[3] = -(1 + spring.weights[1] + spring.weights[2]);
  spring.since = 7;
  write_springs(frame, std::vector{spring});
  CarriedSprings carried(frame);
  std::vector<std::uint32_t> same(x.size());
  std::iota(same.begin(), same.end(), 0U);
  carried.move(same);
  positions(frame)[1].z() += 0x1p-10;
  carried.put(frame);
  EXPECT_NEAR(read_springs(frame)[0].rest, 0.5 - 0x1p-10 / 3, 1e-15);
  EXPECT_EQ(read_springs(frame)[0].since, 7);
}

} // namespace
} // namespace sheet
