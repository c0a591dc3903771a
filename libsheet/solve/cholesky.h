// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse Cholesky factorisation by CHOLMOD's supernodal method. The libraries are loaded on first use, so that two of
// their defaults can be mended first: OpenBLAS takes new processors for an old one (OPENBLAS_CORETYPE, unless the user
// set it), and CHOLMOD opens OpenMP threads of its own.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "libsheet/energy/pattern.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet {

// The processor that OpenBLAS works for, e.g. "SkylakeX"; print it with every benchmark.
[[nodiscard]] std::string blas_core_name();

// A fill-reducing order of the vertices of a graph: nested dissection [George 1973] with METIS's separators, parts
// below 20,000 vertices by minimum degree (CSYMAMD). Of the graph alone, not of positions, so that a resumed run
// has the same one.
[[nodiscard]] std::vector<std::uint32_t> nested_dissection(std::size_t vertices, std::span<const Edge> graph);

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
