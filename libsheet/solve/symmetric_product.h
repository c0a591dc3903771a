// SPDX-License-Identifier: GPL-3.0-or-later
// y = A x for a symmetric matrix of which the lower triangle is stored: rows are summed in a fixed order, in parallel,
// so that the result is the same for any number of threads.
#pragma once
#include <vector>

#include <Eigen/Core>

#include "libsheet/energy/pattern.h"

namespace sheet {

class SymmetricProduct {
public:
  void analyze(const SparseLower& structure);
  // a must have the structure that was analysed.
  void multiply(const SparseLower& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

private:
  // Of each row, the entries left of the diagonal: their columns, and places in the values.
  std::vector<int> starts_, columns_, places_;
};

} // namespace sheet
