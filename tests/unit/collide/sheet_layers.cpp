// SPDX-License-Identifier: GPL-3.0-or-later
// Springs stand between two layers, never within one, however the sheet is bent, shortened or torn.
#include "libsheet/collide/sheet_layers.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "libsheet/collide/contact_springs.h"
#include "libsheet/scene/read.h"
#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

using std::numbers::pi;

constexpr double thick = 0.01; // thickness [m]
constexpr double strip_length = 24 * thick, strip_width = 6 * thick;

Scene syrup() {
  return parse_scene("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n[material]\n"
                     "viscosity = 3\ndensity = 1000\n[environment]\ngravity = [0, -10, 0]\n[contact]\n",
                     "test");
}

// A strip with edges of thick/2 along the curve (x, z)(s).
struct Strip {
  std::vector<Vector3> x;
  std::vector<double> s; // of each vertex along the curve [m]
  Connectivity mesh;
  std::vector<double> reach, area;

  explicit Strip(const std::function<Vector3(double)>& curve, double edge = thick / 2, double thickness = thick) {
    const auto cells = [&](double side) { return static_cast<int>(std::lround(side / edge)); };
    const test::Mesh flat = test::rectangle(strip_length, strip_width, cells(strip_length), cells(strip_width), 0.2);
    for (const Vector3& p : flat.positions) {
      s.push_back(p.x());
      x.push_back(curve(p.x()) + p.y() * Vector3::UnitY());
    }
    mesh = connect(x.size(), flat.triangles);
    reach.assign(x.size(), thickness);
    area.assign(x.size(), edge * edge);
  }
  [[nodiscard]] SpringSheet sheet() const {
    return {x, x, reach, reach, area, std::vector<Axes>(x.size(), 0), 0.01, {}};
  }
  [[nodiscard]] std::vector<ContactSpring> springs() const {
    std::vector<ContactSpring> list;
    SelfSearch search(mesh);
    add_springs(list, search, syrup(), sheet());
    return list;
  }
  // Between the two features of a spring, along the curve.
  [[nodiscard]] double along(const ContactSpring& spring) const {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      sum += spring.weights[i] * s[spring.vertices[i]];
    return std::abs(sum);
  }
  void shake(double by) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-by, by);
    for (Vector3& p : x)
      p.z() += uniform(random);
  }
};

// Two straight legs and a bend of an angle between them, in the middle of the strip.
std::function<Vector3(double)> bend(double radius, double angle) {
  return [=](double s) -> Vector3 {
    const double half = radius * angle / 2, from = s - strip_length / 2, turn = std::clamp(from, -half, half) / radius;
    const Vector3 on_arc(radius * std::sin(turn), 0, radius * (1 - std::cos(turn)));
    return on_arc + (from - turn * radius) * Vector3(std::cos(turn), 0, std::sin(turn));
  };
}

TEST(SheetLayers, OneThatBendsHasNoSprings) {
  for (const double edge : {thick / 2, thick / 4})
    for (const double angle : {0.0, pi / 2, pi})
      for (const double radius : {2 * thick, thick, 0.6 * thick})
        EXPECT_TRUE(Strip(bend(radius, angle), edge).springs().empty()) << edge << ", " << angle << ", " << radius;
}

TEST(SheetLayers, OneThatIsRuffledOrShortenedInItsPlaneHasNoSprings) {
  for (const double shorter : {1.0, 0.7, 0.5})
    for (const double shake : {0.05 * thick, 0.1 * thick}) {
      Strip strip([&](double s) { return Vector3(shorter * s, 0, 0); });
      strip.shake(shake);
      EXPECT_TRUE(strip.springs().empty()) << shorter << ", " << shake;
    }
}

// A hairpin of the radius thick/2 whose legs are within 1.02 thick of each other.
TEST(SheetLayers, LegsOfAFoldHaveSpringsFromWhereTheyLeaveTheBend) {
  const Strip fold(bend(thick / 2, pi), thick / 2, 1.02 * thick);
  const std::vector<ContactSpring> springs = fold.springs();
  std::vector<int> of_vertex(fold.x.size(), 0);
  for (const ContactSpring& s : springs) {
    EXPECT_GT(fold.along(s), 0.95 * pi / 2 * thick);
    EXPECT_GT(std::abs(s.anchor.x()), 0.8 * thick); // from leg to leg
    for (const std::uint32_t v : s.vertices)
      ++of_vertex[v];
  }
  for (std::size_t v = 0; v < fold.x.size(); ++v)
    if (std::abs(fold.s[v] - strip_length / 2) > pi / 4 * thick + thick / 2) {
      EXPECT_GT(of_vertex[v], 0) << fold.s[v] / thick;
    }
}

TEST(SheetLayers, PiecesOfWhatWasTornAreTwo) {
  Strip torn(bend(thick / 2, pi), thick / 2, 1.02 * thick);
  std::vector<Corners> left;
  for (const Corners& t : torn.mesh.triangles)
    if (std::ranges::none_of(t, [&](std::uint32_t v) { return std::abs(torn.s[v] - strip_length / 2) < 0.3 * thick; }))
      left.push_back(t);
  const std::size_t whole = torn.springs().size();
  torn.mesh = connect(torn.x.size(), left);
  EXPECT_GT(torn.springs().size(), whole);
  const DistanceAlong along(torn.mesh);
  const std::array first{left.front()[0]}, last{left.back()[0]};
  EXPECT_FALSE(along.within(torn.x, {first, torn.x[first[0]]}, {last, torn.x[last[0]]}, 1e3));
}

// Between vertex v of a flat strip and a triangle that is about as far along it as `far`.
ContactSpring within_layer(const Strip& strip, double far) {
  const std::uint32_t v = strip.mesh.triangles[strip.mesh.triangles.size() / 2][0];
  ContactSpring spring;
  double best = 1;
  for (const Corners& t : strip.mesh.triangles) {
    const Vector3 middle = (strip.x[t[0]] + strip.x[t[1]] + strip.x[t[2]]) / 3;
    if (const double miss = std::abs((middle - strip.x[v]).norm() - far); miss < best) {
      best = miss;
      spring.vertices = {v, t[0], t[1], t[2]};
      spring.weights = {1, -1.0 / 3, -1.0 / 3, -1.0 / 3};
      spring.stiffness = {7, 7};
    }
  }
  return spring;
}

TEST(SheetLayers, SpringsWithinOneGo) {
  const Strip strip([](double s) { return Vector3(s, 0, 0); });
  const SheetLayers layers(strip.mesh);
  std::vector<ContactSpring> springs = {within_layer(strip, 0.6 * thick), within_layer(strip, 0.9 * thick)};
  drop_within_layers(springs, layers, strip.sheet());
  EXPECT_TRUE(springs.empty());
}

// Those between the legs stay, until the layer is thicker than what lies between their features is long.
TEST(SheetLayers, SpringsOfAFoldStayWhileThereAreTwo) {
  Strip fold(bend(thick / 2, pi), thick / 2, 1.02 * thick);
  const SheetLayers layers(fold.mesh);
  const std::vector<ContactSpring> made = fold.springs();
  std::vector<ContactSpring> springs = made;
  fold.reach.assign(fold.reach.size(), 1.4 * thick);
  drop_within_layers(springs, layers, fold.sheet());
  EXPECT_EQ(springs.size(), made.size());
  fold.reach.assign(fold.reach.size(), 4 * thick);
  drop_within_layers(springs, layers, fold.sheet());
  EXPECT_LT(springs.size(), made.size());
  EXPECT_GT(springs.size(), made.size() / 2);
  for (const ContactSpring& s : springs)
    EXPECT_GT(fold.along(s), 0.9 * pi / 3 * 4 * thick);
}

} // namespace
} // namespace sheet::collide
