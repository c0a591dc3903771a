// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse Cholesky factorisation by CHOLMOD's supernodal method. The libraries are loaded on first use, so that two of
// their defaults can be mended first: OpenBLAS takes new processors for an old one (OPENBLAS_CORETYPE, unless the user
// set it), and CHOLMOD opens OpenMP threads of its own.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "libsheet/energy/pattern.h"

namespace sheet {

// The processor that OpenBLAS works for, e.g. "SkylakeX"; print it with every benchmark.
[[nodiscard]] std::string blas_core_name();

// A fill-reducing order of the rows of a matrix, of which only the structure is read: nested dissection [George 1973]
// with METIS's separators, parts below `least` rows by minimum degree (CSYMAMD). order: at least as long as the rows.
void nested_dissection(const SparseLower& structure, std::size_t least, std::vector<int>& order);

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
