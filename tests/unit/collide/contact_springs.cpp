// SPDX-License-Identifier: GPL-3.0-or-later
// Which near pairs get a spring, how stiff, how it goes with the sheet, when it parts.
#include "libsheet/collide/contact_springs.h"

#include <gtest/gtest.h>

#include "libsheet/collide/loose_springs.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"
#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

// Two layers of the same mesh, the upper one shifted, at distance 0.01 m.
struct Layers {
  std::vector<Vector3> start, end;
  std::vector<double> reach, thickness, area, mass;
  std::vector<Axes> fixed;
  Connectivity mesh;
  double step = 0.01;

  Layers() {
    std::vector<Corners> triangles;
    const test::Mesh one = test::rectangle(1, 1, 5, 5, 0.2);
    const auto n = static_cast<std::uint32_t>(one.positions.size());
    for (std::uint32_t layer = 0; layer < 2; ++layer) {
      for (const Corners& t : one.triangles)
        triangles.push_back({t[0] + n * layer, t[1] + n * layer, t[2] + n * layer});
      for (const Vector3& x : one.positions)
        start.push_back(x + Vector3(0.03, 0.02, 0.01) * layer);
    }
    end = start;
    reach.assign(start.size(), 0.02);
    thickness.assign(start.size(), 0.015);
    area.assign(start.size(), 0.04);
    mass.assign(start.size(), 2);
    fixed.assign(start.size(), 0);
    mesh = connect(start.size(), triangles);
  }
  [[nodiscard]] SpringSheet sheet() const { return {start, end, reach, thickness, area, fixed, step}; }
  [[nodiscard]] std::vector<ContactSpring> springs(const Scene& scene) const {
    std::vector<ContactSpring> list;
    SelfSearch search(mesh);
    add_springs(list, search, scene, sheet());
    return list;
  }
  void move(const Eigen::Isometry3d& motion) {
    for (std::size_t v = 0; v < end.size(); ++v)
      end[v] = motion * start[v];
  }
};

Vector3 offset(const ContactSpring& s, const std::vector<Vector3>& x) {
  Vector3 c = Vector3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    c += s.weights[i] * x[s.vertices[i]];
  return c;
}

Scene scene_with(const std::string& contact) {
  return parse_scene(
      "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n[material]\nviscosity = 3\n"
      "density = 1000\n[environment]\ngravity = [0, -10, 0]\n[contact]\n" +
          contact,
      "test");
}

TEST(ContactSprings, NewOnesAreAtRest) {
  const Layers layers;
  const auto springs = layers.springs(scene_with(""));
  std::vector<int> of_vertex(layers.start.size(), 0);
  for (const ContactSpring& s : springs) {
    EXPECT_NEAR(s.rest, 0.01, 1e-15);
    EXPECT_NEAR(std::abs(s.normal.z()), 1, 1e-12);
    EXPECT_NEAR(s.normal.dot(offset(s, layers.end)), s.rest, 1e-15);
    EXPECT_LT((s.anchor - offset(s, layers.end)).norm(), 1e-15);
    EXPECT_NEAR(s.weights[0] + s.weights[1] + s.weights[2] + s.weights[3], 0, 1e-15);
    if (s.weights[0] == 1)
      ++of_vertex[s.vertices[0]];
  }
  // each vertex over the inside of the other layer stands on one triangle, also where it is over an edge of two
  for (std::size_t v = 0; v < of_vertex.size(); ++v)
    EXPECT_LE(of_vertex[v], 1);
  EXPECT_GE(std::count(of_vertex.begin(), of_vertex.end(), 1), 50);
  // nothing is added where all is in contact
  std::vector<ContactSpring> again = springs;
  SelfSearch search(layers.mesh);
  add_springs(again, search, scene_with(""), layers.sheet());
  EXPECT_EQ(again.size(), springs.size());
}

TEST(ContactSprings, StiffnessIsThatOfTheFormula) {
  const Layers layers;
  // A = 0.02, h = 0.015, d = 0.02, T = sqrt(d / 10) / 10: inertia 0.3 / T², weight 200 * 0.3 * 10 / 0.02, viscosity
  // 3 * 0.015 / (2 T)
  const double time = 0.1 * std::sqrt(0.02 / 10);
  for (const ContactSpring& s : layers.springs(scene_with("")))
    EXPECT_NEAR(s.stiffness[0], 0.3 / (time * time) + 30000 + 0.5 * 3 * 0.015 / time, 1e-9);
  // the same in a step of any length; stiffer for layers that came 0.04 m closer in 0.01 s: T = 0.02 / 4 / 10
  Layers shorter = layers;
  shorter.step = 1e-6;
  EXPECT_EQ(shorter.springs(scene_with(""))[0].stiffness, layers.springs(scene_with(""))[0].stiffness);
  // without gravity the speed of approach counts: 0.04 m in 0.01 s, so T = 0.02 / 4 / 10
  Layers coming = layers;
  for (std::size_t v = coming.start.size() / 2; v < coming.start.size(); ++v)
    coming.start[v].z() += 0.04;
  Scene afloat = scene_with("");
  afloat.environment.gravity.reset();
  EXPECT_EQ(coming.springs(scene_with(""))[0].stiffness, layers.springs(scene_with(""))[0].stiffness);
  for (const ContactSpring& s : coming.springs(afloat))
    EXPECT_NEAR(s.stiffness[0], 0.3 / 0.25e-6 + 0.5 * 3 * 0.015 / 5e-4, 1e-6);
  for (const ContactSpring& s : layers.springs(scene_with("stiffness = 7")))
    EXPECT_EQ(s.stiffness, (std::array<double, 2>{7, 7}));
}

// Two dashpots one behind the other: a layer does not bounce on one of a stiffer liquid.
TEST(ContactSprings, OfTwoLiquidsAreSoftAsTheSofterOne) {
  const Layers layers;
  const Scene scene = scene_with("");
  std::vector<Liquid> liquids(2, scene.material);
  liquids[1].viscosity = 3000;
  std::vector<std::uint32_t> numbers(layers.start.size(), 0);
  std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2), numbers.end(), 1);
  SpringSheet sheet = layers.sheet();
  sheet.liquid = numbers;
  sheet.liquids = liquids;
  std::vector<ContactSpring> springs;
  SelfSearch search(layers.mesh);
  add_springs(springs, search, scene, sheet);
  ASSERT_FALSE(springs.empty());
  const double time = 0.1 * std::sqrt(0.02 / 10), viscosity = 2 / (1.0 / 3 + 1.0 / 3000);
  for (const ContactSpring& s : springs)
    EXPECT_NEAR(s.stiffness[0], 0.3 / (time * time) + 30000 + 0.5 * viscosity * 0.015 / time, 1e-9);
}

TEST(ContactSprings, FixedVerticesAloneGetNone) {
  Layers layers;
  layers.fixed.assign(layers.fixed.size(), all_axes);
  EXPECT_TRUE(layers.springs(scene_with("")).empty());
  layers.fixed[40] = 0;
  EXPECT_FALSE(layers.springs(scene_with("")).empty());
}

TEST(ContactSprings, RigidMotionCostsNothing) {
  Layers layers;
  auto springs = layers.springs(scene_with(""));
  const std::size_t count = springs.size();
  layers.move(Eigen::Translation3d(3, 2, 1) * Eigen::AngleAxisd(0.8, Vector3(1, 2, 0).normalized()));
  (void)follow(springs, scene_with(""), layers.sheet(), layers.end);
  EXPECT_EQ(springs.size(), count);
  for (const ContactSpring& s : springs) {
    EXPECT_NEAR(s.normal.dot(offset(s, layers.end)), s.rest, 1e-14);
    EXPECT_LT((s.anchor - offset(s, layers.end)).norm(), 1e-14);
  }
}

TEST(ContactSprings, PartAtTheAdhesion) {
  Layers layers;
  for (std::size_t v = layers.end.size() / 2; v < layers.end.size(); ++v)
    layers.end[v].z() += 0.001; // tension: 7 N/m * 0.001 m / 0.02 m² = 0.35 Pa
  for (const auto& [contact, stays] : std::vector<std::pair<std::string, bool>>{
           {"", true}, {"\nadhesion = 0.36", true}, {"\nadhesion = 0.34", false}, {"\nadhesion = 0", false}}) {
    const Scene scene = scene_with("stiffness = 7" + contact);
    Layers before;
    auto springs = before.springs(scene);
    std::erase_if(springs, [](const ContactSpring& s) { return s.weights[0] != 1; });
    (void)follow(springs, scene, layers.sheet(), layers.end);
    EXPECT_EQ(!springs.empty(), stays) << contact;
  }
}

double energy(const std::vector<ContactSpring>& springs, const std::vector<Vector3>& x) {
  double sum = 0;
  for (const ContactSpring& s : springs) {
    const double gap = s.normal.dot(offset(s, x)) - s.rest;
    const Vector3 slide = offset(s, x) - s.anchor;
    sum += (s.stiffness[0] * gap * gap + s.stiffness[1] * (slide - s.normal.dot(slide) * s.normal).squaredNorm()) / 2;
  }
  return sum;
}

// The upper layer comes down by 1 mm in the step; what is done about contacts moves it by 2 to 4 mm besides.
TEST(ContactSprings, GetNoMoreEnergyOfCorrectionsThanContactsTook) {
  Layers layers;
  const Scene scene = scene_with("stiffness = 7");
  const auto springs = layers.springs(scene);
  for (std::size_t v = layers.end.size() / 2; v < layers.end.size(); ++v)
    layers.end[v].z() -= 0.001;
  const std::vector<Vector3> without = layers.end;
  for (std::size_t v = layers.end.size() / 2; v < layers.end.size(); ++v)
    layers.end[v] += Vector3(0.002, -0.004, v % 2 == 0 ? 0.003 : -0.003);
  const auto followed = [&](const std::vector<Vector3>& ends, double taken) {
    auto result = springs;
    const std::vector<double> had = follow(result, scene, layers.sheet(), ends);
    ease_strained(result, had, taken, scene, layers.end);
    return result;
  };
  const double plain = energy(followed(layers.end, 0), layers.end);
  Layers free = layers;
  free.end = without;
  auto of_step = springs;
  (void)follow(of_step, scene, free.sheet(), without);
  const double before = energy(of_step, without);
  ASSERT_GT(plain, 3 * before);
  for (const double part : {0.0, 0.5, 2.0}) { // of what corrections would give
    const double after = energy(followed(without, part * (plain - before)), layers.end);
    EXPECT_NEAR(after, before + std::min(part, 1.0) * (plain - before), 1e-9 * plain) << part;
  }
}

TEST(ContactSprings, DoNotBounceAndKeepMomentum) {
  const Layers layers;
  const Scene scene = scene_with("");
  const auto springs = layers.springs(scene);
  std::vector<Vector3> velocity(layers.start.size(), Vector3(0.5, 0, 0));
  for (std::size_t v = velocity.size() / 2; v < velocity.size(); ++v)
    velocity[v] = Vector3(0, 0, -1);
  const auto rate = [&] {
    double most = 0;
    for (const ContactSpring& s : springs) {
      double r = 0;
      for (std::size_t i = 0; i < 4; ++i)
        r += s.weights[i] * s.normal.dot(velocity[s.vertices[i]]);
      most = std::max(most, std::abs(r));
    }
    return most;
  };
  const auto momentum = [&] {
    Vector3 sum = Vector3::Zero();
    for (std::size_t v = 0; v < velocity.size(); ++v)
      sum += layers.mass[v] * velocity[v];
    return sum;
  };
  const Vector3 before = momentum();
  EXPECT_NEAR(rate(), 1, 1e-9);
  level_velocities(springs, scene, layers.mass, layers.fixed, velocity);
  EXPECT_LT(rate(), 0.05);
  EXPECT_LT((momentum() - before).norm(), 1e-12);
  // what moves apart does so freely where nothing sticks
  for (std::size_t v = velocity.size() / 2; v < velocity.size(); ++v)
    velocity[v] = Vector3(0, 0, 1);
  const std::vector<Vector3> apart = velocity;
  level_velocities(springs, scene_with("adhesion = 0"), layers.mass, layers.fixed, velocity);
  EXPECT_EQ(velocity, apart);
}

// A contact whose one free vertex has a thousandth of it would have to throw that vertex to take the rate of the
// others.
TEST(ContactSprings, LevelledVelocitiesThrowNoVertex) {
  ContactSpring spring;
  spring.vertices = {0, 1, 2, 3};
  spring.weights = {1, -0.001, -0.5, -0.499};
  spring.normal = Vector3::UnitZ();
  const std::vector<double> mass(4, 2);
  const std::vector<Axes> fixed = {all_axes, 0, all_axes, all_axes};
  std::vector<Vector3> velocity = {{0, 0, -1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  level_velocities(std::vector{spring}, scene_with(""), mass, fixed, velocity);
  EXPECT_LT(velocity[1].norm(), 4 * 2);
}

// A triangle's diagonal is flipped under a vertex that presses on it: the spring that takes the place of the old one
// carries the same force, normal and tangential.
TEST(LooseSprings, ForcesAreHandedOver) {
  const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.4, 0.01}, {0.5, 2, 1}, {1, 2, 1}};
  const auto mesh_with = [](Corners a, Corners b) { return connect(7, std::vector<Corners>{a, b, Corners{4, 6, 5}}); };
  const Connectivity before = mesh_with({0, 1, 2}, {0, 2, 3}), after = mesh_with({0, 1, 3}, {1, 2, 3});
  ContactSpring old;
  old.vertices = {4, 0, 2, 3};
  old.weights = {1, -0.6, -0.3, -0.1};
  old.normal = Vector3::UnitZ();
  old.rest = 0.013;
  old.anchor = Vector3(-0.001, 0.002, 0.013);
  old.stiffness = {5, 3};
  std::vector<ContactSpring> springs = {old};
  EXPECT_TRUE(take_loose(springs, before, x).without_features.empty());
  const std::vector<ContactSpring> loose = take_loose(springs, after, x).without_features;
  ASSERT_EQ(loose.size(), 1u);
  EXPECT_TRUE(springs.empty());
  ContactSpring made;
  made.vertices = {4, 0, 1, 3};
  made.weights = {1, -0.3, -0.3, -0.4};
  made.normal = Vector3::UnitZ();
  made.rest = 0.01;
  made.anchor = Vector3(0, 0, 0.01);
  made.stiffness = {10, 10};
  ContactSpring other = made; // as stiff, so it takes half; from the other side
  other.vertices = {4, 1, 0, 3};
  other.weights = {-1, 0.3, 0.3, 0.4};
  other.normal = -made.normal;
  other.anchor = -made.anchor;
  ContactSpring far = made;
  far.vertices = {4, 5, 6, 1};
  springs = {made, other, far};
  hand_over(loose, x, springs);
  const auto force = [&](const ContactSpring& s) { // on vertex 4
    Vector3 c = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      c += s.weights[i] * x[s.vertices[i]];
    const Vector3 slide = c - s.anchor;
    return Vector3(-s.weights[0] * (s.stiffness[0] * (s.normal.dot(c) - s.rest) * s.normal +
                                    s.stiffness[1] * (slide - s.normal.dot(slide) * s.normal)));
  };
  EXPECT_GT(force(old).norm(), 0.01);
  EXPECT_LT((force(springs[0]) + force(springs[1]) - force(old)).norm(), 1e-15);
  EXPECT_LT((force(springs[0]) - force(springs[1])).norm(), 1e-15);
  EXPECT_EQ(springs[2].rest, far.rest);
}

// A soft spring that takes over the force of a stiff one stores more than that had.
TEST(LooseSprings, WhatHasSlidAsideGivesNoMoreEnergyThanItHad) {
  const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}};
  ContactSpring old;
  old.vertices = {3, 0, 1, 2};
  old.weights = {1, -0.4, -0.3, -0.3};
  old.rest = 0.013;
  old.anchor = Vector3(-0.001, 0.002, 0.013);
  old.stiffness = {5, 3};
  ContactSpring soft = old;
  soft.anchor = contact_offset(soft.vertices, soft.weights, x);
  soft.rest = soft.anchor.z();
  soft.stiffness = {0.5, 0.3};
  const Scene scene = scene_with("");
  const double given = energy_of(std::vector{old}, scene, x);
  std::vector<ContactSpring> springs = {soft};
  hand_over(std::vector{old}, x, springs);
  EXPECT_NEAR(energy_of(springs, scene, x), 10 * given, 1e-9 * given);
  ease_strained(springs, {}, given, scene, x);
  EXPECT_NEAR(energy_of(springs, scene, x), given, 1e-9 * given);
}

// What has slid off by more than 60 degrees is loose, too.
TEST(LooseSprings, FeaturesNoLongerOverEachOther) {
  std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}, {5, 5, 5}, {5, 6, 5}};
  const Connectivity mesh = connect(6, std::vector<Corners>{{0, 1, 2}, {3, 4, 5}});
  ContactSpring s;
  s.vertices = {3, 0, 1, 2};
  s.weights = {1, -0.4, -0.3, -0.3};
  s.normal = Vector3::UnitZ();
  for (const auto& [slid, loose] : std::vector<std::pair<double, std::size_t>>{{0.017, 0}, {0.018, 1}}) {
    x[3].x() = 0.3 + slid;
    std::vector<ContactSpring> springs = {s};
    EXPECT_EQ(take_loose(springs, mesh, x).aside.size(), loose);
  }
}

// The diagonal under a weld is flipped: it holds on to the triangle that is now below, and pulls as it did.
TEST(LooseSprings, WeldsTakeWhatIsBelowNow) {
  const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.4, 0.01}, {0.5, 2, 1}, {1, 2, 1}};
  const Connectivity after = connect(7, std::vector<Corners>{{0, 1, 3}, {1, 2, 3}, {4, 6, 5}});
  ContactSpring weld;
  weld.vertices = {4, 0, 2, 3};
  weld.weights = {1, -0.6, -0.3, -0.1};
  weld.rest = 0.013;
  weld.anchor = Vector3(-0.001, 0.002, 0.013);
  weld.stiffness = {5, 3};
  weld.since = ContactSpring::always;
  std::vector<ContactSpring> springs = {weld};
  weld_anew(springs, after, x);
  EXPECT_EQ(springs[0].vertices, (std::array<std::uint32_t, 4>{4, 0, 1, 3}));
  const Vector3 old = weld.offset(x), now = springs[0].offset(x);
  EXPECT_NEAR(springs[0].gap(now), weld.gap(old), 1e-15);
  EXPECT_LT((springs[0].slide(now) - weld.slide(old)).norm(), 1e-15);
  EXPECT_TRUE(take_loose(springs, after, x).without_features.empty());
  weld.since = 0;
  springs = {weld};
  weld_anew(springs, after, x);
  EXPECT_EQ(springs[0].vertices, weld.vertices);
}

// What has parted keeps its weld, and pulls, where other springs only push.
TEST(ContactSprings, WeldsNeverPart) {
  Layers layers;
  const Scene scene = scene_with("adhesion = 0");
  std::vector<ContactSpring> springs = layers.springs(scene);
  const std::size_t all = springs.size();
  springs[0].since = ContactSpring::always;
  layers.move(Eigen::Isometry3d::Identity());
  for (std::size_t v = layers.end.size() / 2; v < layers.end.size(); ++v)
    layers.end[v].z() += 0.05;
  (void)follow(springs, scene, layers.sheet(), layers.end);
  EXPECT_GT(all, 1u);
  ASSERT_EQ(springs.size(), 1u);
  EXPECT_TRUE(springs[0].welded());
  EXPECT_GT(energy_of(springs, scene, layers.end), 0);
}

// Where layers merge, contacts have dates: new ones that of now, and what takes a force over that of the older one.
TEST(ContactSprings, HaveDatesWhereLayersMerge) {
  const Layers layers;
  std::vector<ContactSpring> springs = layers.springs(scene_with(""));
  date(springs, scene_with(""), 3);
  EXPECT_EQ(springs[0].since, ContactSpring::undated);
  springs[1].since = 2;
  date(springs, scene_with("[merge]\nafter = 1"), 3);
  EXPECT_EQ(springs[0].since, 3);
  EXPECT_EQ(springs[1].since, 2);
  ContactSpring older = springs[0];
  older.since = 1;
  hand_over(std::vector{older}, layers.end, springs);
  EXPECT_EQ(springs[0].since, 1);
  EXPECT_EQ(springs[1].since, 2);
}

TEST(ContactArrays, RoundTrip) {
  const Layers layers;
  const auto springs = layers.springs(scene_with(""));
  const std::vector<double> volumes(layers.mesh.triangles.size(), 1e-3);
  formats::Frame frame = make_frame(layers.start, layers.mesh.triangles, volumes);
  write_springs(frame, springs);
  EXPECT_EQ(formats::find_value_error(frame), "");
  const auto read = read_springs(frame);
  ASSERT_EQ(read.size(), springs.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].vertices, springs[i].vertices);
    EXPECT_EQ(read[i].weights, springs[i].weights);
    EXPECT_EQ(read[i].normal, springs[i].normal);
    EXPECT_EQ(read[i].rest, springs[i].rest);
    EXPECT_EQ(read[i].anchor, springs[i].anchor);
    EXPECT_EQ(read[i].stiffness, springs[i].stiffness);
  }
  EXPECT_EQ(frame.find("contact_since"), nullptr);
  std::vector<ContactSpring> dated = springs;
  for (std::size_t i = 0; i < dated.size(); ++i)
    dated[i].since = i == 0 ? ContactSpring::always : static_cast<double>(i);
  write_springs(frame, dated);
  EXPECT_EQ(formats::find_value_error(frame), "");
  EXPECT_TRUE(read_springs(frame)[0].welded());
  EXPECT_EQ(read_springs(frame)[1].since, 1);
  write_springs(frame, {});
  EXPECT_EQ(frame.find("contact_since"), nullptr);
  EXPECT_EQ(frame.find("contact_vertex"), nullptr);
  EXPECT_TRUE(read_springs(frame).empty());
}

} // namespace
} // namespace sheet::collide
