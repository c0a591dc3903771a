// SPDX-License-Identifier: GPL-3.0-or-later
// y = A x for a symmetric matrix of which the lower triangle is stored: rows are summed in a fixed order, in parallel,
// so that the result is the same for any number of threads.
#pragma once
#include <vector>

#include <Eigen/Core>

#include "libsheet/linear/sparse_lower.h"

namespace sheet {

class SymmetricProduct {
public:
  void analyze(const NodeGraph& graph);
  // a must be of the graph that was analysed.
  void multiply(const SparseLower& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

private:
  // A block left of the diagonal.
  struct Left {
    int node; // of its columns
    int rows; // of the column's node's blocks above it, counted in the node's first column
  };
  template <int Width> void multiply_rows(const SparseLower& a, int node, const double* x, double* y) const;

  NodeGraph graph_;
  std::vector<int> left_start_; // of each node's rows, in left_
  std::vector<Left> left_;
};

} // namespace sheet
