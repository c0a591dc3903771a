// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/change.h"

#include <gtest/gtest.h>

#include "libsheet/scene/write.h"
#include "tests/unit/scene/scenes.h"

namespace sheet::scene {
namespace {

// The scene of scenes.h at 0.5 s, changed; or what is said against it.
std::string changed(const std::vector<std::string>& sets) {
  try {
    return changed_scene(to_toml(parse_scene(everything, "s")), sets, 0.5);
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ChangedScene, IsTheSceneWithTheSettings) {
  for (const std::vector<std::string>& sets : std::vector<std::vector<std::string>>{
           {},
           {"material.viscosity=50"},
           {"material.viscosity=50", "material.density=2 g/cm^3"},
           {"environment.gravity=[0, -5, 0]", "environment.pressure.value=0"},
           {"hold.0.until=3", "hold.1.motion.velocity=[0, 0, 0]", "hold.2.kind=clamped"},
           {"solid.1.surface_velocity=[0, 0, 0]", "solid.1.slip_length=0"},
           {"inflow.until=2", "inflow.thickness=1 mm"},
           {"tear.below=1 mm", "contact.adhesion=1", "model.bending=false", "hold.0.kind=pinned"},
           {"outflow.1.point=[0, 1, 0]", "outflow.1.normal=[0, 1, 0]"}})
    EXPECT_EQ(changed(sets), to_toml(parse_scene(everything, "s", sets)));
}

TEST(ChangedScene, ASolidMayTakeAnotherWayFromWhereItIs) {
  // It has turned by 0.5 rad.
  EXPECT_NE(changed({"solid.0.motion.rate=[[0.5, 1], [0.6, 0]]"}).find("rate = [[0.5, 1], [0.6, 0]]"),
            std::string::npos);
  EXPECT_NE(changed({"solid.0.motion.rate=2"}).find("solid 0 would jump"), std::string::npos);
  EXPECT_NE(changed({"solid.0.center=[0, 0, 0]"}).find("solid 0 would jump"), std::string::npos);
  EXPECT_NE(changed({"solid.0.file=other.off"}).find("its shape stays"), std::string::npos);
}

TEST(ChangedScene, WhatTheFrameHasSettledStays) {
  EXPECT_NE(changed({"sheet.velocity=[1, 0, 0]"}).find("[sheet] is how the run began"), std::string::npos);
  EXPECT_NE(changed({"hold.3.region=rim"}).find("the holds are those"), std::string::npos);
  EXPECT_NE(changed({"hold.0.region=outer_rim"}).find("its region chose"), std::string::npos);
  EXPECT_NE(changed({"environment.pressure={law = \"gas\", value = 3, more_volume = 1}"}).find("its amount is given"),
            std::string::npos);
  EXPECT_NE(changed({"inflow.region=inner_rim"}).find("the inlet is the one"), std::string::npos);
  EXPECT_EQ(changed({"material.viscosity=-1"}),
            "--set material.viscosity=-1: viscosity must not be negative, got -1 Pa*s");
}

} // namespace
} // namespace sheet::scene
