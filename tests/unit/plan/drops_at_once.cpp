// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/drops_at_once.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Of a film, and a disk 24 mm wide and 1 mm thick above it, with such edges.
std::string said_of(const std::string& edge, const std::string& more, const std::string& tear = "drops = true") {
  const Scene scene = scene::parse_scene("[[sheet]]\nname = \"film\"\nshape = \"rectangle\"\nplane = \"xz\"\n"
                                         "size = [0.06, 0.06]\nedge_length = 0.004\nthickness = 0.002\n"
                                         "[[sheet]]\nname = \"disk\"\nshape = \"disk\"\nplane = \"xz\"\n"
                                         "radius = 0.012\nthickness = 0.001\ncenter = [0, 0.06, 0]\n"
                                         "edge_length = " +
                                             edge + "\n" + more +
                                             "[material]\nviscosity = 50\ndensity = 1200\nsurface_tension = 0.04\n"
                                             "[tear]\nsnap = 0.0005\n" +
                                             tear + "\n",
                                         "s");
  return drops_at_once_warning(scene, first_frame(scene));
}

TEST(DropsAtOnce, AreSheetsWithLongEdges) {
  EXPECT_THAT(said_of("0.004", ""), HasSubstr("is a ball from the first step on"));
  EXPECT_THAT(said_of("0.004", ""), Not(HasSubstr("more")));
  EXPECT_THAT(said_of("0.004", "enters = 0.1\n"), HasSubstr("is a ball from the first step on"));
  EXPECT_THAT(said_of("0.002", ""), IsEmpty());
  EXPECT_THAT(said_of("0.004", "", ""), IsEmpty());
  EXPECT_THAT(said_of("0.004", "", "drops = false"), IsEmpty());
}

TEST(DropsAtOnce, EdgesThatAreProposedKeepASheet) {
  const std::string said = said_of("0.004", "");
  const auto from = said.find("edges of ") + 9;
  EXPECT_THAT(said_of(said.substr(from, said.find(" m or less") - from), ""), IsEmpty());
}

} // namespace
} // namespace sheet
