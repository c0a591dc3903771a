// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces lie on other layers, of unit squares at the heights 0, 1, 2, ..., that springs join.
#include "libsheet/scene/inner_faces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

using formats::Frame;

constexpr std::uint32_t corners = 4; // of a square

Frame squares(std::uint32_t count) {
  std::vector<Vector3> x;
  std::vector<Corners> mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t first = corners * i;
    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      x.emplace_back(a, b, i);
    mesh.push_back({first, first + 1, first + 2});
    mesh.push_back({first, first + 2, first + 3});
  }
  return make_frame(x, mesh, std::vector<double>(mesh.size(), 0.5));
}

// Each corner of both on the corner of the other one, which is that of a triangle; normal: from `lower` to `upper`.
void join(std::uint32_t lower, std::uint32_t upper, Frame& frame, const Vector3& normal = Vector3::UnitZ()) {
  std::vector<ContactSpring> springs = read_springs(frame);
  for (std::uint32_t v = 0; v < corners; ++v)
    for (const bool above : {false, true}) {
      const std::uint32_t one = above ? upper : lower, other = above ? lower : upper;
      ContactSpring& s = springs.emplace_back();
      s.vertices = {corners * one + v, corners * other + v, corners * other + (v + 1) % 4,
                    corners * other + (v + 2) % 4};
      s.weights = {1, -1, 0, 0};
      s.normal = above ? normal : Vector3(-normal);
    }
  write_springs(frame, springs);
}

Scene flowing() {
  Scene scene;
  scene.solids.emplace_back().contact = SolidContact::flow;
  scene.model.faces = true;
  return scene;
}

std::vector<double> each(std::initializer_list<double> of_squares) {
  std::vector<double> all;
  for (const double value : of_squares)
    all.insert(all.end(), corners, value);
  return all;
}

TEST(InnerFaces, AreThoseBetweenLayersThatFlow) {
  Frame frame = squares(4);
  EXPECT_TRUE(inner_faces(flowing(), frame).empty());
  join(0, 1, frame);
  join(1, 2, frame);
  EXPECT_EQ(inner_faces(flowing(), frame), each({1, 2, 1, 0}));
  EXPECT_TRUE(inner_faces(Scene(), frame).empty()); // layers that stick to each other, as in the paper
}

TEST(InnerFaces, CountByTheCosineAndAtMostOnce) {
  Frame frame = squares(3);
  join(0, 1, frame, Vector3(std::sin(1), 0, std::cos(1)));
  join(1, 2, frame, Vector3::UnitX()); // edge-on
  for (int again = 0; again < 3; ++again)
    join(0, 1, frame, Vector3(0, 0, 1));
  EXPECT_EQ(inner_faces(flowing(), frame), each({1, 1, 0}));
  Frame oblique = squares(2);
  join(0, 1, oblique, Vector3(0, 0.96, 0.28));
  EXPECT_DOUBLE_EQ(inner_faces(flowing(), oblique)[0], 0.56); // by its own spring and that of the corner on it
}

TEST(InnerFaces, AreNoneBetweenTwoLiquids) {
  Frame frame = squares(3);
  join(0, 1, frame);
  join(1, 2, frame);
  Scene scene = flowing();
  Liquid other;
  other.viscosity = 2;
  scene.sheets.resize(3);
  scene.sheets[2].material = other;
  put_liquid(0, frame);
  const auto liquid = frame.find("liquid")->values<std::uint32_t>();
  liquid[4] = liquid[5] = 1; // the third square
  EXPECT_EQ(inner_faces(scene, frame), each({1, 1, 0}));
}

TEST(InnerFaces, HaveNoRims) {
  Frame frame = squares(3);
  join(0, 1, frame);
  join(1, 2, frame);
  const Scene scene = flowing();
  const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  const FreeFaces faces = free_faces(scene, frame, mesh);
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e)
    EXPECT_EQ(faces.rims[e], mesh.on_rim(e) && mesh.edges[e][0] / corners != 1 ? 1 : 0) << e; // the second is buried
}

} // namespace
} // namespace sheet::scene
