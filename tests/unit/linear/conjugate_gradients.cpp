// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "libsheet/linear/conjugate_gradients.h"

namespace sheet {
namespace {

struct Problem {
  Eigen::MatrixXd a, m; // matrix and inverse preconditioner
  Eigen::VectorXd b;
  [[nodiscard]] ConjugateGradients solve(double forcing, int products) const {
    return conjugate_gradients([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return a * x; },
                               [&](const Eigen::VectorXd& r) -> Eigen::VectorXd { return m * r; }, b, m* b, forcing,
                               products);
  }
};

Problem random_problem(double least) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto entry = [&] { return normal(random); };
  const Eigen::MatrixXd q =
      Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd::NullaryExpr(30, 30, entry)).householderQ();
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(30, 1, 5);
  values[0] = least;
  Problem p;
  p.a = q * values.asDiagonal() * q.transpose();
  p.m = Eigen::VectorXd::LinSpaced(30, 0.5, 1).asDiagonal();
  p.b = Eigen::VectorXd::NullaryExpr(30, entry);
  return p;
}

TEST(ConjugateGradients, LeaveAsLittleAsAskedFor) {
  const Problem p = random_problem(0.5);
  const double before = std::sqrt(p.b.dot(p.m * p.b));
  int products = 0;
  for (const double forcing : {0.1, 1e-3, 1e-9}) {
    const ConjugateGradients cg = p.solve(forcing, 100);
    EXPECT_FALSE(cg.negative);
    EXPECT_GT(cg.products, products);
    products = cg.products;
    EXPECT_LE((p.b - p.a * cg.x - cg.residual).norm(), 1e-12);
    EXPECT_LE(std::sqrt(cg.residual.dot(p.m * cg.residual)), forcing * before);
  }
  EXPECT_EQ(p.solve(1e-9, 3).products, 3);
}

TEST(ConjugateGradients, StopWhereTheCurvatureIsNegativeAndStillDescend) {
  const Problem p = random_problem(-3);
  const ConjugateGradients cg = p.solve(1e-9, 100);
  EXPECT_TRUE(cg.negative);
  EXPECT_GT(cg.x.dot(p.b), 0);
  Problem worst = p;
  worst.a = -Eigen::MatrixXd::Identity(30, 30);
  const ConjugateGradients first = worst.solve(1e-9, 100);
  EXPECT_TRUE(first.negative);
  EXPECT_EQ(first.x, p.m * p.b);
}

} // namespace
} // namespace sheet
