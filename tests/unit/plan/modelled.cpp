// SPDX-License-Identifier: GPL-3.0-or-later
// What --check says is modelled is what a step is made of.
#include "libsheet/plan/modelled.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/energy/term_table.h"
#include "libsheet/scene/read.h"
#include "libsheet/solve/scene_model.h"
#include "tests/unit/scene/scenes.h"

namespace sheet {
namespace {

using scene::disk;
using scene::liquid;

Scene scene_of(const std::string& text) { return scene::parse_scene(text, "s"); }

std::set<std::string_view> names(const Scene& scene) {
  std::set<std::string_view> result;
  for (const scene::ModelledPart& part : modelled(scene)) {
    EXPECT_FALSE(part.why.empty()) << part.name;
    if (part.modelled)
      result.insert(part.name);
  }
  return result;
}

using Names = std::set<std::string_view>;

TEST(Modelled, PartsFollowTheTables) {
  const Scene all = scene_of(scene::everything);
  for (const scene::ModelledPart& part : modelled(all))
    EXPECT_TRUE(part.modelled || part.name == "bath thrust" || part.name == "drag of a bath" ||
                part.name == "bath resistance")
        << part.name;
  EXPECT_EQ(names(scene_of(disk + liquid)), (Names{"membrane", "bending", "inertia"}));
  EXPECT_EQ(names(scene_of(disk + "[material]\nviscosity = 0\ndensity = 1\nsurface_tension = 1\n")),
            (Names{"inertia", "surface tension"}));
  EXPECT_EQ(names(scene_of(disk + liquid + "[contact]\nself = false\n")), names(scene_of(disk + liquid)));
}

TEST(Modelled, LiquidThatFlowsOnASolidIsDraggedAndLevels) {
  const auto on_plane = [](const std::string& contact) {
    return names(scene_of(disk + liquid + "[environment]\ngravity = [0, 0, -9.81]\n[[solid]]\nshape = \"plane\"\n" +
                          "contact = \"" + contact + "\"\n"));
  };
  EXPECT_EQ(on_plane("stick"), (Names{"membrane", "bending", "inertia", "gravity", "solids"}));
  EXPECT_TRUE(on_plane("flow").contains("drag of walls"));
  EXPECT_TRUE(on_plane("flow").contains("weight on walls"));
  EXPECT_FALSE(on_plane("slip").contains("drag of walls"));
  EXPECT_TRUE(on_plane("slip").contains("weight on walls"));
}

TEST(Modelled, NoPressureInGapsIsExplainedByWhatSolidsDo) {
  const std::string box = "[[solid]]\nshape = \"box\"\nsize = [1, 1, 1]\n";
  const auto gaps = [&](const std::string& one, const std::string& other) {
    const auto parts = modelled(scene_of(disk + liquid + box + one + box + other));
    return *std::ranges::find(parts, "gap pressure", &scene::ModelledPart::name);
  };
  EXPECT_EQ(gaps("", "").why, "no two [[solid]]s of which one moves or lets liquid flow");
  EXPECT_TRUE(gaps("contact = \"flow\"\n", "").modelled);
  EXPECT_TRUE(gaps("velocity = [0, 1, 0]\n", "").modelled);
}

// Each term that is made has the name under which the table explains it, but for those of the shell.
TEST(Modelled, TermsAreMadeUnderTheNamesThatTheTableHas) {
  Model model;
  model.liquid = {1, 1, 1};
  model.gravity = {0, 0, -1};
  model.pressures.resize(1);
  model.bath = BathLiquid{.density = 2, .spreads = true, .drag = 1};
  model.air = OuterFlow{.density = 1.2, .drag = 1.2};
  model.bath_flow = OuterFlow{.name = "bath resistance", .density = 2, .drag = 1.2};
  model.walls.resize(2);
  model.contacts.resize(1);
  model.contacts_flow = true;
  model.faces = ModelFaces{{1, 1, 1}, {SlopedEdge{}}};
  Connectivity mesh = connect(3, std::vector<Corners>{{0, 1, 2}});
  Names made, table;
  for (const auto& term : make_terms(model, std::make_shared<const Connectivity>(std::move(mesh))))
    made.insert(term->name());
  for (const TermEntry& entry : term_table())
    table.insert(entry.name);
  table.erase("bending"); // whose terms say how
  EXPECT_EQ(made, table);
}

} // namespace
} // namespace sheet
