// SPDX-License-Identifier: GPL-3.0-or-later
// The multifrontal factorisation against CHOLMOD and dense matrices, and its promises: the same bits for any number of
// threads, indefinite matrices refused, one object for one structure after another.
#include "libsheet/linear/supernodal_factor.h"

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "libsheet/energy/assembly.h"
#include "libsheet/energy/model.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/linear/elimination_order.h"
#include "libsheet/linear/symmetric_product.h"
#include "tests/support/cholesky.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

struct Problem {
  SparseLower a;
  NodeGraph graph;
};

// The lower triangle of a dense symmetric matrix, by nodes of one and of three unknowns in turns that `seed` draws;
// blocks of zeros are left out, but on the diagonal.
Problem sparse(const Eigen::MatrixXd& dense, unsigned seed) {
  std::mt19937 random(seed);
  const int size = static_cast<int>(dense.cols());
  NodeGraph graph{{0}, {0}, {}};
  while (graph.first.back() < size)
    graph.first.push_back(graph.first.back() + (random() % 2 == 0 && graph.first.back() + 3 <= size ? 3 : 1));
  SparseLower a{size, {0}, {}, {}};
  for (int k = 0; k < graph.nodes(); ++k) {
    for (int other = k + 1; other < graph.nodes(); ++other)
      if (!dense.block(graph.first[other], graph.first[k], graph.width(other), graph.width(k)).isZero(0))
        graph.later.push_back(other);
    graph.start.push_back(static_cast<int>(graph.later.size()));
    for (int c = graph.first[k]; c < graph.first[k + 1]; ++c) {
      const auto add = [&](int first, int end) {
        for (int r = first; r < end; ++r) {
          a.rows.push_back(r);
          a.values.push_back(dense(r, c));
        }
      };
      add(c, graph.first[k + 1]);
      for (const int other : graph.neighbours(k))
        add(graph.first[other], graph.first[other + 1]);
      a.starts.push_back(static_cast<int>(a.rows.size()));
    }
  }
  return {std::move(a), std::move(graph)};
}

Eigen::VectorXd times(const SparseLower& a, double shift, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = shift * x;
  for (int c = 0; c < a.size; ++c)
    for (int p = a.starts[c]; p < a.starts[c + 1]; ++p) {
      y[a.rows[p]] += a.values[p] * x[c];
      if (a.rows[p] != c)
        y[c] += a.values[p] * x[a.rows[p]];
    }
  return y;
}

Eigen::VectorXd random_vector(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd b(size);
  for (double& x : b)
    x = uniform(random);
  return b;
}

// Diagonally dominant, so that its condition stays small. per_row: entries in a row, on average.
Eigen::MatrixXd random_dense(int size, double per_row, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
  for (int c = 0; c < size; ++c)
    for (int r = c + 1; r < size; ++r)
      if (std::abs(uniform(random)) * size < per_row)
        m(r, c) = m(c, r) = uniform(random);
  for (int c = 0; c < size; ++c)
    m(c, c) = 0.5 + m.col(c).cwiseAbs().sum();
  return m;
}

// The structure of a sheet with angles, in nested dissection, with values as above.
Problem sheet_matrix(const test::Mesh& mesh, unsigned seed) {
  const State s = test::at_rest(mesh, 0.01);
  Model m;
  m.liquid.viscosity = 100;
  m.bending = Bending::mid_edge;
  Assembly assembly(s.mesh, make_terms(m, s.mesh), true);
  assembly.set_order(elimination_order(s.positions.size(), assembly.vertex_graph()));
  SparseLower a = assembly.pattern().structure();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& v : a.values)
    v = uniform(random);
  std::vector<double> sums(static_cast<std::size_t>(a.size), 0.5);
  for (int pass = 0; pass < 2; ++pass)
    for (int c = 0; c < a.size; ++c)
      for (int p = a.starts[c]; p < a.starts[c + 1]; ++p) {
        const int r = a.rows[p];
        if (r == c && pass == 1)
          a.values[p] = sums[c];
        else if (r != c && pass == 0) {
          sums[r] += std::abs(a.values[p]);
          sums[c] += std::abs(a.values[p]);
        }
      }
  return {std::move(a), assembly.pattern().node_graph()};
}

// `arms` of 20 nodes of three unknowns each, every one of them coupled wholly within and with a hub of 270: a big front
// with many children whose updates go to all of its rows, from places that are not those of whole strips. Diagonally
// dominant.
Problem star(int arms) {
  constexpr int width = 3, arm = 20, hub = 270;
  const int nodes = arms * arm + hub;
  NodeGraph graph{{0}, {0}, {}};
  SparseLower a{width * nodes, {0}, {}, {}};
  for (int node = 0; node < nodes; ++node) {
    const int own_end = node < arms * arm ? (node / arm + 1) * arm : nodes;
    for (int other = node + 1; other < nodes; ++other)
      if (other < own_end || other >= arms * arm)
        graph.later.push_back(other);
    graph.start.push_back(static_cast<int>(graph.later.size()));
    graph.first.push_back(width * (node + 1));
    for (int c = width * node; c < width * (node + 1); ++c) {
      for (int r = c; r < width * nodes; ++r)
        if (r < width * own_end || r >= width * arms * arm) {
          a.rows.push_back(r);
          a.values.push_back(r == c ? width * nodes : 1 / (1.0 + (r * 7 + c) % 11));
        }
      a.starts.push_back(static_cast<int>(a.rows.size()));
    }
  }
  return {std::move(a), std::move(graph)};
}

Eigen::VectorXd no_scale(const SparseLower& a) { return Eigen::VectorXd::Ones(a.size); }

template <class Real> double residual_bound() { return sizeof(Real) == 4 ? 3e-6 : 1e-14; }

template <class Real> void expect_solves(SupernodalFactor<Real>& factor, const SparseLower& a, double shift) {
  ASSERT_TRUE(factor.factorize(a, no_scale(a), shift)) << a.size;
  const Eigen::VectorXd b = random_vector(a.size, 7);
  const Eigen::VectorXd x = factor.solve(b);
  SparseLower magnitudes = a;
  for (double& v : magnitudes.values)
    v = std::abs(v);
  const double size = times(magnitudes, shift, x.cwiseAbs()).norm();
  EXPECT_LT((times(a, shift, x) - b).norm(), residual_bound<Real>() * size) << a.size;
}

template <class Real> class SupernodalFactorTest : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(SupernodalFactorTest, Reals);

TYPED_TEST(SupernodalFactorTest, SolvesEveryKindOfStructure) {
  SupernodalFactor<TypeParam> factor; // one object: structures grow and shrink
  for (const int size : {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 33, 64, 100, 129, 300, 40, 5, 1})
    for (const double per_row : {0.0, 0.5, 1.5, 3.0, 10.0, 1e9}) {
      const auto [a, graph] = sparse(random_dense(size, per_row, static_cast<unsigned>(size)), 1);
      factor.analyze(graph);
      expect_solves(factor, a, 0);
      expect_solves(factor, a, 0.3);
    }
}

TYPED_TEST(SupernodalFactorTest, AgreesWithDenseSolution) {
  for (const int size : {1, 20, 90}) {
    const Eigen::MatrixXd dense = random_dense(size, 4, 11);
    const auto [a, graph] = sparse(dense, 2);
    SupernodalFactor<TypeParam> factor;
    factor.analyze(graph);
    ASSERT_TRUE(factor.factorize(a, no_scale(a), 0.1));
    const Eigen::VectorXd b = random_vector(size, 3);
    const Eigen::VectorXd exact = (dense + 0.1 * Eigen::MatrixXd::Identity(size, size)).llt().solve(b);
    EXPECT_LT((factor.solve(b) - exact).norm(), 10 * residual_bound<TypeParam>() * exact.norm());
  }
}

TYPED_TEST(SupernodalFactorTest, AgreesWithCholmodOnSheets) {
  SupernodalFactor<TypeParam> factor;
  for (const auto& mesh : {test::disk(1, 6, 0.2), test::icosphere(4), test::rectangle(1, 1, 1, 1, 0),
                           test::rectangle(3, 1, 60, 20, 0.2), test::icosphere(1)}) {
    const auto [a, graph] = sheet_matrix(mesh, 5);
    factor.analyze(graph);
    expect_solves(factor, a, 0.01);
    Cholesky cholesky;
    cholesky.analyze(a);
    ASSERT_TRUE(cholesky.factorize(a, 0.01));
    const Eigen::VectorXd b = random_vector(a.size, 9), exact = cholesky.solve(b);
    EXPECT_LT((factor.solve(b) - exact).norm(), 10 * residual_bound<TypeParam>() * exact.norm());
    EXPECT_GE(factor.flops(), 0.99 * cholesky.flops()); // amalgamation adds some
    EXPECT_GT(factor.bytes(), 0u);
  }
}

TYPED_TEST(SupernodalFactorTest, BigDenseAndDisconnectedBlocks) {
  const Eigen::MatrixXd block = random_dense(700, 1e9, 1);
  SupernodalFactor<TypeParam> factor;
  const Problem dense = sparse(block, 3);
  factor.analyze(dense.graph);
  expect_solves(factor, dense.a, 0);
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(1000, 1000);
  apart.topLeftCorner(600, 600) = block.topLeftCorner(600, 600);
  apart.bottomRightCorner(350, 350) = block.bottomRightCorner(350, 350);
  apart.diagonal().segment(600, 50).setOnes();
  const auto [a, graph] = sparse(apart, 4);
  factor.analyze(graph);
  expect_solves(factor, a, 0);
}

// A factor that decays below the least normal float; the caller keeps its own arithmetic.
TYPED_TEST(SupernodalFactorTest, TinyNumbersAreZeroWithinOnly) {
  const int size = 400;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (int k = 0; k < size; ++k) {
    dense(k, k) = 1;
    for (int far : {1, 20})
      if (k + far < size)
        dense(k + far, k) = dense(k, k + far) = 1e-5;
  }
  const auto [a, graph] = sparse(dense, 5);
  SupernodalFactor<TypeParam> factor;
  factor.analyze(graph);
  expect_solves(factor, a, 0);
  volatile double tiny = std::numeric_limits<double>::min();
  tiny = tiny / 4;
  EXPECT_GT(tiny, 0);
}

TYPED_TEST(SupernodalFactorTest, LongChainAndArrow) {
  SupernodalFactor<TypeParam> factor;
  for (const bool arrow : {false, true}) {
    SparseLower a{20000, {0}, {}, {}};
    NodeGraph graph{{0}, {0}, {}};
    for (int c = 0; c < a.size; ++c) {
      a.rows.push_back(c);
      a.values.push_back(arrow && c == a.size - 1 ? a.size : 3);
      if (c + 1 < a.size) {
        graph.later.push_back(arrow ? a.size - 1 : c + 1);
        a.rows.push_back(graph.later.back());
        a.values.push_back(-1);
      }
      a.starts.push_back(static_cast<int>(a.rows.size()));
      graph.first.push_back(c + 1);
      graph.start.push_back(static_cast<int>(graph.later.size()));
    }
    factor.analyze(graph);
    expect_solves(factor, a, 0);
  }
}

TYPED_TEST(SupernodalFactorTest, ScalesRowsAndColumns) {
  const Eigen::MatrixXd dense = random_dense(120, 4, 12);
  const auto [a, graph] = sparse(dense, 8);
  const Eigen::VectorXd scale = 1.2 * Eigen::VectorXd::Ones(120) + random_vector(120, 4);
  SupernodalFactor<TypeParam> factor;
  factor.analyze(graph);
  ASSERT_TRUE(factor.factorize(a, scale, 0.1));
  const Eigen::MatrixXd scaled = scale.asDiagonal() * dense * scale.asDiagonal();
  const Eigen::VectorXd b = random_vector(120, 3);
  const Eigen::VectorXd exact = (scaled + 0.1 * Eigen::MatrixXd::Identity(120, 120)).llt().solve(b);
  EXPECT_LT((factor.solve(b) - exact).norm(), 100 * residual_bound<TypeParam>() * exact.norm());
}

TYPED_TEST(SupernodalFactorTest, EmptyRowsNeedTheShift) {
  Eigen::MatrixXd dense = random_dense(50, 3, 2);
  for (const int hole : {0, 17, 49})
    dense.row(hole).setZero(), dense.col(hole).setZero();
  SupernodalFactor<TypeParam> factor;
  const auto [a, graph] = sparse(dense, 6);
  factor.analyze(graph);
  EXPECT_FALSE(factor.factorize(a, no_scale(a), 0));
  expect_solves(factor, a, 0.5);
}

TYPED_TEST(SupernodalFactorTest, RefusesWhatIsNotDefinite) {
  const auto [a, graph] = sheet_matrix(test::disk(1, 8, 0.2), 5);
  SupernodalFactor<TypeParam> factor;
  factor.analyze(graph);
  expect_solves(factor, a, 0);
  for (const double bad : {-1e3, 0.0, 1e300, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
    for (const double place : {0.0, 0.3, 0.7, 1.0}) {
      SparseLower b = a;
      const int column = static_cast<int>(place * (a.size - 1));
      b.values[b.starts[column]] = bad;
      EXPECT_EQ(factor.factorize(b, no_scale(b), 0), bad == 1e300 && sizeof(TypeParam) == 8)
          << bad << " in column " << column;
      if (b.starts[column + 1] > b.starts[column] + 1 && bad != 0 && bad != -1e3) {
        b = a;
        b.values[b.starts[column] + 1] = bad;
        EXPECT_FALSE(factor.factorize(b, no_scale(b), 0)) << bad << " below the diagonal of column " << column;
      }
    }
  EXPECT_FALSE(factor.factorize(a, no_scale(a), -1e4));
  expect_solves(factor, a, 0);
}

TYPED_TEST(SupernodalFactorTest, SameBitsForAnyNumberOfThreads) {
  const Problem sheet = sheet_matrix(test::rectangle(1, 1, 60, 60, 0.2), 3);
  const Problem block = sparse(random_dense(600, 1e9, 4), 7);
  for (const Problem* p : {&sheet, &block}) {
    const Eigen::VectorXd b = random_vector(p->a.size, 1);
    Eigen::VectorXd first;
    for (const std::size_t threads : {1u, 2u, 3u, 7u, 3u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      SupernodalFactor<TypeParam> factor;
      factor.analyze(p->graph);
      for (int repeat = 0; repeat < 3; ++repeat) {
        ASSERT_TRUE(factor.factorize(p->a, no_scale(p->a), 0));
        const Eigen::VectorXd x = factor.solve(b);
        if (first.size() == 0)
          first = x;
        EXPECT_EQ(x, first) << threads << " threads";
      }
    }
  }
}

// Parts of a child's update that are added at the same time must not meet in a strip of the parent.
TYPED_TEST(SupernodalFactorTest, SameBitsWhereChildrenAreAddedInParts) {
  const Problem p = star(40);
  const Eigen::VectorXd b = random_vector(p.a.size, 1);
  Eigen::VectorXd first;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    SupernodalFactor<TypeParam> factor;
    factor.analyze(p.graph);
    for (int repeat = 0; repeat < 5; ++repeat) {
      ASSERT_TRUE(factor.factorize(p.a, no_scale(p.a), 0));
      const Eigen::VectorXd x = factor.solve(b);
      if (first.size() == 0)
        first = x;
      ASSERT_EQ(x, first) << threads << " threads";
    }
  }
}

TEST(NodeGraph, OfASheetTellsTheRowsOfItsMatrix) {
  const auto [a, graph] = sheet_matrix(test::disk(1, 6, 0.2), 5);
  ASSERT_EQ(graph.first.back(), a.size);
  for (int k = 0; k < graph.nodes(); ++k)
    for (int c = graph.first[k]; c < graph.first[k + 1]; ++c) {
      std::vector<int> rows;
      const auto add = [&](int first, int end) {
        for (int r = first; r < end; ++r)
          rows.push_back(r);
      };
      add(c, graph.first[k + 1]);
      for (const int other : graph.neighbours(k))
        add(graph.first[other], graph.first[other + 1]);
      EXPECT_EQ(rows, std::vector<int>(a.rows.begin() + a.starts[c], a.rows.begin() + a.starts[c + 1])) << c;
    }
}

TEST(SymmetricProduct, IsThatOfTheWholeMatrix) {
  SymmetricProduct product; // one object for one matrix after another
  for (const auto& [a, graph] : {sheet_matrix(test::disk(1, 6, 0.2), 5), sparse(random_dense(100, 5, 3), 9),
                                 sparse(random_dense(1, 0, 3), 10)}) {
    const Eigen::VectorXd x = random_vector(a.size, 2), exact = times(a, 0, x);
    product.analyze(graph);
    Eigen::VectorXd y;
    product.multiply(a, x, y);
    EXPECT_LT((y - exact).norm(), 1e-14 * times(a, 0, x).norm() + 1e-14);
  }
}

} // namespace
