// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/release.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheet::collide {
namespace {

// A patch hangs under a plate that is tilted by 30 degrees and moves: the tension that counts is normal to the plate.
TEST(Release, PulledHarderThanTheAdhesion) {
  const Vector3 normal = Vector3(0.5, -std::sqrt(0.75), 0);
  Scene scene;
  scene.solids.resize(2);
  scene.solids[0].shape = scene::Sphere{1};
  scene.solids[0].center = {0, 50, 0};
  scene.solids[1].shape = scene::HalfSpace{normal};
  scene.solids[1].motion = scene::Translating{{{{0, {0, 3, 0}}}}};
  const solid::Solids solids(scene);
  StepPath path;
  path.end_time = 0.5;
  path.end = {{0, 1.4, 0}, {1, 1.9, 0}, {0, 1.4, 1}, {1, 1.9, 1}, {0, 1.4, 2}};
  path.touch = {1, 1, 1, no_solid, 1};
  const double area = 0.25, tension = 8; // [m²], [Pa]
  const std::vector<double> areas(5, area);
  const Vector3 along = Vector3(std::sqrt(0.75), 0.5, 0);
  const std::vector<Vector3> force = {-tension * area * normal + 100 * along, tension * area * normal,
                                      -1.01 * tension * area * normal, -9 * tension * area * normal, Vector3::Zero()};
  using List = std::vector<std::uint32_t>;
  EXPECT_EQ(pulled_off(path, solids, force, {}, 1.001 * tension, areas), (List{2}));
  EXPECT_EQ(pulled_off(path, solids, force, {}, 0.999 * tension, areas), (List{0, 2}));
  EXPECT_EQ(pulled_off(path, solids, force, {}, 1.02 * tension, areas), List{});
  EXPECT_EQ(pulled_off(path, solids, force, {}, 0, areas), (List{0, 2}));
}

// What flows in a layer is pulled off by its load where all around it lies on the wall, and by all forces beside what
// has come off.
TEST(Release, LayersThatFlowComeOffWhereAirIs) {
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::HalfSpace{Vector3(0, 1, 0)};
  const std::vector<Corners> triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}};
  StepPath path;
  path.end.assign(5, Vector3::Zero());
  path.triangles = triangles;
  path.touch = {0, 0, 0, 0, no_solid};
  const std::vector<double> areas(5, 1);
  const std::vector<Vector3> force(5, Vector3(0, -3, 0)), load(5, Vector3(0, -1, 0));
  const auto off = [&](SolidContact contact, std::span<const Vector3> of_load, double adhesion) {
    scene.solids[0].contact = contact;
    return pulled_off(path, solid::Solids(scene), force, of_load, adhesion, areas);
  };
  using List = std::vector<std::uint32_t>;
  EXPECT_EQ(off(SolidContact::flow, load, 2), (List{2, 3}));
  EXPECT_EQ(off(SolidContact::slip, load, 2), (List{2, 3}));
  EXPECT_EQ(off(SolidContact::flow, load, 0.5), (List{0, 1, 2, 3}));
  EXPECT_EQ(off(SolidContact::flow, {}, 2), (List{0, 1, 2, 3}));
  EXPECT_EQ(off(SolidContact::stick, load, 2), (List{0, 1, 2, 3}));
}

} // namespace
} // namespace sheet::collide
