// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/contact_warnings.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Of dough of 6 mm on a board, and a roller of 25 mm radius.
std::vector<std::string> warnings_of_roller(const std::string& contact, double gap, const std::string& motion) {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"disk\"\nradius = 0.06\nedge_length = 0.01\nthickness = 0.006\n"
                  "center = [0, 0.003, 0]\n[material]\nviscosity = 5000\ndensity = 1100\n[environment]\n"
                  "gravity = [0, -9.81, 0]\n[contact]\nself = true\n[[solid]]\nshape = \"plane\"\ncontact = \"{}\"\n"
                  "[[solid]]\nshape = \"cylinder\"\nradius = 0.025\nheight = 0.2\ncenter = [-0.1, {}, 0]\n"
                  "rotation = {{axis = [1, 0, 0], angle = \"90 deg\"}}\n{}",
                  contact, 0.025 + gap, motion),
      "s");
  return contact_warnings(scene, first_frame(scene), 2);
}

TEST(ContactWarnings, WhatASolidSpreadsMustNotStick) {
  const std::string rolls = "velocity = [0.1, 0, 0]\nangular_velocity = [0, 0, -4]\n";
  EXPECT_THAT(warnings_of_roller("stick", 0.002, rolls),
              ElementsAre(AllOf(HasSubstr("does liquid stay where it touches solid 0 (plane)?"),
                                HasSubstr("solid 1 (cylinder) passes over it"))));
  EXPECT_THAT(warnings_of_roller("flow", 0.002, rolls), IsEmpty());
  EXPECT_THAT(warnings_of_roller("stick", 0.007, rolls), IsEmpty());
  EXPECT_THAT(warnings_of_roller("stick", 0.02, "velocity = [0.05, -0.1, 0]\n"), IsEmpty()); // presses
}

// A sphere, half of which is steeper than 60 degrees, above a plane.
TEST(ContactWarnings, WhatIsBlownUpDoesNotPileUp) {
  const auto warnings = [](const std::string& pressure) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"sphere\"\nradius = 0.03\nedge_length = 0.005\nthickness = 0.004\n[material]\n"
        "viscosity = 1000\ndensity = 2500\n[environment]\ngravity = [0, -9.81, 0]\n" +
            pressure + "[[solid]]\nshape = \"plane\"\ncenter = [0, -0.1, 0]\n",
        "s");
    return contact_warnings(scene, first_frame(scene), 1);
  };
  const auto piles_up = testing::Contains(HasSubstr("folds or piles up"));
  EXPECT_THAT(warnings(""), piles_up);
  EXPECT_THAT(warnings("pressure = {law = \"gas\", value = \"20 kPa\"}\n"), testing::Not(piles_up));
}

} // namespace
} // namespace sheet
