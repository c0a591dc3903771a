// SPDX-License-Identifier: GPL-3.0-or-later
// The feet of contact springs slide with the layers, and leave them at their rims.
#include "libsheet/collide/spring_feet.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

constexpr double apart = 0.01; // [m]

// A square of 1 m and a small triangle above its middle, with a spring from each corner to where it is.
struct Above {
  test::Mesh mesh = test::rectangle(1, 1, 10, 10, 0.2);
  std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
  Connectivity connectivity;
  std::vector<ContactSpring> springs;
  std::vector<double> had;

  Above() {
    for (const Vector3& corner : {Vector3(0.5, 0.5, apart), Vector3(0.54, 0.5, apart), Vector3(0.5, 0.54, apart)})
      mesh.positions.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    connectivity = connect(mesh.positions.size(), mesh.triangles);
    for (std::uint32_t corner = first; corner < first + 3; ++corner)
      springs.push_back(spring(corner));
    had.assign(springs.size(), 1);
  }

  // To the triangle below a vertex, softer than at rest by a tenth.
  [[nodiscard]] ContactSpring spring(std::uint32_t vertex) const {
    for (const Corners& c : mesh.triangles)
      if (const auto at = over_triangle({at_place(vertex), at_place(c[0]), at_place(c[1]), at_place(c[2])});
          at && c[0] < first)
        return {{vertex, c[0], c[1], c[2]}, at->weights, Vector3::UnitZ(), 1.1 * apart, at->offset, {3, 0}, 0};
    throw std::logic_error("nothing below");
  }
  [[nodiscard]] const Vector3& at_place(std::uint32_t v) const { return mesh.positions[v]; }
  void move(const Vector3& way) {
    for (std::uint32_t corner = first; corner < first + 3; ++corner)
      mesh.positions[corner] += way;
  }
  std::vector<ContactSpring> slide() { return let_feet_slide(springs, had, connectivity, mesh.positions); }
};

TEST(SpringFeet, SlideFromTriangleToTriangle) {
  Above above;
  above.move({0.23, -0.11, 0});
  EXPECT_TRUE(above.slide().empty());
  ASSERT_EQ(above.springs.size(), 3U);
  for (const ContactSpring& s : above.springs) {
    const ContactSpring below = above.spring(s.vertices[0]);
    EXPECT_LT((s.offset(above.mesh.positions) - apart * Vector3::UnitZ()).norm(), 1e-12);
    EXPECT_LT((s.normal - Vector3::UnitZ()).norm(), 1e-12);
    EXPECT_EQ(std::set(s.vertices.begin(), s.vertices.end()), std::set(below.vertices.begin(), below.vertices.end()));
    EXPECT_EQ(s.rest, 1.1 * apart);
    EXPECT_EQ(s.stiffness[0], 3);
  }
}

TEST(SpringFeet, LeaveTheLayerAtItsRim) {
  Above above;
  const std::vector<ContactSpring> before = above.springs;
  above.move({0.4598, 0, 0}); // one corner is a fiftieth of the distance over the rim, one right above it
  EXPECT_TRUE(above.slide().empty());
  above.move({0.007, 0, 0}); // that one beside it by more than half of the distance, the others over the square
  const std::vector<ContactSpring> left = above.slide();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].vertices[0], above.first + 1);
  EXPECT_EQ(above.springs.size(), 2U);
  EXPECT_EQ(above.had.size(), 2U);
}

TEST(SpringFeet, WeldsAndWhatHoldsSidewaysStay) {
  Above above;
  above.springs[0].since = ContactSpring::always;
  above.springs[1].stiffness[1] = 1;
  const auto before = above.springs;
  above.move({0.23, -0.11, 0});
  EXPECT_TRUE(above.slide().empty());
  for (const int i : {0, 1})
    EXPECT_EQ(above.springs[i].weights, before[i].weights);
  EXPECT_NE(above.springs[2].weights, before[2].weights);
}

// Two springs of a vertex that come to one triangle are one.
TEST(SpringFeet, OneOnATriangle) {
  Above above;
  above.springs.push_back(above.springs[0]);
  above.had.push_back(2);
  const std::vector<ContactSpring> left = above.slide();
  EXPECT_EQ(left.size(), 1U);
  EXPECT_EQ(above.springs.size(), 3U);
  EXPECT_EQ(above.had, std::vector<double>(3, 1));
}

} // namespace
} // namespace sheet::collide
