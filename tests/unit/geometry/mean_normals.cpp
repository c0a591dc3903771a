// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/geometry/mean_normals.h"

namespace sheet {
namespace {

// Two triangles at the edge from 0 to 1, the second turned up by an angle about it.
struct Hinge {
  Connectivity mesh = connect(4, std::vector<Corners>{{0, 1, 2}, {1, 0, 3}});
  std::vector<Vector3> x;
  explicit Hinge(double angle) : x{{0, 0, 0}, {1, 0, 0}, {0.4, 1, 0}, {0.6, -std::cos(angle), std::sin(angle)}} {}
};

TEST(MeanNormals, StandBetweenTheTriangles) {
  for (const double angle : {0.0, 0.5, -2.0}) {
    const Hinge hinge(angle);
    const EdgeFrame frame = mean_normal_frames(hinge.mesh, hinge.x)[0];
    EXPECT_LE((frame.tangent - Vector3::UnitX()).norm(), 1e-15);
    EXPECT_LE((frame.director - Vector3(0, std::sin(angle / 2), std::cos(angle / 2))).norm(), 1e-15) << angle;
    EXPECT_LE((frame.binormal - frame.tangent.cross(frame.director)).norm(), 1e-15);
  }
}

TEST(MeanNormals, OfAFlatFoldAreTheLimit) {
  const Hinge hinge(std::numbers::pi);
  const EdgeFrame frame = mean_normal_frames(hinge.mesh, hinge.x)[0];
  EXPECT_LE((frame.director - mean_normal_frames(hinge.mesh, Hinge(std::numbers::pi - 1e-6).x)[0].director).norm(),
            1e-6);
}

TEST(MeanNormals, DirectorsAreTurnedByTheirAngles) {
  const Hinge hinge(0.7);
  const std::vector<double> angles{0.3, -1.2, 0, 3, -0.01};
  const auto means = mean_normal_frames(hinge.mesh, hinge.x), turned = director_frames(hinge.mesh, hinge.x, angles);
  for (std::size_t e = 0; e < angles.size(); ++e) {
    EXPECT_NEAR(means[e].angle_to(turned[e].director), angles[e], 1e-15);
    EXPECT_NEAR(turned[e].director.dot(turned[e].tangent), 0, 1e-15);
    EXPECT_NEAR(turned[e].director.norm(), 1, 1e-15);
  }
  EXPECT_EQ(director_frames(hinge.mesh, hinge.x, {})[1].director, means[1].director);
}

} // namespace
} // namespace sheet
