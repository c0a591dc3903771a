// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/scene/rolls.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

Scene with_roll(const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 1]\nsegments = [4, 1]\nthickness = 0.1\n"
                     "[material]\nviscosity = 1\ndensity = 1\n"
                     "[[hold]]\nregion = \"x_min\"\n"
                     "[[hold]]\nregion = {box = [[2.4, -9, -9], [3.2, 9, 9]]}\nroll = true\n"
                     "motion = {kind = \"translating\", velocity = [1, 0, 0]}\n" +
                         more,
                     "scene");
}

// Vertices at x = 0, 1, 2, 3, 4, in two rows.
formats::Frame strip() {
  std::vector<Vector3> x;
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 5; ++i)
    for (std::uint32_t k = 0; k < 2; ++k)
      x.emplace_back(i, 0, k);
  for (std::uint32_t i = 0; i < 4; ++i) {
    t.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    t.push_back({2 * i + 2, 2 * i + 1, 2 * i + 3});
  }
  return make_frame(x, t, std::vector<double>(t.size(), 0.05));
}

// Edges are 1 m to 1.41 m long, so the roll takes from 0.5 m to 0.6 m before its region on, and as far behind it.
TEST(Rolls, HoldWhatIsInTheirRegionAndLetTheRestGo) {
  formats::Frame frame = strip();
  const auto bits = put_masks(frame, "hold");
  for (std::size_t v = 0; v < bits.size(); ++v)
    bits[v] = v < 2 ? 1 : v > 7 ? 2 : 0; // the left end is held by another; what has left, at x = 4, still by the roll
  follow_rolls(with_roll(), frame);
  const auto held = masks(frame, "hold");
  EXPECT_EQ(std::vector<std::uint64_t>(held.begin(), held.end()),
            (std::vector<std::uint64_t>{1, 1, 0, 0, 2, 2, 2, 2, 0, 0}));
}

TEST(Rolls, HoldNobodyAfterTheirEnd) {
  Scene scene = with_roll();
  scene.holds[1].until = 1;
  formats::Frame frame = strip();
  frame.time = 2;
  follow_rolls(scene, frame);
  for (const std::uint64_t bits : masks(frame, "hold"))
    EXPECT_EQ(bits, 0U);
}

TEST(Rolls, WriteTheirForces) {
  EXPECT_TRUE(wants_forces(with_roll()));
  Scene without = with_roll();
  without.holds.pop_back();
  EXPECT_FALSE(wants_forces(without));
  without.model.forces = true;
  EXPECT_TRUE(wants_forces(without));
}

} // namespace
} // namespace sheet::scene
