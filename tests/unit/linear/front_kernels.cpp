// SPDX-License-Identifier: GPL-3.0-or-later
// Every version of the kernels that this processor can run, against dense matrices.
#include "libsheet/linear/front_kernels.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "libsheet/linear/kept_buffer.h"

using namespace sheet;

namespace {

constexpr std::pair<int, int> shapes[] = {{1, 1},   {5, 5},   {3, 20},  {8, 30},  {16, 16},  {16, 50},
                                          {17, 40}, {23, 31}, {40, 40}, {64, 99}, {100, 165}};

template <class Real> class FrontKernelsTest : public testing::Test {
public:
  static constexpr int S = strip_rows<Real>;
  static constexpr double bound = sizeof(Real) == 4 ? 3e-5 : 1e-13;

  // A random front and its elimination, dense and by the kernels.
  void eliminate(const FrontKernels<Real>& kernels, int pivots, int rows) {
    shape = {pivots, rows};
    std::mt19937 random(static_cast<unsigned>(1000 * pivots + rows));
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::MatrixXd a(rows, pivots);
    for (double& v : a.reshaped())
      v = uniform(random);
    a.topRows(pivots) = (a.topRows(pivots) + a.topRows(pivots).transpose()).eval();
    a.diagonal().array() += 2.0 * pivots;
    const Eigen::MatrixXd top = a.topRows(pivots).llt().matrixL();
    factor.resize(rows, pivots);
    factor.topRows(pivots) = top;
    if (rows > pivots) {
      const Eigen::MatrixXd right = a.bottomRows(rows - pivots).transpose();
      factor.bottomRows(rows - pivots) = top.triangularView<Eigen::Lower>().solve(right).transpose();
    }
    panel.reserve(static_cast<std::size_t>(shape.panel_size()));
    std::fill_n(panel.data(), shape.panel_size(), Real(0));
    for (int k = 0; k < pivots; ++k)
      for (int r = k; r < rows; ++r)
        in_panel(shape, panel.data(), r, k) = static_cast<Real>(a(r, k));
    const int below = (pivots + S - 1) / S;
    for (int t = 0; t < below; ++t)
      ASSERT_TRUE(kernels.eliminate(shape, panel.data(), 0, pivots, t, 1));
    for (int t = below; t < shape.strips(); t += 2)
      ASSERT_TRUE(kernels.eliminate(shape, panel.data(), 0, pivots, t, std::min(2, shape.strips() - t)));
  }
  void form_update(const FrontKernels<Real>& kernels) {
    update.reserve(static_cast<std::size_t>(shape.update_size()) + 1);
    for (int t = shape.first_update_strip(); t < shape.strips(); ++t) {
      Real* const to[2] = {update.data() + shape.update_strip(t), nullptr};
      const int middle = shape.pivots / 2; // in two parts, to try both ways of summing
      const int first = shape.first_update_column(), end = shape.update_columns_end(t);
      kernels.subtract(shape, panel.data(), t, 1, first, end, 0, middle, to, true);
      kernels.subtract(shape, panel.data(), t, 1, first, end, middle, shape.pivots, to, false);
    }
  }
  static Real& in_panel(const FrontShape<Real>& s, Real* p, int r, int k) {
    return p[s.panel_strip(r / S) + std::ptrdiff_t{S} * k + r % S];
  }
  static Real& in_update(const FrontShape<Real>& s, Real* p, int r, int k) {
    return p[s.update_strip(r / S) + std::ptrdiff_t{S} * k + r % S];
  }

  FrontShape<Real> shape;
  KeptBuffer<Real> panel, update;
  Eigen::MatrixXd factor;
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(FrontKernelsTest, Reals);

TYPED_TEST(FrontKernelsTest, EliminateAndUpdate) {
  for (const auto* kernels : available_front_kernels<TypeParam>())
    for (const auto& [pivots, rows] : shapes) {
      this->eliminate(*kernels, pivots, rows);
      for (int k = 0; k < pivots; ++k)
        for (int r = k; r < rows; ++r)
          ASSERT_NEAR(this->in_panel(this->shape, this->panel.data(), r, k),
                      r == k ? 1 / this->factor(k, k) : this->factor(r, k), this->bound * pivots);
      this->form_update(*kernels);
      for (int k = pivots; k < rows; ++k)
        for (int r = k; r < rows; ++r)
          ASSERT_NEAR(this->in_update(this->shape, this->update.data(), r, k),
                      -this->factor.row(r).dot(this->factor.row(k)), this->bound * pivots);
    }
}

TYPED_TEST(FrontKernelsTest, RefusesBadPivots) {
  for (const auto* kernels : available_front_kernels<TypeParam>())
    for (const TypeParam bad : {TypeParam(0), TypeParam(-1), std::numeric_limits<TypeParam>::infinity(),
                                std::numeric_limits<TypeParam>::quiet_NaN()}) {
      this->eliminate(*kernels, 5, 9);
      this->panel.data()[0] = bad;
      EXPECT_FALSE(kernels->eliminate(this->shape, this->panel.data(), 0, 5, 0, 1));
    }
}

TYPED_TEST(FrontKernelsTest, AddsChildren) {
  for (const auto* kernels : available_front_kernels<TypeParam>())
    for (const auto& [pivots, rows] : shapes) {
      this->eliminate(*kernels, pivots, rows);
      this->form_update(*kernels);
      const int count = rows - pivots;
      std::vector<std::uint32_t> places; // runs of three, as vertices have
      for (int i = 0; i < count; ++i)
        places.push_back(static_cast<std::uint32_t>(i + i / 3 * 2));
      const FrontShape<TypeParam> parent{count + 1, 2 * count + 3};
      const auto in_panel =
          static_cast<int>(std::lower_bound(places.begin(), places.end(), parent.pivots) - places.begin());
      KeptBuffer<TypeParam> parent_panel, parent_update;
      parent_panel.reserve(static_cast<std::size_t>(parent.panel_size())); // fresh memory is zero
      parent_update.reserve(static_cast<std::size_t>(parent.update_size()) + 1);
      const ChildUpdate<TypeParam> child{this->shape, this->update.data(), places.data(), in_panel};
      for (const auto& [first, last] : {std::array{pivots, pivots + count / 3}, {pivots + count / 3, rows}}) {
        const int later = pivots + in_panel;
        kernels->add_to_panel(child, parent, parent_panel.data(), first, last);
        kernels->add_to_update(child, parent, parent_update.data(), std::max(first, later), std::max(last, later));
      }
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(parent.rows, parent.rows);
      for (int k = 0; k < count; ++k)
        for (int r = k; r < count; ++r)
          expected(places[r], places[k]) = this->in_update(this->shape, this->update.data(), pivots + r, pivots + k);
      for (int k = 0; k < parent.rows; ++k)
        for (int r = k; r < parent.rows; ++r)
          ASSERT_EQ(k < parent.pivots ? this->in_panel(parent, parent_panel.data(), r, k)
                                      : this->in_update(parent, parent_update.data(), r, k),
                    expected(r, k));
    }
}

TYPED_TEST(FrontKernelsTest, SolvesForwardAndBackward) {
  for (const auto* kernels : available_front_kernels<TypeParam>())
    for (const auto& [pivots, rows] : shapes) {
      this->eliminate(*kernels, pivots, rows);
      const int padded = this->shape.strips() * this->S;
      KeptBuffer<TypeParam> x, sums;
      x.reserve(static_cast<std::size_t>(padded));
      sums.reserve(static_cast<std::size_t>((pivots + this->S) * this->S));
      Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(rows, -1, 2);
      for (int r = 0; r < rows; ++r)
        x.data()[r] = static_cast<TypeParam>(b[r]);
      kernels->forward(this->shape, this->panel.data(), x.data());
      const auto triangle = this->factor.topRows(pivots).template triangularView<Eigen::Lower>();
      const auto below = this->factor.bottomRows(rows - pivots);
      b.head(pivots) = triangle.solve(b.head(pivots)).eval();
      Eigen::VectorXd right = b.head(pivots);
      if (rows > pivots) {
        b.tail(rows - pivots) -= below * b.head(pivots);
        right -= below.transpose() * b.tail(rows - pivots);
      }
      for (int r = 0; r < rows; ++r)
        ASSERT_NEAR(x.data()[r], b[r], this->bound * pivots);
      kernels->backward(this->shape, this->panel.data(), x.data(), sums.data());
      b.head(pivots) = triangle.transpose().solve(right);
      for (int r = 0; r < rows; ++r)
        ASSERT_NEAR(x.data()[r], b[r], this->bound * pivots);
    }
}

} // namespace
