// SPDX-License-Identifier: GPL-3.0-or-later
// The rate of strain of a triangle is that of the velocity gradient in it.
#include "libsheet/material/strain_rate.h"

#include <gtest/gtest.h>

namespace sheet {
namespace {

// Of a triangle in the xy plane that moves by x' = G x.
StrainRate of_triangle(const Matrix3& gradient) {
  const Vector3 x[3] = {{0.3, 0.1, 0}, {1.4, -0.2, 0}, {0.5, 1.1, 0}};
  constexpr double time = 1e-7;
  const auto moved = [&](int i) { return Vector3(x[i] + time * gradient * x[i]); };
  const Vector3 start = squared_lengths(x[0], x[1], x[2]);
  return strain_rate(RaisedMetric(start), squared_lengths(moved(0), moved(1), moved(2)) - start, time);
}

TEST(StrainRate, OfATriangleIsThatOfItsVelocityGradient) {
  Matrix3 gradient = Matrix3::Zero();
  gradient.topLeftCorner<2, 2>() << 2, -1, 3, 0.5;
  const Matrix3 stretching = 0.5 * (gradient + gradient.transpose());
  EXPECT_NEAR(of_triangle(gradient).squared, strain_rate(stretching).squared, 1e-4);
  gradient.topLeftCorner<2, 2>() << 0, -1, 1, 0; // a rotation
  EXPECT_NEAR(of_triangle(gradient).squared, 0, 1e-4);
}

// Drawn out to all sides at a rate e it thins at 2 e: γ̇² = 2 (e² + e² + 4 e²); sheared by s it is s².
TEST(StrainRate, OfStretchingAndShear) {
  Matrix3 drawn = Matrix3::Zero(), sheared = Matrix3::Zero();
  drawn(0, 0) = drawn(1, 1) = 3;
  sheared(0, 1) = sheared(1, 0) = 2.5;
  EXPECT_DOUBLE_EQ(strain_rate(drawn).squared, 12 * 9);
  EXPECT_DOUBLE_EQ(strain_rate(sheared).squared, 25);
}

} // namespace
} // namespace sheet
