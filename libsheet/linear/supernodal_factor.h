// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse Cholesky factorisation by the multifrontal method [Duff and Reid 1983; Liu 1992], in float (a preconditioner)
// or double. Subtrees of the elimination tree are tasks, and fronts near the root are cut into blocks; children are
// added in a fixed order, so the same bits come out for any number of threads. All memory is kept for the next
// factorisation, also after another analysis.
#pragma once
#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "libsheet/linear/sparse_lower.h"

namespace sheet {

template <class Real> class SupernodalFactor {
public:
  SupernodalFactor();
  ~SupernodalFactor();
  SupernodalFactor(SupernodalFactor&&) noexcept;
  SupernodalFactor& operator=(SupernodalFactor&&) noexcept;

  // Symbolic analysis of matrices of this graph, which already is in a fill-reducing order (elimination_order gives
  // one).
  void analyze(const NodeGraph& graph);
  // Factorises S A S + shift I, with S the diagonal matrix of `scale`. False if that is not positive definite (to
  // working precision).
  [[nodiscard]] bool factorize(const SparseLower& a, const Eigen::VectorXd& scale, double shift);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  [[nodiscard]] double flops() const;      // of a factorisation
  [[nodiscard]] std::size_t bytes() const; // of the buffers held

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet
