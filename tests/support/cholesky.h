// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse Cholesky factorisation by CHOLMOD's supernodal method, which our own is compared with.
#pragma once
#include <memory>

#include <Eigen/Core>

#include "libsheet/linear/sparse_lower.h"

namespace sheet {

class Cholesky {
public:
  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  // Symbolic analysis of a structure that already is in a good order.
  void analyze(const SparseLower& structure);
  // Factorises A + shift I. False if that is not positive definite (to working precision).
  [[nodiscard]] bool factorize(const SparseLower& a, double shift);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  [[nodiscard]] double flops() const; // of the last factorisation's structure
  [[nodiscard]] double factor_entries() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet
