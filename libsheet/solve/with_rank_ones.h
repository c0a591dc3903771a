// SPDX-License-Identifier: GPL-3.0-or-later
// Solves with the Hessian of a sum of terms, some of which couple all unknowns.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "libsheet/solve/newton.h"

namespace sheet {

// The factorised and scaled matrix plus the rank-one parts of the terms, by the formula of Sherman and Morrison.
class WithRankOnes {
public:
  WithRankOnes(LinearSystem& system, const Terms& terms, std::span<const char> held, const Unknowns& u,
               const Eigen::VectorXd& row_scale)
      : system_(system), row_scale_(row_scale) {
    for (const auto& term : terms) {
      Part part;
      const double c = term->rank_one(u, part.g);
      if (c == 0)
        continue;
      for (std::size_t k = 0; k < held.size(); ++k)
        if (held[k])
          part.g[static_cast<Eigen::Index>(k)] = 0;
      part.solved = solve(part.g);
      part.factor = c / (1 + c * part.g.dot(part.solved));
      parts_.push_back(std::move(part));
    }
  }

  // In the order of the unknowns.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const auto& permutation = system_.assembly.pattern().permutation();
    Eigen::VectorXd rhs(b.size()), x(b.size());
    for (Eigen::Index k = 0; k < b.size(); ++k)
      rhs[k] = row_scale_[k] * b[permutation[static_cast<std::size_t>(k)]];
    const Eigen::VectorXd scaled = system_.cholesky.solve(rhs);
    for (Eigen::Index k = 0; k < b.size(); ++k)
      x[permutation[static_cast<std::size_t>(k)]] = row_scale_[k] * scaled[k];
    for (const Part& part : parts_)
      x -= (part.factor * part.g.dot(x)) * part.solved;
    return x;
  }

private:
  struct Part {
    Eigen::VectorXd g, solved;
    double factor = 0;
  };
  LinearSystem& system_;
  const Eigen::VectorXd& row_scale_;
  std::vector<Part> parts_;
};

} // namespace sheet
