// SPDX-License-Identifier: GPL-3.0-or-later
// --set
#include <gtest/gtest.h>

#include "scenes.h"

namespace sheet::scene {
namespace {

Scene with(const std::string& set) { return parse_scene(everything, "s", std::vector{set}); }

TEST(Set, TomlBareWordsAndUnits) {
  EXPECT_EQ(with("material.viscosity=50").material.viscosity, 50);
  EXPECT_EQ(with("material.surface_tension=\"30 mN/m\"").material.surface_tension, 0.03);
  EXPECT_EQ(with("material.surface_tension=30 mN/m").material.surface_tension, 0.03);
  EXPECT_EQ(with(" material . viscosity = 2.5 P ").material.viscosity, 0.25);
  EXPECT_EQ(std::get<double>(with("sheet.thickness=2.5mm").sheets[0].thickness), 0.0025);
  EXPECT_FALSE(with("hold.0.kind=pinned").holds[0].clamped);
  EXPECT_FALSE(with("model.inertia=false").model.inertia);
  EXPECT_EQ(*with("environment.gravity=[0, 0, -1]").environment.gravity, Vector3d(0, 0, -1));
  EXPECT_EQ(std::get<Wave>(with("sheet.perturbation.0.wavelength=1 µm").sheets[0].perturbations[0].form).wavelength,
            1e-6);
}

TEST(Set, MakesTablesThatAreMissing) {
  const Scene s = parse_scene(disk + liquid, "s", std::vector<std::string>{"tear.below=1 mm", "model.bending=false"});
  EXPECT_EQ(s.tear->below, 0.001);
  EXPECT_FALSE(s.model.bending);
  // The later one wins.
  EXPECT_EQ(parse_scene(disk + liquid, "s", std::vector<std::string>{"tear.below=1 mm", "tear.below=2 mm"}).tear->below,
            0.002);
}

TEST(Set, ProblemsNameTheSet) {
  EXPECT_EQ(problem(disk + liquid, {"material.viscocity=50"}),
            "--set material.viscocity=50: unknown key \"viscocity\" in [material]; did you mean \"viscosity\"?");
  EXPECT_EQ(problem(disk + liquid, {"material.density=3", "sheet.thickness=-1 mm"}),
            "--set sheet.thickness=-1 mm: thickness must be positive, got -0.001 m");
  EXPECT_EQ(problem(disk + liquid, {"material.viscosity=3 m"}),
            "--set material.viscosity=3 m: viscosity: expected a viscosity such as \"100 Pa*s\", got a length (m)");
  EXPECT_EQ(problem(disk + liquid, {"sheet.rotation={axis = [0, 0, 0], angle = 1}"}),
            "--set sheet.rotation={axis = [0, 0, 0], angle = 1}: axis: a direction must not be zero");
  // Those of the file first.
  EXPECT_EQ(problem(disk + liquid + "x = 1\n", {"tear.y=1", "tear.below=1 mm"}),
            "s:9:1: unknown key \"x\" in [material]; known: viscosity_law, "
            "surface_tension_slope, law, viscosity, density, surface_tension\n"
            "--set tear.y=1: unknown key \"y\" in [tear]; known: below, crumbs, sites, snap, drops");
}

TEST(Set, ProblemsOfTheSetItself) {
  const auto set = [](const std::string& text) { return problem(everything, {text}); };
  EXPECT_EQ(set("material.viscosity"), "--set material.viscosity: expected KEY=VALUE, such as material.viscosity=50");
  const std::string keys = ": expected keys joined by dots before the \"=\", such as material.viscosity";
  EXPECT_EQ(set("=3"), "--set =3" + keys);
  EXPECT_EQ(set("a..b=3"), "--set a..b=3" + keys);
  EXPECT_EQ(set("a.b.c.d.e.f.g.h.i=3"), "--set a.b.c.d.e.f.g.h.i=3" + keys);
  EXPECT_EQ(set("hold.4.kind=pinned"),
            "--set hold.4.kind=pinned: \"4\" is not an item of a list of 3 (the first is 0)");
  EXPECT_EQ(set("hold.kind=pinned"), "--set hold.kind=pinned: \"kind\" is not an item of a list of 3 (the first is 0)");
  EXPECT_EQ(set("sheet.shape.x=1"), "--set sheet.shape.x=1: there is nothing below a text, so no \"x\"");
  EXPECT_EQ(set("tear.crumbs=a\nb"), "--set tear.crumbs=a\nb: the value must be one line of UTF-8 text");
  EXPECT_EQ(set("tear.crumbs=\xff"), "--set tear.crumbs=\xff: the value must be one line of UTF-8 text");
  try {
    (void)with("=");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

} // namespace
} // namespace sheet::scene
