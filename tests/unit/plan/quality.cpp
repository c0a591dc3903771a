// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/quality.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"

namespace sheet {
namespace {

// With edges of 4 mm, of a draft.
formats::Frame draft_of(const std::string& shape) {
  return build_frame(at_quality(scene::parse_scene("[sheet]\n" + shape +
                                                       "edge_length = 0.004\nthickness = 0.001\n[material]\n"
                                                       "viscosity = 100\ndensity = 1000\n",
                                                   "s"),
                                Quality::draft));
}

// Around rims of 5 mm six edges go that are no longer than 5.25 mm.
TEST(Quality, ADraftHasEdgesForWhichTheRimsHaveRoom) {
  for (const std::string shape : {"shape = \"annulus\"\ninner_radius = 0.005\nouter_radius = 0.05\n",
                                  "shape = \"cap\"\nradius = 0.05\nangle = \"174.2 deg\"\n",
                                  "shape = \"cap\"\nradius = 0.05\nangle = \"90 deg\"\nopening = \"5.8 deg\"\n"})
    EXPECT_GT(draft_of(shape).triangles, 0U) << shape;
}

} // namespace
} // namespace sheet
