// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/open_rims.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using testing::StartsWith;

// Of a dome with a hole at its top.
std::string of_dome(const std::string& more, const std::string& gas = "value = 20") {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"cap\"\nradius = 0.04\nangle = \"90 deg\"\n"
                                         "opening = \"20 deg\"\nedge_length = 0.008\nthickness = 0.001\n"
                                         "[material]\nviscosity = 10\ndensity = 1000\n[environment]\n"
                                         "pressure = {law = \"gas\", " +
                                             gas + "}\n" + more,
                                         "s");
  return open_rim_warning(scene, first_frame(scene));
}

TEST(OpenRims, CountAsClosed) {
  const std::string foot = "[[hold]]\nregion = \"outer_rim\"\n", top = "[[hold]]\nregion = \"inner_rim\"\n";
  EXPECT_THAT(of_dome(foot), StartsWith("the sheet, which encloses gas, starts with an open rim, about ("));
  EXPECT_THAT(of_dome(foot), testing::HasSubstr("(0, 0.0376, 0) m")); // r cos 20°
  EXPECT_EQ(of_dome(foot + top), "");
  EXPECT_EQ(of_dome(foot, "value = 20, leak = 1e-8"), "");
  EXPECT_EQ(of_dome("[[hold]]\nregion = \"rim\"\n"), "");
}

// A diving bell, in a bath that closes it, and a bubble.
TEST(OpenRims, AreNotThoseUnderABath) {
  const auto bell = [](const std::string& environment) {
    const Scene scene = scene::parse_scene("[sheet]\nshape = \"cap\"\nradius = 0.04\nangle = \"90 deg\"\n"
                                           "edge_length = 0.008\nthickness = 0.001\n[material]\nviscosity = 10\n"
                                           "density = 900\n[environment]\ngravity = [0, -9.81, 0]\n"
                                           "pressure = {law = \"gas\", value = 0}\n" +
                                               environment,
                                           "s");
    return open_rim_warning(scene, first_frame(scene));
  };
  EXPECT_NE(bell(""), "");
  EXPECT_EQ(bell("bath = {density = 1000, level = 0.01}\n"), "");
}

} // namespace
} // namespace sheet
