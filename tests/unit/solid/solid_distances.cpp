// SPDX-License-Identifier: GPL-3.0-or-later
// Signed distances and first hits of all shapes, against closed forms, differences and samples.
#include <filesystem>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "libsheet/solid/solids.h"
#include "libsheet/solid/triangle_distance.h"
#include "libsheet/solid/triangle_tree.h"
#include "tests/support/slow_searches.h"
#include "tests/unit/own_path.h"
#include "tests/unit/solid/solid_support.h"

namespace sheet::solid {
namespace {

double at(const SolidDistance& shape, const Vector3& x) { return shape.nearest(x).distance; }

TEST(SolidDistances, ClosedForms) {
  const auto sphere = make_distance(scene::Sphere{2});
  EXPECT_DOUBLE_EQ(at(*sphere, {3, 0, 4}), 3);
  EXPECT_DOUBLE_EQ(at(*sphere, {0, 0, 0}), -2);
  const auto box = make_distance(scene::SolidBox{{2, 4, 6}});
  EXPECT_DOUBLE_EQ(at(*box, {0.5, 0, 0}), -0.5);
  EXPECT_DOUBLE_EQ(at(*box, {0, 5, 0}), 3);
  EXPECT_DOUBLE_EQ(at(*box, {-4, 6, 0}), 5); // from an edge
  EXPECT_DOUBLE_EQ(at(*box, {2, 4, -5}), 3); // from a corner
  const auto capsule = make_distance(scene::Capsule{1, 4});
  EXPECT_DOUBLE_EQ(at(*capsule, {0, 0, 3}), 2);
  EXPECT_DOUBLE_EQ(at(*capsule, {3, -6, 0}), 4); // from the lower end
  EXPECT_DOUBLE_EQ(at(*capsule, {0, 2, 0}), -1);
  const auto cylinder = make_distance(scene::Cylinder{1, 4});
  EXPECT_DOUBLE_EQ(at(*cylinder, {0, 1.5, 0}), -0.5);
  EXPECT_DOUBLE_EQ(at(*cylinder, {0, 0, 3}), 2);
  EXPECT_DOUBLE_EQ(at(*cylinder, {4, 6, 0}), 5); // from the upper rim
  const auto plane = make_distance(scene::HalfSpace{{0, 3, 0}});
  EXPECT_DOUBLE_EQ(at(*plane, {7, -2, 1}), -2);
  EXPECT_EQ(plane->nearest({7, -2, 1}).normal, Vector3(0, 1, 0));
}

// The normal is the gradient, wherever there is one.
TEST(SolidDistances, NormalsByDifferences) {
  constexpr double step = 1e-6;
  for (const NamedShape& shape : all_shapes()) {
    RandomPoints points(1.2);
    int kinks = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3 x = points.next();
      Vector3 gradient;
      for (int k = 0; k < 3; ++k)
        gradient[k] =
            (at(*shape.distance, x + step * Vector3::Unit(k)) - at(*shape.distance, x - step * Vector3::Unit(k))) /
            (2 * step);
      const Vector3 normal = shape.distance->nearest(x).normal;
      EXPECT_NEAR(normal.norm(), 1, 1e-12) << shape.name;
      kinks += (gradient - normal).norm() > 1e-4 ? 1 : 0;
    }
    EXPECT_LE(kinks, 2) << shape.name; // points by chance within a step of a ridge
  }
}

TEST(SolidDistances, OfConvexShapesLieAboveTheirTangentPlanes) {
  for (const NamedShape& shape : convex_shapes()) {
    RandomPoints points(1.5);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 x = points.next(), y = points.next();
      const Near near = shape.distance->nearest(x);
      ASSERT_GE(at(*shape.distance, y), near.distance + near.normal.dot(y - x) - 1e-12) << shape.name;
    }
  }
}

TEST(SolidDistances, MeshOfABoxIsTheBox) {
  const auto mesh = make_distance(box_surface({1, 0.6, 1.4}), 0.05);
  const auto box = make_distance(scene::SolidBox{{1, 0.6, 1.4}});
  RandomPoints points(1.2);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 x = points.next();
    ASSERT_NEAR(at(*mesh, x), at(*box, x), 1e-13);
  }
}

// `distance` may be coarse only beyond `enough`, and never has the wrong sign.
TEST(SolidDistances, EnoughIsEnough) {
  for (const NamedShape& shape : all_shapes()) {
    RandomPoints points(1.5);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 x = points.next();
      const double exact = at(*shape.distance, x), enough = std::abs(points.next().x()) / 3;
      const double coarse = shape.distance->distance(x, enough);
      if (std::abs(exact) < enough)
        ASSERT_EQ(coarse, exact) << shape.name;
      else {
        ASSERT_GE(std::abs(coarse), enough) << shape.name;
        ASSERT_LE(std::abs(coarse), std::abs(exact) + 1e-12) << shape.name;
        ASSERT_EQ(coarse < 0, exact < 0) << shape.name;
      }
    }
  }
}

TEST(TriangleDistance, AgainstSamples) {
  RandomPoints points(1);
  int intersecting = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 apart = points.next();
    const Triangle3 a{points.next(), points.next(), points.next()};
    const Triangle3 b{points.next() + apart, points.next() + apart, points.next() + apart};
    const TrianglePair pair = nearest_points(a, b);
    EXPECT_NEAR((pair.first - pair.second).norm(), pair.distance, 1e-12);
    EXPECT_LT((point_of(a, pair.weights) - pair.first).norm(), 1e-12);
    EXPECT_NEAR(pair.distance, nearest_points(b, a).distance, 1e-12);
    EXPECT_LT((nearest_on_triangle(pair.first, b).point - pair.first).norm(), pair.distance + 1e-12);
    double least = 10;
    for (int j = 0; j <= 40; ++j)
      for (int k = 0; j + k <= 40; ++k) {
        const Vector3 x = point_of(a, {1 - (j + k) / 40.0, j / 40.0, k / 40.0});
        least = std::min(least, (x - nearest_on_triangle(x, b).point).norm());
      }
    EXPECT_LE(pair.distance, least + 1e-12);
    EXPECT_GE(pair.distance, least - 0.06); // the spacing of the samples
    intersecting += pair.distance == 0 ? 1 : 0;
  }
  EXPECT_GT(intersecting, 20);
  EXPECT_LT(intersecting, 280);
}

TEST(TriangleTree, FindsWhatLookingAtAllFinds) {
  const TriangleTree tree(surface_of(test::icosphere(2)));
  RandomPoints points(1.5);
  for (int i = 0; i < 200; ++i) {
    const Vector3 c = points.next();
    const Triangle3 t{c, c + 0.3 * points.next(), c + 0.3 * points.next()};
    double least = 10;
    for (const Corners& corners : tree.surface().triangles)
      least = std::min(least, nearest_points(t, {tree.surface().points[corners[0]], tree.surface().points[corners[1]],
                                                 tree.surface().points[corners[2]]})
                                  .distance);
    EXPECT_NEAR(tree.nearest(t, 10).distance, least, 1e-13);
    EXPECT_EQ(tree.nearest(t, least / 2).distance, least / 2);
  }
}

// A level triangle comes down on the top of each shape: it hits when its plane is at the clearance, give or take the
// tolerance.
TEST(FirstHit, ClosedForm) {
  const double clearance = 0.01, tolerance = 0.001;
  std::vector<std::pair<std::unique_ptr<const SolidDistance>, double>> tops;
  tops.emplace_back(make_distance(scene::Sphere{0.7}), 0.7);
  tops.emplace_back(make_distance(scene::Capsule{1e-3, 1}), 0.501);
  tops.emplace_back(make_distance(scene::SolidBox{{1, 0.6, 1}}), 0.3);
  tops.emplace_back(make_distance(test::needle(1e-3, 0.4, 6), 0), 0.4);
  for (const double speed : {0.3, 30.0})
    for (const auto& [shape, top] : tops) {
      const Triangle3 start{Vector3(-2, top + 0.2, -1), Vector3(-2, top + 0.2, 3), Vector3(3, top + 0.2, 0)};
      const Vector3 move(0, -speed, 0);
      const auto hit =
          shape->first_hit({start, {start[0] + move, start[1] + move, start[2] + move}}, clearance, tolerance);
      ASSERT_TRUE(hit);
      const double gap = 0.2 - hit->s * speed;
      EXPECT_GE(gap, clearance - 1e-12);
      EXPECT_LE(gap, clearance + 2 * tolerance); // the point that hits may be a tolerance aside
      EXPECT_GT(hit->point.near.normal.y(), 0.9);
    }
}

// Random triangles on random ways: up to the hit, or the end, no sample is nearer than the clearance; a hit is near.
TEST(FirstHit, NothingIsNearerBefore) {
  const double clearance = 0.02, tolerance = 0.004;
  for (const NamedShape& shape : all_shapes()) {
    RandomPoints points(1.5);
    int hits = 0, misses = 0;
    while (hits + misses < 80) {
      const Vector3 c = points.next(), move = 2 * points.next();
      const Triangle3 start{c, c + 0.4 * points.next(), c + 0.4 * points.next()};
      const Triangle3 end{start[0] + move, start[1] + move + 0.1 * points.next(),
                          start[2] + move + 0.1 * points.next()};
      if (shape.distance->separation(start, 0.1, 1e-4) < 0.05)
        continue;
      const MovingTriangle moving{start, end};
      const auto hit = shape.distance->first_hit(moving, clearance, tolerance);
      ++(hit ? hits : misses);
      const double last = hit ? hit->s : 1;
      double least = 10;
      for (int k = 0; k <= 50; ++k)
        test::lower_to_least(*shape.distance, moving.at(last * k / 50), 0.004, least);
      EXPECT_GE(least, clearance - 1e-9) << shape.name;
      if (hit) {
        const Near near = shape.distance->nearest(point_of(moving.at(hit->s), hit->point.weights));
        EXPECT_LE(near.distance, clearance + 2 * tolerance) << shape.name;
        EXPECT_NEAR(near.distance, hit->point.near.distance, 1e-9) << shape.name;
        EXPECT_NEAR(near.normal.dot(hit->point.near.normal), 1, 1e-6) << shape.name;
      }
    }
    EXPECT_GT(hits, 3) << shape.name;
    EXPECT_GT(misses, 3) << shape.name;
  }
}

TEST(Separation, AgainstSamples) {
  for (const NamedShape& shape : all_shapes()) {
    RandomPoints points(1.3);
    for (int i = 0; i < 50; ++i) {
      const Vector3 c = points.next();
      const Triangle3 t{c, c + 0.3 * points.next(), c + 0.3 * points.next()};
      double least = 10;
      test::lower_to_least(*shape.distance, t, 0.001, least);
      const double apart = shape.distance->separation(t, 10, 1e-3);
      EXPECT_LE(apart, std::max(0.0, least) + 1e-12) << shape.name;
      EXPECT_GE(apart, least - 0.0021) << shape.name;
      EXPECT_NEAR(shape.distance->deepest(t, 1e-3).near.distance, least, 0.0021) << shape.name;
    }
  }
}

// However near a triangle is to a solid, and however fine the answer must be.
TEST(Searches, TakeNoMoreWhereContactIsNear) {
  constexpr long most = 5000; // evaluations
  for (const double gap : {1e-4, 1e-6, 1e-8, 1e-10})
    for (const auto& [name, moving] : test::slow_searches(gap)) {
      const test::CountedBox box;
      const double apart = box.separation(moving.start, 10, 1e-4 * gap);
      EXPECT_NEAR(apart, gap, 1e-3 * gap + 1e-14) << name;
      EXPECT_LE(box.count(), most) << "separation, " << name << ", gap " << gap;
      const auto hit = box.first_hit(moving, 0.9 * gap, 0.05 * gap);
      EXPECT_LE(box.count(), most) << "first hit, " << name << ", gap " << gap;
      double least = 1;
      for (int k = 0; k <= 20; ++k)
        least = std::min(least, box.separation(moving.at((hit ? hit->s : 1) * k / 20), 10, 1e-2 * gap));
      EXPECT_GE(least, 0.88 * gap - 1e-14) << name;
      (void)box.count();
      (void)box.separation(moving.end, gap, 1e-4 * gap);
      EXPECT_LE(box.count(), most) << "separation at the end, " << name << ", gap " << gap;
      (void)box.deepest(moving.end, 0.05 * gap);
      EXPECT_LE(box.count(), most) << "deepest, " << name << ", gap " << gap;
    }
}

// A crushed triangle of lava on stairs, thrown through the lowest step: advancement came to an instant, and searched
// its rest again and again until the stack was full.
TEST(Searches, EndWhereTheyComeToAnInstant) {
  const auto box = make_distance(scene::SolidBox{{1, 0.9, 4}});
  const MovingTriangle thrown{{Vector3(0x1.cddb0a8a61dc6p-3, 0x1.4c7cf656bfa78p+0, 0x1.7a86ab9ee01ap+1),
                               Vector3(0x1.982740566091ep-3, 0x1.469efe8cca1cdp+0, 0x1.7a62cacb4a985p+1),
                               Vector3(0x1.a5858ec136806p-3, 0x1.4945fd206d6eep+0, 0x1.77deab3ad8ee6p+1)},
                              {Vector3(0x1.4ed76992e7204p-2, 0x1.15e18e5d16638p+0, 0x1.6ca904c8890e1p+1),
                               Vector3(0x1.5313c72590802p-1, 0x1.3333333333332p-3, -0x1.1d73d04d19a9dp+0),
                               Vector3(0x1.13b668da58421p-3, 0x1.ccccccccccccdp-2, -0x1.d2813c38b1b2p-3)}};
  const auto hit = box->first_hit(thrown, 0x1.860aaf661b3c3p-65, 0x1.6c895cd9fd9b7p-42);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.near.distance, 0, 5e-9); // lowest points are found to 1e-9 of the longest side, 5 m
  EXPECT_GE(box->separation(thrown.at(0.99 * hit->s), 10, 1e-6), 0);
}

// The file is read again when nobody has it any more.
TEST(SharedDistance, OfOneFileIsOneAsLongAsSomebodyHasIt) {
  const std::string file = test::own_path("shared.off");
  const auto write = [&](double x) {
    std::ofstream(file) << "OFF\n4 4 0\n0 0 0\n" << x << " 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  };
  const auto width = [](const Solids& solids) { return solids.shape(0).bounds().sizes().x(); };
  write(1);
  Scene scene;
  scene.solids.resize(2);
  for (scene::Solid& solid : scene.solids)
    solid.shape = scene::SolidMesh{file, 1, {}};
  std::optional<Solids> first(scene);
  write(2);
  scene.solids[1].shape = scene::SolidMesh{file, 0.5, {}};
  std::optional<Solids> second(scene);
  EXPECT_EQ(&first->shape(0), &first->shape(1));
  EXPECT_EQ(&first->shape(0), &second->shape(0));
  EXPECT_NE(&first->shape(0), &second->shape(1)); // of another scale
  EXPECT_DOUBLE_EQ(width(*second), 1);
  first.reset();
  second.reset();
  EXPECT_DOUBLE_EQ(width(Solids(scene)), 2);
  std::filesystem::remove(file);
}

} // namespace
} // namespace sheet::solid
