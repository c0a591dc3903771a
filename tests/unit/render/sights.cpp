// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/sights.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

// Boxes on all four sides of a sheet of 1 m² at the height 0, so high above it.
Scene walls(double above) {
  Scene scene;
  const auto add = [&](const Vector3& center, const Vector3& size) {
    scene.solids.emplace_back().shape = scene::SolidBox{size};
    scene.solids.back().center = center;
  };
  for (const double side : {-0.6, 0.6}) {
    add({side, above / 2 - 0.1, 0}, {0.1, above + 0.2, 1.3});
    add({0, above / 2 - 0.1, side}, {1.3, above + 0.2, 0.1});
  }
  return scene;
}

// Of the best view of it [degrees].
double best_elevation(const Scene& scene, const formats::Frame& frame) {
  std::vector<Vector3> toward;
  CameraOptions options;
  const std::vector<ViewAngles> views = views_before_planes(options, Vector3::UnitY(), {});
  for (const ViewAngles& view : views) {
    options.azimuth = view.azimuth;
    options.elevation = view.elevation;
    toward.push_back(direction_to_camera(options, Vector3::UnitY()));
  }
  Sights sights(toward);
  sights.add(frame, &scene, make_solids(scene));
  return views[sights.best(sights.enclosing(true))].elevation;
}

TEST(Sights, WhatIsBetweenWallsIsSeenFromHighAbove) {
  const formats::Frame frame = test::flat(8, 0.01);
  EXPECT_EQ(best_elevation({}, frame), 25);
  EXPECT_EQ(best_elevation(walls(0.1), frame), 25);
  EXPECT_EQ(best_elevation(walls(0.4), frame), 50);
  EXPECT_EQ(best_elevation(walls(2), frame), 75);
}

TEST(Sights, OneSolidEnclosesOrALidOnSomething) {
  const formats::Frame frame = test::flat(8, 0.01);
  Scene scene;
  scene.solids.emplace_back().shape = scene::Sphere{1};
  scene.solids.emplace_back().shape = scene::SolidBox{{3, 0.1, 3}};
  scene.solids.back().center = {0, -2, 0};
  const auto enclosing = [&](bool in_picture = true) {
    Sights sights({Vector3(0.6, 0.8, 0), Vector3(0, 0.6, 0.8)});
    sights.add(frame, &scene, make_solids(scene));
    return sights.enclosing(in_picture);
  };
  EXPECT_EQ(enclosing(), std::vector<std::size_t>{0});
  scene.solids[0].shape = scene::SolidBox{{3, 0.1, 3}}; // above and below: each hides it from its side
  scene.solids[0].center = {0, 0.1, 0};
  scene.solids[1].center = {0, -0.1, 0};
  EXPECT_EQ(enclosing(), std::vector<std::size_t>{0});      // only the lid, which stands before the cameras
  EXPECT_EQ(enclosing(false), std::vector<std::size_t>{0}); // so large that the cameras are within it, or behind
  scene.solids.push_back(scene.solids[0]); // with a rib below the lid, seen before the lid from the sheet
  scene.solids.back().shape = scene::SolidBox{{0.5, 0.02, 3}};
  scene.solids.back().center = {0, 0.03, 0};
  EXPECT_EQ(enclosing(), std::vector<std::size_t>{0});
  scene.solids.resize(1);
  EXPECT_TRUE(enclosing().empty()); // from below one would see it
  const std::vector<Vector3> toward{Vector3(0.6, 0.8, 0)}, table{Vector3::UnitY()}, ceiling{-Vector3::UnitY()};
  for (const auto& normals : {table, ceiling}) {
    Sights sights(toward, normals);
    sights.add(frame, &scene, make_solids(scene));
    EXPECT_EQ(sights.enclosing(true).size(), normals == table ? 1 : 0);
  }
  Sights none({});
  none.add(frame, &scene, make_solids(scene));
  EXPECT_TRUE(none.enclosing(true).empty());
  EXPECT_EQ(none.best({}), 0);
}

} // namespace
} // namespace sheet::render
