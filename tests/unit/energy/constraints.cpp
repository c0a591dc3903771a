// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints in the matrix, and what it makes of translations.
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "libsheet/energy/assembly.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/surface_tension.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

Eigen::MatrixXd dense(const SparseLower& matrix, const MatrixPattern& pattern) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
  for (int c = 0; c < matrix.size; ++c)
    for (int p = matrix.starts[static_cast<std::size_t>(c)]; p < matrix.starts[static_cast<std::size_t>(c) + 1]; ++p) {
      const auto row = pattern.permutation()[static_cast<std::size_t>(matrix.rows[static_cast<std::size_t>(p)])];
      const auto column = pattern.permutation()[static_cast<std::size_t>(c)];
      full(row, column) = full(column, row) = matrix.values[static_cast<std::size_t>(p)];
    }
  return full;
}

// P H P, and stiffness across; the gradient's part across is gone.
TEST(Constraints, ProjectTheMatrix) {
  const State s = test::at_rest(test::icosphere(1), 0.3);
  Terms terms;
  terms.push_back(make_term(MidEdgeShell(true))); // writes lower triangles only
  terms.push_back(make_term(SurfaceTension()));
  const Stage stage = first_stage(s, {.viscosity = 2, .surface_tension = 0.7}, 0.05, 0.05, true);
  for (const auto& term : terms)
    term->begin(stage);
  Assembly assembly(s.mesh, terms, true);
  std::vector<std::uint32_t> order(s.positions.size());
  for (std::uint32_t v = 0; v < order.size(); ++v)
    order[v] = (5 * v) % static_cast<std::uint32_t>(order.size()); // of 42 vertices
  assembly.set_order(order);
  Constraints constraints;
  const auto n = static_cast<Eigen::Index>(assembly.unknowns());
  constraints.held.assign(assembly.unknowns(), 0);
  constraints.held[3 * 5 + 1] = 1;
  std::vector<Slide> slides;
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n);
  for (const std::uint32_t v : {2U, 3U, 17U}) {
    const Vector3 across = s.positions[v].normalized();
    slides.push_back({v, Matrix3::Identity() - across * across.transpose()});
    free.block<3, 3>(3 * v, 3 * v) = slides.back().free;
  }
  free(16, 16) = 0;
  constraints.let_slide(slides, s.positions.size());
  SparseLower matrix = assembly.pattern().structure(), constrained = matrix;
  Eigen::VectorXd g, gc;
  assembly.derivatives(terms, stage.begin, true, {}, g, matrix);
  assembly.derivatives(terms, stage.begin, true, constraints, gc, constrained);
  const Eigen::MatrixXd h = dense(matrix, assembly.pattern()), hc = dense(constrained, assembly.pattern());
  EXPECT_LT((free * (hc - h) * free).cwiseAbs().maxCoeff(), 1e-12 * h.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd across = Eigen::MatrixXd::Identity(n, n) - free;
  EXPECT_LT((free * hc * across).cwiseAbs().maxCoeff(), 1e-12 * h.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd whole = hc + free;
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(whole).eigenvalues()[0], 0);
  EXPECT_LT((gc - free * g).cwiseAbs().maxCoeff(), 1e-12 * g.cwiseAbs().maxCoeff());
}

TEST(MatrixPattern, AddsUpWhatResistsATranslation) {
  const State s = test::at_rest(test::disk(1, 25, 0.1), 0.3); // more nodes than are added up in one piece
  Terms terms;
  terms.push_back(make_term(SurfaceTension()));
  terms.push_back(make_term(MidEdgeShell(true)));
  const Stage stage = first_stage(s, {.viscosity = 2, .surface_tension = 0.7}, 0.05, 0.05, true);
  for (const auto& term : terms)
    term->begin(stage);
  Assembly assembly(s.mesh, terms, true);
  std::vector<std::uint32_t> order(s.positions.size());
  std::iota(order.rbegin(), order.rend(), 0);
  assembly.set_order(order);
  SparseLower matrix = assembly.pattern().structure();
  for (std::size_t p = 0; p < matrix.values.size(); ++p)
    matrix.values[p] = std::sin(static_cast<double>(p));
  const Eigen::MatrixXd h = dense(matrix, assembly.pattern());
  const Vector3 sum = assembly.pattern().sum_of_blocks(matrix);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd translation = Eigen::VectorXd::Zero(h.cols());
    for (Eigen::Index v = 0; v < static_cast<Eigen::Index>(s.positions.size()); ++v)
      translation[3 * v + axis] = 1;
    EXPECT_NEAR(sum[axis], translation.dot(h * translation), 1e-10);
  }
}

} // namespace
} // namespace sheet
