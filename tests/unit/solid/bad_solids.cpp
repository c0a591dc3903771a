// SPDX-License-Identifier: GPL-3.0-or-later
// What is no solid is refused, with the place and a remedy.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/solid/check.h"
#include "libsheet/solid/solids.h"
#include "tests/unit/own_path.h"
#include "tests/unit/solid/solid_support.h"

namespace sheet::solid {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string problem(const SolidSurface& surface) {
  try {
    check_surface(surface, "solid 3 (x.off)");
    return "fine";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
}

SolidSurface box() { return box_surface({1, 1, 1}); }

void append(SolidSurface& surface, const SolidSurface& other, const Vector3& by, bool turned) {
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  for (const Vector3& x : other.points)
    surface.points.push_back(x + by);
  for (const auto& [a, b, c] : other.triangles)
    surface.triangles.push_back({first + a, first + (turned ? c : b), first + (turned ? b : c)});
}

TEST(BadSolids, GoodOnesPass) {
  EXPECT_EQ(problem(box()), "fine");
  EXPECT_EQ(problem(surface_of(test::icosphere(2))), "fine");
  SolidSurface two = box();
  append(two, box(), {3, 0, 0}, false);
  EXPECT_EQ(problem(two), "fine");
  SolidSurface hollow = box();
  append(hollow, box_surface({0.5, 0.5, 0.5}), {0, 0, 0}, true);
  EXPECT_EQ(problem(hollow), "fine");
}

TEST(BadSolids, Open) {
  SolidSurface surface = box();
  surface.triangles.pop_back();
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("solid 3 (x.off)"), HasSubstr("open along 3 edges"), HasSubstr("0.5"),
                                      HasSubstr("close its holes"), HasSubstr("a height field needs sides")));
}

TEST(BadSolids, NotWelded) {
  for (const double apart : {0.0, 1e-16}) {
    SolidSurface soup;
    for (const auto& triangle : box().triangles) {
      for (const std::uint32_t v : triangle)
        soup.points.push_back(box().points[v] * (1 + apart * static_cast<double>(soup.triangles.size())));
      const auto last = static_cast<std::uint32_t>(soup.points.size());
      soup.triangles.push_back({last - 3, last - 2, last - 1});
    }
    EXPECT_THAT(problem(soup), AllOf(HasSubstr("open along 36 edges that lie on each other"), HasSubstr("weld")));
  }
}

TEST(BadSolids, PartlyWelded) {
  SolidSurface surface = box(); // one side is a part of its own, less a triangle
  surface.triangles.pop_back();
  auto& corners = surface.triangles.back();
  for (std::uint32_t& v : corners) {
    surface.points.push_back(surface.points[v]);
    v = static_cast<std::uint32_t>(surface.points.size() - 1);
  }
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("4 of them lie on each other: weld"), HasSubstr("holes that remain")));
}

TEST(BadSolids, OverlappingPartsIntersectWhateverTheirSides) {
  SolidSurface surface = box();
  append(surface, box(), {0.4, 0.3, 0.2}, false);
  for (const bool simple : {false, true}) {
    try {
      check_surface(surface, "x.off", simple);
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("intersects itself"));
    }
  }
}

TEST(BadSolids, InsideOut) {
  SolidSurface surface;
  append(surface, box(), {0, 0, 0}, true);
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("inside out"), HasSubstr("turn its triangles round")));
}

TEST(BadSolids, OnePartInsideAnother) {
  SolidSurface surface = box();
  append(surface, box_surface({0.5, 0.5, 0.5}), {0, 0, 0}, false);
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("lies inside another one"), HasSubstr("take it away")));
}

TEST(BadSolids, OnePartInsideOut) {
  SolidSurface surface = box();
  append(surface, box_surface({0.5, 0.5, 0.5}), {3, 0, 0}, true);
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("inside out"), HasSubstr("2.75")));
}

TEST(BadSolids, OneTriangleTurned) {
  SolidSurface surface = box();
  std::swap(surface.triangles[4][0], surface.triangles[4][1]);
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("run the same way"), HasSubstr("orient them alike")));
}

TEST(BadSolids, IntersectingItself) {
  SolidSurface surface = box();
  append(surface, box(), {0.4, 0.3, 0.2}, false);
  EXPECT_THAT(problem(surface), AllOf(HasSubstr("intersects itself"), HasSubstr("unite its parts")));
}

TEST(BadSolids, NoVolume) {
  SolidSurface flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  flat.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_THAT(problem(flat), HasSubstr("encloses no volume"));
}

TEST(BadSolids, NoArea) {
  SolidSurface surface = box();
  surface.points[1] = surface.points[0];
  EXPECT_THAT(problem(surface), HasSubstr("has no area"));
}

TEST(BadSolids, NotFinite) {
  SolidSurface surface = box();
  surface.points[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(problem(surface), HasSubstr("vertex 5 is not finite"));
}

TEST(BadSolids, TooFewTriangles) { EXPECT_THAT(problem({}), HasSubstr("at least 4")); }

// As a scene's solid, from a file.
class BadFiles : public testing::Test {
protected:
  void SetUp() override {
    folder_ = test::own_path("bad_solids");
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Error load(const std::string& name, const std::string& text) {
    if (!text.empty())
      std::ofstream(folder_ / name, std::ios::binary) << text;
    Scene scene;
    scene.solids.resize(2);
    scene.solids[1].shape = scene::SolidMesh{(folder_ / name).string(), 1, {}};
    try {
      Solids solids(scene);
    } catch (const Error& error) {
      return error;
    }
    return {ExitCode::ok, "fine"};
  }

private:
  std::filesystem::path folder_;
};

TEST_F(BadFiles, Missing) {
  for (const char* name : {"nonesuch.off", "nonesuch.vdb"}) {
    const Error error = load(name, "");
    EXPECT_EQ(error.code(), ExitCode::io) << name;
    EXPECT_THAT(error.what(), HasSubstr(name));
    EXPECT_THAT(error.what(), HasSubstr("folder in which sheet-init ran"));
  }
}

TEST_F(BadFiles, UnknownKind) {
  const Error error = load("solid.step", "ISO-10303-21;");
  EXPECT_EQ(error.code(), ExitCode::bad_input);
  EXPECT_THAT(error.what(), HasSubstr("solid.step"));
}

TEST_F(BadFiles, NotANumber) {
  const Error error =
      load("solid.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  EXPECT_EQ(error.code(), ExitCode::bad_input);
  EXPECT_THAT(error.what(), HasSubstr("solid.off"));
}

TEST_F(BadFiles, NotAField) {
  const Error error = load("solid.vdb", std::string(1000, 'x'));
  EXPECT_NE(error.code(), ExitCode::ok);
  EXPECT_THAT(error.what(), HasSubstr("solid.vdb"));
}

TEST_F(BadFiles, OpenSurface) {
  const Error error = load("solid.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 1 3\n");
  EXPECT_EQ(error.code(), ExitCode::bad_input);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("solid 1"), HasSubstr("solid.off")));
}

} // namespace
} // namespace sheet::solid
