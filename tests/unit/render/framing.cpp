// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/framing.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

const ViewFit any_view({}, Vector3::UnitY(), 1, {});

Box box(const Vector3& low, const Vector3& high) {
  Box b;
  b.add(low);
  b.add(high);
  return b;
}

TEST(Camera, TheBoxIsInThePictureAndFillsIt) {
  for (const double aspect : {0.5, 1.0, 16.0 / 9})
    for (const double azimuth : {-100.0, 0.0, 30.0})
      for (const double elevation : {-90.0, 0.0, 25.0, 90.0})
        for (const Vector3& up : {Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(0.6, -0.8, 0)}) {
          CameraOptions o;
          o.azimuth = azimuth;
          o.elevation = elevation;
          const Box b = box({1, 2, 3}, {1.4, 2.1, 5});
          const Camera camera = test::frame_box(b, o, up, aspect, 0.02),
                       tight = test::frame_box(b, o, up, aspect, -0.02);
          bool all = true, all_tight = true;
          for (int c = 0; c < 8; ++c) {
            const Vector3 p((c & 1) != 0 ? 1.4 : 1, (c & 2) != 0 ? 2.1 : 2, (c & 4) != 0 ? 5 : 3);
            all = all && camera.sees(p);
            all_tight = all_tight && tight.sees(p);
          }
          EXPECT_TRUE(all);
          EXPECT_FALSE(all_tight);
        }
}

TEST(Camera, StandsBeforePlanes) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  const auto azimuth = [&](std::vector<Vector3> normals) {
    return views_before_planes({}, y, normals).front().azimuth;
  };
  const auto elevation = [&](std::vector<Vector3> normals) {
    return views_before_planes({}, y, normals).front().elevation;
  };
  EXPECT_EQ(azimuth({}), 30);
  EXPECT_EQ(azimuth({y}), 30);
  EXPECT_EQ(azimuth({y, x}), 60); // not aslant
  EXPECT_EQ(azimuth({y, -x}), -60);
  EXPECT_EQ(azimuth({-z}), 150);
  EXPECT_EQ(azimuth({-x, -z}), -120);
  EXPECT_EQ(azimuth({x, -x}), 0); // along both of them
  EXPECT_EQ(azimuth({-y}), 30);
  EXPECT_EQ(elevation({}), 25);
  EXPECT_EQ(elevation({y, -x}), 25);
  EXPECT_EQ(elevation({-y}), -25); // a ceiling is looked at from below
  EXPECT_EQ(elevation({-y, x}), -25);
  EXPECT_EQ(elevation({y, -y}), 0); // level, between both
  CameraOptions asked;
  asked.elevation = 40;
  EXPECT_EQ(views_before_planes(asked, y, std::vector<Vector3>{-y}).front().elevation, 40);
}

TEST(Camera, GrowsAboutTheMiddleAndLooksAtItsTarget) {
  CameraOptions o;
  ViewFit fit(o, {0, 1, 0}, 1, {});
  fit.add({0, 0, 0}, 1);
  const Vector3 eye = fit.camera({0, 0, 0}, 0).eye(), far = fit.camera({0, 0, 0}, 0.5).eye();
  EXPECT_NEAR(eye.norm(), 1 / std::sin(14 * std::numbers::pi / 180), 1e-9); // the cone touches the ball
  EXPECT_NEAR((far - 1.5 * eye).norm(), 0, 1e-9);
  o.target = Vector3(0.3, 0.1, 0.2);
  ViewFit aimed(o, {0, 1, 0}, 1, {});
  aimed.add({0, 0, 0}, 1);
  const Camera camera = aimed.camera({0, 0, 0}, 0);
  EXPECT_NEAR((*o.target - camera.eye()).normalized().dot(camera.axis().cast<double>()), 1, 1e-6);
  for (const Vector3& p : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(0, 0, -1), Vector3(0, 1, 0)})
    EXPECT_TRUE(camera.sees(p));
}

// A margin at one side moves the subject to the other, and no more.
TEST(Camera, MarginsAreKeptFreeAtEachSide) {
  const Box b = box({-1, -1, -1}, {1, 1, 1});
  for (const double aspect : {0.6, 2.0}) {
    const Margins margins{0.3, 0.02, 0.05, 0.1};
    ViewFit fit({}, Vector3::UnitY(), aspect, margins);
    for (int c = 0; c < 8; ++c)
      fit.add({(c & 1) != 0 ? 1.0 : -1, (c & 2) != 0 ? 1.0 : -1, (c & 4) != 0 ? 1.0 : -1}, 0);
    const Camera camera = fit.camera(b.middle(), 0);
    const auto at_depth_1 = [&](double x, double y) {
      const Vector3 d = camera.direction(x, y).cast<double>();
      return Vector3(d / d.dot(camera.axis().cast<double>()));
    };
    const Vector3 corner = at_depth_1(0, 0), right = at_depth_1(1, 0) - corner, down = at_depth_1(0, 1) - corner;
    double low_x = 1, high_x = 0, low_y = 1, high_y = 0;
    for (int c = 0; c < 8; ++c) {
      const Vector3 p = Vector3((c & 1) != 0 ? 1 : -1, (c & 2) != 0 ? 1 : -1, (c & 4) != 0 ? 1 : -1) - camera.eye();
      Eigen::Matrix3d m; // p in parts of the picture: corner + x right + y down
      m << corner, right, down;
      const Vector3 at = m.inverse() * p;
      low_x = std::min(low_x, at.y() / at.x());
      high_x = std::max(high_x, at.y() / at.x());
      low_y = std::min(low_y, at.z() / at.x());
      high_y = std::max(high_y, at.z() / at.x());
    }
    EXPECT_GE(low_x, margins.left - 1e-5);
    EXPECT_LE(high_x, 1 - margins.right + 1e-5);
    EXPECT_GE(low_y, margins.top - 1e-5);
    EXPECT_LE(high_y, 1 - margins.bottom + 1e-5);
    const double free_x = 1 - margins.left - margins.right, free_y = 1 - margins.top - margins.bottom;
    EXPECT_NEAR(std::max((high_x - low_x) / free_x, (high_y - low_y) / free_y), 1, 1e-5); // one pair is filled
  }
}

TEST(Camera, DirectionsAreUpright) {
  const Camera camera({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 2);
  const Vec middle = camera.direction(0.5, 0.5), upper = camera.direction(0.5, 0), right = camera.direction(1, 0.5);
  EXPECT_NEAR((middle - Vec(0, 0, -1)).norm(), 0, 1e-6);
  EXPECT_NEAR(std::atan2(upper.y(), -upper.z()), 20 * std::numbers::pi / 180, 1e-6);
  EXPECT_GT(right.x(), 0);
  EXPECT_NEAR(right.x() / -right.z(), 2 * std::tan(20 * std::numbers::pi / 180), 1e-6);
  EXPECT_FALSE(camera.sees({0, 0, 6}));
  EXPECT_TRUE(camera.sees({0, 0, 1}));
}

TEST(Survey, SolidsCountUnlessTheyAreLarge) {
  const formats::Frame frame = test::flat(2, 0.01);
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::Sphere{0.2};
  scene.solids[0].center = {0, -1, 0};
  for (const double radius : {0.2, 20.0}) {
    scene.solids[0].shape = scene::Sphere{radius};
    Survey survey({any_view});
    survey.add(frame, &scene, make_solids(scene), {});
    EXPECT_NEAR(survey.subject().box.low.y(), radius < 1 ? -1.2 : -0.005, 1e-3);
  }
  Survey empty({any_view});
  empty.add(make_frame({}, {}, {}), nullptr, {}, looks()[1].second);
  EXPECT_TRUE(empty.subject().box.empty());
  EXPECT_TRUE(empty.scale().empty());
}

// Of a sheet of 1 m² that is 4 m below a ball of 0.2 m radius, or 0.4 m.
TEST(Survey, WhatFallsForEverIsNotFollowed) {
  const auto lowest = [](double below, auto&& change) {
    Scene scene;
    scene.environment.gravity = Vector3(0, -9.81, 0);
    scene.solids.resize(1);
    scene.solids[0].shape = scene::Sphere{0.2};
    scene.solids[0].center = {0, below, 0};
    change(scene);
    Survey survey({any_view});
    survey.add(test::flat(2, 0.01), &scene, make_solids(scene), {});
    return survey.subject().box.low.y();
  };
  const auto alone = [](Scene&) {};
  EXPECT_NEAR(lowest(0.4, alone), -0.005, 1e-9);
  EXPECT_NEAR(lowest(4, alone), 3.8, 1e-3); // of the ball
  EXPECT_NEAR(lowest(4, [](Scene& scene) { scene.environment.gravity.reset(); }), -0.005, 1e-9);
  const auto with_outflow = [](const Vector3& normal) {
    return [=](Scene& scene) { scene.outflows = {{.point = Vector3::Zero(), .normal = normal}}; };
  };
  EXPECT_NEAR(lowest(4, with_outflow(-Vector3::UnitY())), -0.005, 1e-9);
  EXPECT_NEAR(lowest(4, with_outflow(Vector3::UnitX())), 3.8, 1e-3);
  EXPECT_NEAR(lowest(4, [](Scene& scene) { scene.environment.bath.emplace(); }), -0.005, 1e-9);
  const auto with_plane = [](const Vector3& normal) {
    return [=](Scene& scene) { scene.solids.emplace_back().shape.emplace<scene::HalfSpace>(normal); };
  };
  EXPECT_NEAR(lowest(4, with_plane(Vector3::UnitY())), -0.005, 1e-9);
  EXPECT_NEAR(lowest(4, with_plane(Vector3::UnitX())), 3.8, 1e-3); // a wall
}

// What floats displaces the bath, whose surface is below it; what runs down a slope into the bath goes under.
TEST(Framing, ABathIsAtItsLevelWhereThereIsAShore) {
  Box subject;
  subject.add(Vector3(-1, -1, -1));
  subject.add(Vector3(1, 3, 1));
  const auto surface_at = [&](double level, bool shore) {
    return bath_surface(level, subject, Vector3::UnitY(), shore).point.y();
  };
  EXPECT_NEAR(surface_at(0.5, true), 0.5, 1e-12);
  EXPECT_NEAR(surface_at(0.5, false), -1, 0.2);
  EXPECT_NEAR(surface_at(-2, false), -2, 1e-12);
  const auto shore = [](const Vector3& gravity, const Vector3& normal) {
    Scene scene;
    scene.environment.gravity = gravity;
    scene.solids.emplace_back().shape.emplace<scene::HalfSpace>(normal);
    return has_shore(scene);
  };
  EXPECT_TRUE(shore({0, -9.81, 0}, {0.5, 0.9, 0}));
  EXPECT_TRUE(shore({1.7, -9.66, 0}, {0, 1, 0}));
  EXPECT_FALSE(shore({0, -9.81, 0}, {0, 1, 0})); // its ground
  EXPECT_FALSE(shore({0, -9.81, 0}, {1, 0, 0})); // the side of a basin
  EXPECT_FALSE(shore({0, -9.81, 0}, {0.5, -0.9, 0}));
}

// A sheet hangs from a clip, then 4 m below it, torn off or not, then when the clip has opened.
TEST(Survey, WhatFallsFromHoldsIsNotFollowed) {
  Scene scene;
  scene.environment.gravity = Vector3(0, -9.81, 0);
  scene.holds.resize(1);
  const auto lowest = [&](bool hangs, double held_until) {
    scene.holds[0].until = held_until;
    formats::Frame frame = test::flat(2, 0.01);
    put_masks(frame, "hold")[0] = 1;
    Survey survey({any_view});
    survey.add(frame, &scene, {}, {});
    for (std::size_t v = hangs ? 1 : 0; v < frame.vertices; ++v)
      positions(frame)[v].y() -= 4;
    if (!hangs)
      put_masks(frame, "hold")[0] = held_until > 1 ? 0 : 1;
    frame.time = 1;
    survey.add(frame, &scene, {}, {});
    return survey.subject().box.low.y();
  };
  EXPECT_NEAR(lowest(true, 2), -4.005, 0.01);
  EXPECT_NEAR(lowest(false, 2), -0.005, 1e-9);
  EXPECT_NEAR(lowest(false, 0.5), -0.005, 1e-9);
  scene.holds[0].axes = 1; // it may slide down
  EXPECT_NEAR(lowest(false, 2), -4.005, 1e-9);
}

TEST(Survey, MovingSolidsAreSeenWhereTheyAre) {
  formats::Frame frame = test::flat(2, 0.01);
  frame.time = 2;
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::SolidBox{{0.2, 0.2, 0.2}};
  scene::Translating moving;
  moving.velocity.entries = {{0, Vector3(0, 0.5, 0)}};
  scene.solids[0].motion = moving;
  Survey survey({any_view});
  survey.add(frame, &scene, make_solids(scene), {});
  EXPECT_NEAR(survey.subject().box.high.y(), 1.1, 1e-4);
}

TEST(Ground, LiesBelow) {
  const Plane ground = ground_below(box({0, -1, 0}, {1, 1, 1}), {0, 0, 1});
  EXPECT_LT(ground.point.z(), 0);
  EXPECT_GT(ground.point.z(), -0.1);
}

} // namespace
} // namespace sheet::render
