// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/read.h"

#include <filesystem>
#include <fstream>
#include <numbers>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/write.h"
#include "scenes.h"

namespace sheet::scene {
namespace {

TEST(Read, EveryTable) {
  const Scene s = parse_scene(everything, "s", {}, "scenes");
  const auto& annulus = std::get<Annulus>(s.sheets[0].shape);
  EXPECT_EQ(annulus.inner_radius, 0.1);
  EXPECT_EQ(annulus.outer_radius, 0.25);
  EXPECT_EQ(s.sheets[0].edge_length, 0.01);
  EXPECT_EQ(s.sheets[0].seed, 3);
  EXPECT_EQ(std::get<double>(s.sheets[0].thickness), 0.002);
  ASSERT_EQ(s.sheets[0].perturbations.size(), 2U);
  EXPECT_EQ(std::get<Wave>(s.sheets[0].perturbations[0].form), (Wave{0.075, 0, SheetDirection::radial}));
  EXPECT_TRUE(s.sheets[0].perturbations[1].of_thickness);
  EXPECT_EQ(std::get<Noise>(s.sheets[0].perturbations[1].form).seed, 7);
  EXPECT_EQ(s.sheets[0].rotation->angle, std::numbers::pi / 4);
  EXPECT_EQ(s.sheets[0].velocity, Vector3d(0, -1, 0));
  EXPECT_EQ(s.material, (Liquid{100, 978, 0.0728}));
  EXPECT_EQ(*s.environment.gravity, Vector3d(0, -9.81, 0));
  EXPECT_EQ(std::get<ConstantPressure>(*s.environment.pressure).value, 10);
  EXPECT_EQ(s.environment.bath, (BathLiquid{.density = 1200, .level = 0.5, .spreads = true}));
  ASSERT_TRUE(s.environment.air);
  EXPECT_EQ(s.environment.air->density, 1.2);
  EXPECT_EQ(s.environment.air->drag_coefficient, 1.2);
  EXPECT_EQ(s.environment.air->friction_coefficient, 0.01);
  EXPECT_EQ(value_at(s.environment.air->wind, 0.5), Vector3d(1.5, 0, 0));
  ASSERT_EQ(s.holds.size(), 3U);
  EXPECT_TRUE(s.holds[0].clamped);
  const auto& turning = std::get<Rotating>(s.holds[0].motion);
  EXPECT_EQ(turning.center, Vector3d(0, 1, 0)); // the sheet's
  EXPECT_EQ(turning.rate.entries[1], (Timed<double>::Entry{5, 0.3}));
  EXPECT_EQ(s.holds[1].axes, axis_bit(0) | axis_bit(2));
  EXPECT_EQ(s.holds[1].until, 2);
  EXPECT_EQ(std::get<Translating>(s.holds[1].motion).velocity.entries[1].value, Vector3d(0, 0, 0.4));
  EXPECT_EQ(std::get<SphereRegion>(s.holds[2].region).radius, 0.01);
  EXPECT_FALSE(s.holds[2].clamped);
  const auto& mesh = std::get<SolidMesh>(s.solids[0].shape);
  EXPECT_EQ(mesh.file, "scenes/meshes/b.off");
  EXPECT_EQ(std::get<Rotating>(s.solids[0].motion).center, Vector3d(0, -1, 0)); // the solid's
  EXPECT_EQ(std::get<HalfSpace>(s.solids[1].shape).normal, Vector3d(0, 1, 0));  // against gravity
  EXPECT_EQ(s.inflows[0].thickness, 0.002);                                     // the sheet's
  EXPECT_EQ(s.tear, (Tear{0.0008, true, Inclusions{20000, 0.0006, 6, 4}, 2e-5, true}));
  EXPECT_EQ(s.contact->stiffness, 1.5);
}

TEST(Read, WhatIsAbsentIsNotThere) {
  const Scene s = parse_scene(disk + liquid, "s");
  EXPECT_EQ(s.environment, Environment{});
  EXPECT_TRUE(s.model.inertia && s.model.bending);
  EXPECT_TRUE(s.holds.empty() && s.solids.empty());
  EXPECT_FALSE(!s.inflows.empty() || s.tear || s.contact);
  EXPECT_EQ(s.sheets[0].plane, Plane::xz);
  EXPECT_EQ(s.sheets[0].pattern, Pattern::irregular);
  EXPECT_FALSE(parse_scene(disk + liquid + "[environment]\ngravity = [0, 0, 0]\n", "s").environment.gravity);
}

TEST(Read, HorizontalIsWhatGravitySays) {
  const auto plane = [](const std::string& gravity) {
    return parse_scene(disk + liquid + "[environment]\ngravity = " + gravity, "s").sheets[0].plane;
  };
  EXPECT_EQ(plane("[0, 0, -9.81]"), Plane::xy);
  EXPECT_EQ(plane("[9.81, 0, 1]"), Plane::yz);
  EXPECT_EQ(plane("[0, -9.81, 0]"), Plane::xz);
}

TEST(Read, AllProblemsTogetherInTheOrderOfTheFile) {
  EXPECT_EQ(problem("[sheet]\nshape = \"disc\"\nthickness = -1\n[material]\n  viscocity = 3\n[modell]\n"),
            "s:2:9: shape: \"disc\" is none of \"rectangle\", \"disk\", \"annulus\", \"sphere\", \"cap\", \"tube\", "
            "\"mesh\"; did you mean \"disk\"?\n"
            "s:3:13: thickness must be positive, got -1 m\n"
            "s:4:1: missing key \"viscosity\" in [material], such as viscosity = \"100 Pa*s\"\n"
            "s:4:1: missing key \"density\" in [material]: inertia needs it (or switch it off: inertia = false in "
            "[model])\n"
            "s:5:3: unknown key \"viscocity\" in [material]; did you mean \"viscosity\"?\n"
            "s:6:2: unknown key \"modell\" in the scene; did you mean \"model\"?");
}

TEST(Read, AKeyOfAnotherTableIsToldItsPlace) {
  const std::string disk = "[sheet]\nshape = \"disk\"\nradius = 1\nthickness = 0.02\nedge_length = 0.2\n"
                           "[material]\nviscosity = 1\ndensity = 1\n";
  EXPECT_EQ(problem("gravity = [0, -9.81, 0]\n" + disk + "[heat]\nviscosity_law = \"arrhenius\"\n" +
                    "specific_heat = 1\ntemperature = 300\n[contact]\ncontact_angle = 1\nheight = 2\n"),
            "s:1:1: unknown key \"gravity\" in the scene; it belongs in [environment]\n"
            "s:11:1: unknown key \"viscosity_law\" in [heat]; it belongs in [material]\n"
            "s:15:1: unknown key \"contact_angle\" in [contact]; it belongs in [[solid]]\n"
            "s:16:1: unknown key \"height\" in [contact]; it belongs in [sheet], [[solid]]");
}

TEST(Read, ErrorsAreBadInput) {
  try {
    (void)parse_scene("", "s");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_STREQ(error.what(), "s: missing table [sheet]\ns: missing table [material]");
  }
}

TEST(Read, ShortFormsOfASolidsMotion) {
  const auto motion = [](const std::string& keys) {
    return parse_scene(disk + liquid + "[[solid]]\nshape = \"plane\"\ncenter = [1, 2, 3]\n" + keys, "s")
        .solids[0]
        .motion;
  };
  EXPECT_EQ(motion("velocity = [0, 0, \"40 cm/s\"]"),
            motion("motion = {kind = \"translating\", velocity = [0, 0, 0.4]}"));
  EXPECT_EQ(motion("velocity = [[0, 0, 0, 0], [1, 0, 0, 1]]"),
            motion("motion = {kind = \"translating\", velocity = [[0, 0, 0, 0], [1, 0, 0, 1]]}"));
  const Motion turning = motion("angular_velocity = [0, 0, \"-60 rpm\"]");
  const Motion spoken = motion("motion = {kind = \"rotating\", axis = [0, 0, -1], rate = \"60 rpm\"}");
  const Vector3d x(4, 5, 6);
  EXPECT_LT((velocity_at(turning, 0.3, x) - velocity_at(spoken, 0.3, x)).norm(), 1e-13);
  EXPECT_GT(velocity_at(turning, 0.3, x).norm(), 1);
  EXPECT_EQ(motion("angular_velocity = [0, 0, 0]"), Motion(Fixed{}));
  EXPECT_EQ(motion("velocity = [0.4, 0, 0]\nangular_velocity = [0, 0, 0]"), motion("velocity = [0.4, 0, 0]"));
  EXPECT_EQ(motion("velocity = [0.4, 0, 0]\nangular_velocity = [0, 0, -5]"),
            motion("motion = {kind = \"rotating\", axis = [0, 0, -5], rate = 5, velocity = [0.4, 0, 0]}"));
}

TEST(Read, OneFormOfASolidsMotion) {
  const auto wrong = [](const std::string& keys) {
    return problem(disk + liquid + "[[solid]]\nshape = \"plane\"\n" + keys);
  };
  const std::string led = "motion = {kind = \"fixed\"}\n";
  EXPECT_THAT(wrong(led + "velocity = [1, 0, 0]"),
              testing::EndsWith("velocity: it is short for a motion, which is there too: "
                                "give one of them"));
  EXPECT_THAT(wrong(led + "angular_velocity = [1, 0, 0]"),
              testing::EndsWith("angular_velocity: it is short for a motion, which is there too: give one of them"));
  EXPECT_THAT(wrong("angular_velocity = [1, 0, \"1 m/s\"]"), testing::HasSubstr("expected a turning rate"));
}

struct Case {
  std::string text, problem;
};

// Problems in [sheet]: `text` follows the header in line 2.
TEST(Read, ProblemsOfTheSheet) {
  const std::string rest = "\nthickness = 0.02\nedge_length = 0.01\n" + liquid;
  for (const auto& [text, expected] : std::vector<Case>{
           {"radius = 1", "s:1:1: missing key \"shape\" in [sheet], such as shape = \"disk\""},
           {"shape = 3", "s:2:9: shape: expected one of \"rectangle\", \"disk\", \"annulus\", \"sphere\", \"cap\", "
                         "\"tube\", \"mesh\", got a number"},
           {"shape = \"disk\"", "s:1:1: missing key \"radius\" in [sheet], such as radius = \"2.5 mm\""},
           {"shape = \"disk\"\nradius = \"1 Pa\"",
            "s:3:10: radius: expected a length such as \"2.5 mm\", got a pressure (Pa)"},
           {"shape = \"disk\"\nradius = \"30\"",
            "s:3:10: radius: \"30\" has no unit: write one, as in \"2.5 mm\", or the "
            "plain number, which is in m"},
           {"shape = \"disk\"\nradius = true",
            "s:3:10: radius: expected a length such as \"2.5 mm\", got true or false"},
           {"shape = \"disk\"\nradius = nan", "s:3:10: radius must be finite, got nan m"},
           {"shape = \"disk\"\nradius = 1\nheight = 2",
            "s:4:1: key \"height\" has no meaning in [sheet]: shape \"disk\" takes radius"},
           {"shape = \"disk\"\nradius = 0.001",
            "s:5:15: edge_length: 0.01 m is too large for the shape; at most 0.001 m"},
           {"shape = \"disk\"\nradius = 1e6",
            "s:5:15: edge_length: 0.01 m makes about 7.3e+16 triangles; at most 1e+09 are possible"},
           {"shape = \"rectangle\"", "s:1:1: missing key \"size\" in [sheet], such as size = [\"1 m\", \"0.5 m\"]"},
           {"shape = \"rectangle\"\nsize = 3", "s:3:8: size: expected two lengths such as [\"1 m\", \"0.5 m\"]"},
           {"shape = \"rectangle\"\nsize = [1, -1]", "s:3:12: size must be positive, got -1 m"},
           {"shape = \"annulus\"\ninner_radius = 2\nouter_radius = 1",
            "s:3:16: inner_radius: must be less than outer_radius, but 2 m is not less than 1 m"},
           {"shape = \"cap\"\nradius = 1\nangle = 90",
            "s:4:9: angle: must be above 0 and at most 180 deg, got 5156.620156177409 deg (a number is in radians)"},
           {"shape = \"cap\"\nradius = 1\nangle = \"0 deg\"",
            "s:4:9: angle: must be above 0 and at most 180 deg, got 0 deg (a number is in radians)"},
           {"shape = \"cap\"\nradius = 1\nangle = \"90 deg\"\nopening = \"90 deg\"",
            "s:5:11: opening: must be less than the cap's angle, but 90 deg is not less than 90 deg"},
           {"shape = \"disk\"\nradius = 1\nsegments = [30, 20]",
            "s:4:12: segments: give either edge_length or segments, not both"},
           {"shape = \"disk\"\nradius = 1\npattern = \"iregular\"",
            "s:4:11: pattern: \"iregular\" is none of \"structured\", \"equilateral\", \"irregular\"; did you mean "
            "\"irregular\"?"},
           {"shape = \"disk\"\nradius = 1\npattern = \"structured\"\nseed = 1",
            "s:5:1: key \"seed\" has no meaning in [sheet]: only the pattern \"irregular\" has one"},
           {"shape = \"disk\"\nradius = 1\nseed = -1", "s:4:8: seed: must not be negative, got -1"},
           {"shape = \"disk\"\nradius = 1\nseed = 1.5", "s:4:8: seed: expected an integer, got a number"},
           {"shape = \"disk\"\nradius = 1\ncenter = [0, 0]",
            "s:4:10: center: expected [x, y, z], each a length such as \"2.5 mm\", got 2 of them"},
           {"shape = \"disk\"\nradius = 1\ncenter = [0, 0, \"1 s\"]",
            "s:4:17: center: expected a length such as \"2.5 mm\", got a time (s)"},
           {"shape = \"disk\"\nradius = 1\nrotation = {axis = [0, 0, 0], angle = 1}",
            "s:4:20: axis: a direction must not be zero"},
           {"shape = \"disk\"\nradius = 1\nrotation = {angel = 1}",
            "s:4:12: missing key \"axis\" in rotation, such as axis = [0, 1, 0]\n"
            "s:4:12: missing key \"angle\" in rotation, such as angle = \"45 deg\"\n"
            "s:4:13: unknown key \"angel\" in rotation; did you mean \"angle\"?"},
           {"shape = \"disk\"\nradius = 1\nrotation = 3", "s:4:12: rotation: expected a table, got a number"},
           {"shape = \"disk\"\nradius = 1\nperturbation = {amplitude = 1e-3}",
            "s:4:16: perturbation: give either a wavelength or a seed (for noise)"},
           {"shape = \"disk\"\nradius = 1\nperturbation = {amplitude = 1e-3, wavelength = 1, direction = \"y\"}",
            "s:4:63: direction: is the normal of the sheet's plane, along which a flat sheet has no extent"},
           {"shape = \"disk\"\nradius = 1\nperturbation = {amplitude = 1e-3, seed = 1, phase = 1}",
            "s:4:45: key \"phase\" has no meaning in perturbation: noise has none"},
           {"shape = \"disk\"\nradius = 1\nperturbation = {of = \"thickness\", amplitude = 1, seed = 1}",
            "s:4:47: amplitude: must be less than the sheet's thickness, but 1 m is not less than 0.02 m"},
           {"shape = \"disk\"\nradius = 1\nperturbation = [3]", "s:4:17: perturbation: expected tables, got a number"},
           {"shape = \"mesh\"\nfile = \"a.off\"",
            "s:5:1: key \"edge_length\" has no meaning in [sheet]: a mesh is taken as it is"},
           {"shape = \"mesh\"", "s:1:1: missing key \"file\" in [sheet], such as file = \"bunny.obj\"\n"
                                "s:4:1: key \"edge_length\" has no meaning in [sheet]: a mesh is taken as it is"},
       })
    EXPECT_EQ(problem("[sheet]\n" + text + rest), expected) << text;
}

TEST(Read, ThicknessByRows) {
  const auto sheet = [](const std::string& thickness) {
    return "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = " + thickness + "\n";
  };
  const auto profile = [&](const std::string& thickness) {
    return std::get<ThicknessProfile>(
        parse_scene(sheet(thickness) + "[material]\nviscosity = 1\ndensity = 1\n", "s").sheets[0].thickness);
  };
  EXPECT_EQ(profile(R"({radial = [[0, "1.9 mm"], ["20 mm", "1.2 mm"]]})"),
            (ThicknessProfile{SheetDirection::radial, {{0, 0.0019}, {0.02, 0.0012}}}));
  EXPECT_EQ(profile(R"({along = "z", rows = [[-1, 2], [1, 3], [2, 1]]})"),
            (ThicknessProfile{SheetDirection::z, {{-1, 2}, {1, 3}, {2, 1}}}));
  for (const auto& [text, expected] : std::vector<Case>{
           {"{radial = [[0, 1]]}", "s:5:23: radial: expected 2 to 1000 rows of a place and the thickness there"},
           {"{radial = 1}", "s:5:23: radial: expected 2 to 1000 rows of a place and the thickness there"},
           {"{radial = [[0, 1], [1]]}", "s:5:32: thickness: radial: expected rows of a place and the thickness there, "
                                        "such as [\"20 mm\", \"1.2 mm\"]"},
           {"{radial = [[0, 1], [1, 0]]}", "s:5:36: radial must be positive, got 0 m"},
           {"{radial = [[0, 1], [0, 2]]}",
            "s:5:32: thickness: radial: places must increase from each row to the next, but 0 m follows 0 m"},
           {"{along = \"x\"}", "s:5:13: missing key \"rows\" in thickness, such as rows = [[0, \"1.9 mm\"], "
                               "[\"20 mm\", \"1.2 mm\"]]"},
           {"{along = \"y\", rows = [[0, 1], [1, 1]]}",
            "s:5:22: along: is the normal of the sheet's plane, along which a flat sheet has no extent"},
           {"{radial = [[0, 1], [1, 1]], along = \"x\"}",
            "s:5:41: key \"along\" has no meaning in thickness: the rows are those of radial"},
           {"{radial = [[0, 1], [1, 1]], data = \"h\"}",
            "s:5:41: key \"data\" has no meaning in thickness: the thickness is given by rows"},
       })
    EXPECT_EQ(problem(sheet(text) + "[material]\nviscosity = 1\ndensity = 1\n"), expected) << text;
}

TEST(Read, ProblemsOfMeshesAndCounts) {
  for (const auto& [text, expected] : std::vector<Case>{
           {"shape = \"mesh\"\nfile = \"a.step\"\nthickness = 1",
            "s:3:8: file: \"a.step\" is of no known kind; known: .obj, .off, .ply, .stl, .vtu, .sheet"},
           {"shape = \"mesh\"\nfile = \"\"\nthickness = 1", "s:3:8: file: must not be empty"},
           {"shape = \"mesh\"\nfile = \"a\\nb.off\"\nthickness = 1", "s:3:8: file: must not hold control characters"},
           {"shape = \"mesh\"\nfile = \"a.off\"\nthickness = {place = \"edge\"}",
            "s:4:13: missing key \"data\" in thickness, such as data = \"thickness\"\n"
            "s:4:22: place: \"edge\" is none of \"vertex\", \"face\""},
           {"shape = \"sphere\"\nradius = 1\nedge_length = 0.1\nthickness = {data = \"h\"}",
            "s:5:13: thickness: only shape \"mesh\" has data to take it from; expected a length such as \"2.5 mm\", or "
            "{radial = [[0, \"1.9 mm\"], [\"20 mm\", \"1.2 mm\"]]}"},
           {"shape = \"sphere\"\nradius = 1\nthickness = 0.1",
            "s:1:1: missing key \"edge_length\" in [sheet], such as edge_length = \"20 mm\""},
           {"shape = \"sphere\"\nradius = 1\nthickness = 0.1\nsegments = [2, 5]",
            "s:5:12: segments: expected two integers such as [30, 20], from 3 to 1000000 around and from 1 along"},
           {"shape = \"rectangle\"\nsize = [1, 1]\nthickness = 0.1\nsegments = [2, 5.5]",
            "s:5:12: segments: expected two integers such as [30, 20], from 1 to 1000000"},
           {"shape = \"sphere\"\nradius = 1\nthickness = 0.1\nsegments = [9, 5]\npattern = \"irregular\"",
            "s:6:11: pattern: segments need the pattern \"structured\""},
           {"shape = \"sphere\"\nradius = 1\nedge_length = 0.1",
            "s:1:1: missing key \"thickness\" in [sheet], such as thickness = \"2.5 mm\""}})
    EXPECT_EQ(problem("[sheet]\n" + text + "\n" + liquid), expected) << text;
}

// Problems in tables after a good disk and liquid: `text` begins in line 9.
TEST(Read, ProblemsOfTheOtherTables) {
  for (const auto& [text, expected] : std::vector<Case>{
           {"[environment]\nbath = {density = 3}", "s:10:8: bath: needs gravity, which says where up is"},
           {"[merge]\nafter = 3\n[contact]\nself = false",
            "s:10:9: [merge] needs [contact] with self = true: nothing touches without it"},
           {"[contact]\nself = true\n[merge]\non = \"solids\"",
            "s:11:1: missing key \"after\" in [merge]: without surface tension nothing says how long layers take to "
            "become one; for example after = \"0.3 s\""},
           {"[environment]\ngravity = -9.81", "s:10:11: gravity: expected [x, y, z], each an acceleration such as "
                                              "\"9.81 m/s^2\", got a number"},
           {"[environment]\npressure = {law = \"draining\", value = 3}",
            "s:10:12: missing key \"conductance\" in pressure, such as conductance = \"1e-6 m^3/(Pa*s)\"\n"
            "s:10:12: pressure: this law needs a shape that encloses a volume, or a mesh\n"
            "s:10:31: key \"value\" has no meaning in pressure: law \"draining\" takes conductance"},
           {"[environment]\npressure = {law = \"inverse_square\", value = 3, reference_radius = 1}",
            "s:10:12: pressure: this law needs a shape that encloses a volume, or a mesh"},
           {"[environment]\npressure = {law = \"gas\", value = -2e5, exponent = 0.9, conductance = 1}",
            "s:10:12: pressure: this law needs a shape that encloses a volume, or a mesh\n"
            "s:10:34: value: gas cannot have less than no pressure: give more than -ambient\n"
            "s:10:51: exponent: a polytropic exponent is at least 1 (constant temperature)\n"
            "s:10:56: key \"conductance\" has no meaning in pressure: law \"gas\" takes value or amount, ambient, "
            "exponent, leak, more_volume"},
           {"[environment]\npressure = {law = \"gas\", value = 3, amount = \"1 l\", more_volume = 1}",
            "s:10:34: value: either the amount of the gas is given, or its pressure at the start"},
           {"[environment]\npressure = {law = \"gas\", more_volume = 1}",
            "s:10:12: missing key \"value\" in pressure, such as value = \"10 Pa\" (pressure at the start), or amount "
            "= \"1 l\""},
           {"[environment]\npressure = {value = 3}",
            "s:10:12: missing key \"law\" in pressure, such as law = \"constant\"\n"
            "s:10:13: key \"value\" has no meaning in pressure: the law is not known"},
           {"[model]\ninertia = 1", "s:10:11: inertia: expected true or false, got a number"},
           {"[model]\nbending = false\n[[hold]]\nregion = \"rim\"\nkind = \"clamped\"",
            "s:13:8: kind: a clamped hold needs bending, which [model] switches off; use \"pinned\""},
           {"[[hold]]\nregion = \"rim\"\nsheet = \"lid\"", "s:11:9: sheet: no [[sheet]] has a name"},
           {"[[hold]]", "s:9:1: missing key \"region\" in [[hold]], such as region = \"rim\""},
           {"[hold]\nregion = \"rim\"", "s:9:1: hold: expected tables [[hold]], got a table"},
           {"[[hold]]\nregion = \"inner_rim\"",
            "s:10:10: region: this sheet has no \"inner_rim\"; it has rim, outer_rim"},
           {"[[hold]]\nregion = \"rimm\"", "s:10:10: region: \"rimm\" is none of \"rim\", \"inner_rim\", "
                                           "\"outer_rim\", \"x_min\", \"x_max\", \"y_min\", "
                                           "\"y_max\", \"z_min\", \"z_max\"; did you mean \"rim\"?"},
           {"[[hold]]\nregion = {box = [[0, 0, 0], [1, -1, 1]]}",
            "s:10:17: box: the first corner must not exceed the second in any coordinate"},
           {"[[hold]]\nregion = {box = 3}", "s:10:17: box: expected two corners such as [[0, 0, 0], [1, 1, 1]]"},
           {"[[hold]]\nregion = {}", "s:10:10: region: expected \"rim\", {box = [[0, 0, 0], [1, 1, 1]]}, {sphere = "
                                     "{center = [0, 0, 0], radius = 1}} or {array = \"pinned\"}"},
           {"[[hold]]\nregion = \"rim\"\naxes = \"yy\"",
            "s:11:8: axes: expected some of the letters x, y, z, such as \"y\" or \"xz\""},
           {"[[hold]]\nregion = \"rim\"\naxes = \"y\"\nkind = \"clamped\"",
            "s:11:8: axes: a clamped hold holds all axes; use kind = \"pinned\""},
           {"[[hold]]\nregion = \"rim\"\naxes = \"y\"\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = 1}",
            "s:11:8: axes: a hold that turns holds all axes"},
           {"[[hold]]\nregion = \"rim\"\nuntil = 0", "s:11:9: until must be positive, got 0 s"},
           {"[[hold]]\nregion = \"rim\"\nmotion = {}",
            "s:11:10: missing key \"kind\" in motion, such as kind = \"rotating\""},
           {"[[hold]]\nregion = \"rim\"\nmotion = {kind = \"translating\", rate = 1}",
            "s:11:10: missing key \"velocity\" in motion, such as velocity = [0, 0, \"0.4 m/s\"]\n"
            "s:11:33: key \"rate\" has no meaning in motion: a translating motion takes velocity"},
           {"[[hold]]\nregion = \"rim\"\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = [[0, 1], [0, 2]]}",
            "s:11:64: rate: times must increase, but 0 s follows 0 s"},
           {"[[hold]]\nregion = \"rim\"\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = [1, 2]}",
            "s:11:56: rate: expected rows [time, rate]"},
           {"[[hold]]\nregion = \"rim\"\nmotion = {kind = \"translating\", velocity = [[0, 1]]}",
            "s:11:45: velocity: expected rows [time, x, y, z]"},
           {"[[solid]]\nradius = 1", "s:9:1: missing key \"shape\" in [[solid]], such as shape = \"sphere\""},
           {"[[solid]]\nshape = \"sphere\"\nradius = 1\nrotation = {axis = [0, 1, 0], angle = 1}",
            "s:12:1: key \"rotation\" has no meaning in [[solid]]: shape \"sphere\" takes radius"},
           {"[[solid]]\nshape = \"box\"\nsize = [1, 0, 1]", "s:11:8: size: every edge must be positive"},
           {"[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 0]", "s:11:10: normal: a direction must not be zero"},
           {"[[solid]]\nshape = \"mesh\"\nfile = \"a.vtu\"",
            "s:11:8: file: \"a.vtu\" is of no known kind; known: .obj, .off, .ply, .stl, .vdb"},
           {"[[solid]]\nshape = \"plane\"\ncontact_angle = 1",
            "s:11:1: key \"contact_angle\" has no meaning in [[solid]]: contact is \"stick\"; liquid must \"flow\" or "
            "\"slip\" along it"},
           {"[[solid]]\nshape = \"plane\"\ncontact = \"slip\"\nreceding = true",
            "s:12:1: key \"receding\" has no meaning in [[solid]]: contact is \"slip\"; liquid must \"flow\" along it"},
           {"[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\ncontact_angle = \"200 deg\"",
            "s:12:17: contact_angle: expected an angle from 0 to 180 deg"},
           {"[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\nslip_length = -1",
            "s:12:15: slip_length must not be negative, got -1 m"},
           {"[[solid]]\nshape = \"plane\"\ncontact = \"glue\"",
            "s:11:11: contact: \"glue\" is none of \"stick\", \"flow\", \"slip\""},
           {"[[hold]]\nregion = \"rim\"\nroll = true\nmotion = {kind = \"translating\", velocity = [1, 0, 0]}",
            "s:11:8: roll: a roll takes what enters a part of space: region = {box = [[0, 0, 0], [1, 1, 1]]}, or a "
            "sphere"},
           {"[[hold]]\nregion = {sphere = {center = [0, 0, 0], radius = 1}}\nroll = true",
            "s:11:8: roll: a roll carries what it holds: it needs a motion, such as {kind = \"translating\", velocity "
            "= "
            "[1, 0, 0]}"},
           {"[[outflow]]\npoint = [0, 0, 0]",
            "s:9:1: missing key \"normal\" in [[outflow]], such as normal = [1, 0, 0]"},
           {"[[outflow]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]", "s:11:10: normal: a direction must not be zero"},
           {"[inflow]\nregion = \"outer_rim\"\nvelocity = [0, 0, 0]",
            "s:11:12: velocity: with no velocity nothing flows in"},
           {"[inflow]\nregion = \"outer_rim\"\nradial_velocity = 0",
            "s:11:19: radial_velocity: with no velocity nothing flows in"},
           {"[inflow]\nregion = \"outer_rim\"\nvelocity = [1, 0, 0]\nmotion = {kind = \"translating\"}",
            "s:12:1: key \"motion\" has no meaning in [inflow]: an inlet stands; let the solids move past it the other "
            "way ([[solid]] velocity or motion), which is the same as seen from it"},
           {"[environment]\nair = {wind = [1, 0, 0]}",
            "s:10:7: missing key \"density\" in air, such as density = \"1.2 kg/m^3\""},
           {"[environment]\nair = {density = 1.2, drag_coefficient = 0, friction_coefficient = 0}",
            "s:10:42: drag_coefficient: with neither drag nor friction air does nothing: leave the table out"},
           {"[inflow]", "s:9:1: missing key \"region\" in [inflow], such as region = \"y_max\"\n"
                        "s:9:1: missing key \"velocity\" in [inflow], such as velocity = [0, \"-0.1 m/s\", 0]"},
           {"[tear]\nbelow = 0.02",
            "s:10:9: below: the whole sheet would tear at once: 0.02 m is not less than its thickness 0.02 m"},
           {"[tear]\nbelow = 0.01\ncrumbs = \"eat\"", "s:11:10: crumbs: \"eat\" is none of \"keep\", \"drop\""},
           {"[tear]\nsnap = 1e-5\ncrumbs = \"drop\"",
            "s:11:1: key \"crumbs\" has no meaning in [tear]: only what tears below a thickness comes off in crumbs"},
           {"[tear]", "s:9:1: missing key \"below\" in [tear], such as below = \"0.8 mm\", or sites, or snap"},
           {"[tear]\nsites = 100\nat_thickness = 0.001",
            "s:9:1: missing key \"exponent\" in [tear], such as exponent = 6"},
           {"[tear]\nsites = 100\nexponent = 2",
            "s:9:1: missing key \"at_thickness\" in [tear], such as at_thickness = \"0.6 mm\""},
           {"[tear]\nbelow = 0.001\nseed = 3", "s:11:1: key \"seed\" has no meaning in [tear]: there are no sites"},
           {"[tear]\nsites = \"3 mm\"\nat_thickness = 0.001\nexponent = 6",
            "s:10:9: sites: expected a number per volume such as \"2e4 1/m^3\", got a length (m)"},
           {"[contact]\nadhesion = -1", "s:10:12: adhesion must not be negative, got -1 Pa"},
           {"[contact]\nfriction = 1",
            "s:10:1: unknown key \"friction\" in [contact]; known: self, stiffness, adhesion, "
            "distance"}})
    EXPECT_EQ(problem(disk + liquid + text), expected) << text;
}

TEST(Read, ProblemsOfFlowLaws) {
  const auto of = [](const std::string& material) {
    return problem(disk + "[material]\ndensity = 1000\n" + material + "\n");
  };
  for (const char* good : {"viscosity = 3\nlaw = \"newtonian\"", "viscosity = 3\nlaw = \"power\"\nflow_index = 0.3",
                           "zero_viscosity = 3\ntime_constant = 1\nlaw = \"cross\"\nflow_index = 0.3",
                           "viscosity = 3\nlaw = \"casson\"\nyield_stress = \"2 kPa\"",
                           "law = \"table\"\nrates = [1, 2, 3, 4]\nviscosities = [3, 2, 2, 2]"})
    EXPECT_EQ(of(good), "fine");
  for (const auto& [material, expected] : std::vector<Case>{
           {"law = \"power\"\nviscosity = 1",
            "s:6:1: missing key \"flow_index\" in [material], such as flow_index = 0.5"},
           {"viscosity = 1\nyield_stress = 3",
            "s:9:1: key \"yield_stress\" has no meaning in [material]: law \"newtonian\" takes viscosity alone"},
           {"law = \"bingham\"\nviscosity = 0\nyield_stress = \"3 Pa*s\"",
            "s:9:13: viscosity must be positive, got 0 Pa*s\n"
            "s:10:16: yield_stress: expected a pressure such as \"10 Pa\", got a viscosity (Pa*s)"},
           {"law = \"carreau\"\nviscosity = 1\nzero_viscosity = 1\ninfinite_viscosity = 1\ntime_constant = "
            "1\nflow_index = 0.5",
            "s:9:1: key \"viscosity\" has no meaning in [material]: law \"carreau\" takes zero_viscosity, "
            "infinite_viscosity, time_constant, flow_index, transition\n"
            "s:11:22: infinite_viscosity: expected less than zero_viscosity: the liquid thins from that to this"},
           {"law = \"cross\"\nzero_viscosity = 1\ntime_constant = 1\nflow_index = 1.5",
            "s:11:14: flow_index: expected less than 1"},
           {"law = \"cross\"\nzero_viscosity = 1\ntime_constant = 1e60\nflow_index = 0.5",
            "s:10:17: time_constant: expected a time from 1e-50 to 1e+50 s"},
           {"law = \"carreau\"\nzero_viscosity = 1\ntime_constant = 1\nflow_index = 0.5\ntransition = 30",
            "s:12:14: transition: expected at most 20, which is as sharp as a corner"},
           {"law = \"table\"\nrates = [1e-60, 2, 3, 4]\nviscosities = [3, 2, 2, 2]",
            "s:9:9: rates: expected rates from 1e-50 to 1e+50 1/s"},
           {"law = \"table\"\nrates = [1, 2, 2, 3]\nviscosities = [3, 2, 2, 2]",
            "s:9:9: rates: they must increase from each row to the next"},
           {"law = \"table\"\nrates = [1, 2, 3, 4]\nviscosities = [3, 2, 2]",
            "s:10:15: viscosities: 3 viscosities, but 4 rates"},
           {"law = \"table\"\nrates = [1, 2, 3]\nviscosities = [3, 2, 2]",
            "s:9:9: rates: a table takes four rows or more"},
           {"law = \"table\"\nrates = [1, 2, 3, 4]\nviscosities = [3, 2, 0.5, 0.4]",
            "s:10:15: viscosities: the stress falls as the rate grows, at 2 1/s: the viscosity must not fall faster "
            "than 1/rate"},
           {"law = \"table\"\nrates = 3",
            "s:6:1: missing key \"viscosities\" in [material], such as viscosities = [\"20 Pa*s\", 8, 3, 1.5]\n"
            "s:9:9: rates: expected a list, got a number"},
           {"law = \"glass\"\nviscosity = 1",
            "s:8:7: law: \"glass\" is none of \"newtonian\", \"power\", \"carreau\", \"cross\", \"bingham\", "
            "\"herschel_bulkley\", \"casson\", \"table\""}})
    EXPECT_EQ(of(material), expected) << material;
}

TEST(Read, WhatTheModelNeeds) {
  EXPECT_EQ(problem(disk + "[material]\nviscosity = 1\n[model]\ninertia = false\n"), "fine");
  EXPECT_EQ(
      problem(disk + "[material]\nviscosity = 1\n"),
      "s:6:1: missing key \"density\" in [material]: inertia needs it (or switch it off: inertia = false in [model])");
  EXPECT_EQ(
      problem(disk + "[material]\nviscosity = 1\n[model]\ninertia = false\n[environment]\ngravity = [0, -1, 0]\n"),
      "s:6:1: missing key \"density\" in [material]: gravity needs it");
  EXPECT_EQ(problem(disk + "[material]\nviscosity = 1\n[model]\ninertia = false\n[environment]\nair = {density = 1.2}\n"
                           "[tear]\ndrops = true\n"),
            "s:6:1: missing key \"density\" in [material]: drops in air need it");
  EXPECT_EQ(problem(disk + "[material]\nviscosity = 0\n[model]\ninertia = false\n"),
            "s:7:13: viscosity: 0 needs inertia: nothing else would resist the forces");
  EXPECT_EQ(problem(disk + liquid + "[model]\nfaces = true\n"),
            "s:10:9: faces: needs surface_tension in [material], which acts on them");
  EXPECT_EQ(problem(disk + "[material]\nviscosity = 1\ndensity = 0\n"),
            "s:8:11: density must be positive, got 0 kg/m^3");
}

TEST(Read, BordersOfShapes) {
  const auto hold = [](const std::string& sheet, const std::string& region) {
    return problem("[sheet]\nedge_length = 0.1\nthickness = 0.01\n" + sheet + "\n" + liquid + "[[hold]]\nregion = \"" +
                   region + "\"");
  };
  EXPECT_EQ(hold("shape = \"rectangle\"\nsize = [1, 1]", "z_min"), "fine");
  EXPECT_EQ(hold("shape = \"rectangle\"\nsize = [1, 1]", "y_min"),
            "s:10:10: region: this sheet has no \"y_min\"; it has rim, x_min, x_max, z_min, z_max, as its plane "
            "is \"xz\"; with plane = \"xy\" or \"yz\" it has that");
  EXPECT_EQ(hold("shape = \"rectangle\"\nsize = [1, 1]\nplane = \"xy\"", "y_min"), "fine");
  EXPECT_EQ(hold("shape = \"tube\"\nradius = 1\nheight = 1", "y_max"), "fine");
  EXPECT_EQ(
      hold("shape = \"tube\"\nradius = 1\nheight = 1\nplane = \"xy\"", "y_max"),
      "s:12:10: region: this sheet has no \"y_max\"; it has rim, z_min, z_max, as its plane is \"xy\"; with plane "
      "= \"xz\" it has that");
  EXPECT_EQ(hold("shape = \"sphere\"\nradius = 1", "rim"),
            "s:10:10: region: this sheet has no \"rim\"; it has no border");
  EXPECT_EQ(hold("shape = \"cap\"\nradius = 1\nangle = \"90 deg\"", "inner_rim"),
            "s:11:10: region: this sheet has no \"inner_rim\"; it has rim, outer_rim");
  EXPECT_EQ(hold("shape = \"cap\"\nradius = 1\nangle = \"180 deg\"\nopening = 1", "inner_rim"), "fine");
}

class ReadFile : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("sheet-scene-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "meshes");
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
  }
  void TearDown() override {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }
  static void write(const std::string& name, const std::string& text) { std::ofstream(name) << text; }
  std::filesystem::path folder_, before_;
};

TEST_F(ReadFile, FilesAreLookedForBesideTheScene) {
  std::filesystem::create_directories("scenes");
  write("scenes/a.toml", disk + liquid + "[[solid]]\nshape = \"mesh\"\nfile = \"../meshes/b.off\"\n");
  const auto read = [](const std::filesystem::path& path) {
    try {
      return std::get<SolidMesh>(read_scene(path).solids[0].shape).file;
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(read("scenes/a.toml"), "scenes/a.toml:11:8: file: there is no \"meshes/b.off\"");
  std::filesystem::create_directories("meshes/b.off");
  EXPECT_EQ(read("scenes/a.toml"), "scenes/a.toml:11:8: file: \"meshes/b.off\" is not a file");
  std::filesystem::remove("meshes/b.off");
  write("meshes/b.off", "OFF");
  EXPECT_EQ(read("scenes/a.toml"), "meshes/b.off");
  // An absolute name of the scene puts no absolute name into it.
  EXPECT_EQ(read(folder_ / "scenes/a.toml"), "meshes/b.off");
  // An absolute name in the scene stays.
  write("scenes/a.toml",
        disk + liquid + "[[solid]]\nshape = \"mesh\"\nfile = \"" + (folder_ / "meshes/b.off").string() + "\"\n");
  EXPECT_EQ(read("scenes/a.toml"), (folder_ / "meshes/b.off").string());
}

TEST_F(ReadFile, UnreadableFiles) {
  for (const auto& [name, message] : {std::pair("none.toml", "cannot open none.toml: No such file or directory"),
                                      std::pair("meshes", "cannot read meshes: it is a folder")})
    try {
      (void)read_scene(name);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::io);
      EXPECT_STREQ(error.what(), message);
    }
}

// Several sheets and inlets, named; borders belong to one of them.
constexpr const char* two_sheets = R"([[sheet]]
name = "left"
shape = "rectangle"
size = [1, 1]
segments = [2, 2]
pattern = "structured"
thickness = 0.01
[[sheet]]
name = "right"
shape = "disk"
radius = 1
edge_length = 0.5
thickness = 0.02
enters = "2 s"
[material]
viscosity = 1
density = 1
)";

TEST(Read, SeveralSheets) {
  const Scene s = parse_scene(std::string(two_sheets) + R"([[hold]]
region = {sphere = {center = [0, 0, 0], radius = 1}}
[[hold]]
sheet = "right"
region = "rim"
[[inflow]]
sheet = "left"
region = "x_min"
velocity = [1, 0, 0]
[[inflow]]
sheet = "left"
region = "x_max"
velocity = [-1, 0, 0]
until = 3
)",
                              "s");
  ASSERT_EQ(s.sheets.size(), 2U);
  EXPECT_EQ(s.sheets[1].name, "right");
  EXPECT_EQ(s.sheets[1].enters, 2);
  EXPECT_EQ(s.holds[0].sheet, "");
  EXPECT_EQ(s.holds[1].sheet, "right");
  ASSERT_EQ(s.inflows.size(), 2U);
  EXPECT_EQ(s.inflows[1].sheet, "left");
  EXPECT_EQ(s.inflows[1].thickness, 0.01);
}

// A sheet of its own liquid, and what scenes of several need.
std::string with_own(const std::string& first, const std::string& second) {
  const std::string shape = "[[sheet]]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n";
  return shape + first + shape + second;
}

TEST(Read, SheetsOfTheirOwnLiquids) {
  const std::string honey = "[sheet.material]\nviscosity = 6\ndensity = 1400\n";
  const Scene s = parse_scene(with_own("", honey) + liquid, "s");
  EXPECT_FALSE(s.sheets[0].material);
  EXPECT_EQ(s.sheets[1].material->viscosity, 6);
  EXPECT_EQ(liquids_of(s).size(), 2U);
  EXPECT_EQ(liquid_of(s, s.sheets[1]), 1U);
  EXPECT_EQ(parse_scene(to_toml(s), "again"), s);
  const Scene all = parse_scene(with_own(honey, "[sheet.material]\nviscosity = 7\ndensity = 1000\n"), "s");
  EXPECT_EQ(all.material.viscosity, 6); // where the scene says none, that of the first
  EXPECT_EQ(liquids_of(all).size(), 2U);
  EXPECT_EQ(liquids_of(parse_scene(with_own(honey, honey), "s")).size(), 1U);
  for (const auto& [text, expected] : std::vector<Case>{
           {with_own(honey, ""), "s: missing table [material]"},
           {with_own("", "[sheet.material]\nviscosity = 6\n") + liquid,
            "s:11:1: missing key \"density\" in [sheet.material]: inertia needs it (or switch it off: inertia = false "
            "in [model])"},
           {with_own("", "[sheet.material]\nviscosity = 0\ndensity = 1\n") + liquid,
            "s:12:13: viscosity: one of the scene's liquids has one, and another one has not: give the latter a small "
            "one"},
           {with_own("", "[sheet.material]\nviscosty = 6\ndensity = 1\n") + liquid,
            "s:11:1: missing key \"viscosity\" in [sheet.material], such as viscosity = \"100 Pa*s\"\n"
            "s:12:1: unknown key \"viscosty\" in [sheet.material]; did you mean \"viscosity\"?"},
           {with_own("", "material = 3\n") + liquid, "s:11:12: material: expected a table, got a number"}})
    EXPECT_EQ(problem(text), expected) << text;
}

TEST(Read, ProblemsOfSeveralSheets) {
  EXPECT_EQ(problem(std::string("sheet = []\n") + liquid),
            "s:1:9: sheet: an empty list; there must be a [sheet], or at least one [[sheet]]");
  for (const auto& [text, expected] : std::vector<Case>{
           {"[[hold]]\nregion = \"rim\"",
            "s:18:1: missing key \"sheet\" in [[hold]], such as sheet = \"left\", as there are "
            "several"},
           {"[[hold]]\nregion = \"x_min\"\nsheet = \"right\"",
            "s:19:10: region: this sheet has no \"x_min\"; it has rim, outer_rim"},
           {"[inflow]\nregion = \"x_min\"\nvelocity = [0, 1, 0]\nsheet = \"middle\"",
            "s:21:9: sheet: there is no [[sheet]] \"middle\"; there is \"left\", \"right\""},
           {"[[sheet]]\nname = \"left\"\nshape = \"sphere\"\nradius = 1\nedge_length = 0.1\nthickness = 0.1",
            "s:19:8: name: another [[sheet]] has this name"},
           {"[[sheet]]\nshape = \"mesh\"\nfile = \"a.off\"\nthickness = 1\nenters = 1",
            "s:22:10: enters: a sheet from a mesh file is there from the start; a shape can enter"}})
    EXPECT_EQ(problem(two_sheets + text), expected) << text;
}

TEST(Read, ArraysOfAMeshGoAlongAndChooseWhatIsHeld) {
  const std::string mesh = "[sheet]\nshape = \"mesh\"\nfile = \"a.ply\"\nthickness = 0.02\n";
  const Scene s =
      parse_scene(mesh + "arrays = [\"blender.uv\", \"material\"]\n" + liquid +
                      "[[hold]]\nregion = {array = \"painted\"}\n[inflow]\nregion = {array = \"in\"}\nvelocity "
                      "= [0, 0, -1]\n",
                  "s");
  EXPECT_EQ(s.sheets[0].arrays, (std::vector<std::string>{"blender.uv", "material"}));
  EXPECT_EQ(std::get<ArrayRegion>(s.holds[0].region).array, "painted");
  EXPECT_EQ(std::get<ArrayRegion>(s.inflows[0].region).array, "in");
  EXPECT_EQ(parse_scene(to_toml(s), "again"), s);
  const auto wrong = [&](const std::string& line) { return problem(mesh + line + "\n" + liquid); };
  for (const char* name : {"position", "tear.volume", "thickness", "Capital", "", "a b"})
    EXPECT_NE(wrong("arrays = [\"" + std::string(name) + "\"]").find("cannot be the name"), std::string::npos) << name;
  EXPECT_NE(wrong("arrays = [\"a\", \"a\"]").find("twice"), std::string::npos);
  EXPECT_NE(wrong("arrays = \"a\"").find("expected names"), std::string::npos);
  EXPECT_NE(problem(disk + "arrays = [\"a\"]\n" + liquid).find("shape \"mesh\""), std::string::npos);
  EXPECT_NE(problem(disk + liquid + "[[hold]]\nregion = {array = \"a\"}\n").find("shape \"mesh\""), std::string::npos);
  EXPECT_NE(problem(mesh + liquid +
                    "[[hold]]\nregion = {array = \"a\"}\nroll = true\nmotion = {kind = \"translating\", "
                    "velocity = [1, 0, 0]}\n")
                .find("a part of space"),
            std::string::npos);
}

} // namespace
} // namespace sheet::scene
