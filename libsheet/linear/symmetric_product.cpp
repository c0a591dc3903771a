// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/symmetric_product.h"

#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sheet {

namespace {
constexpr int nodes_at_once = 256;
}

void SymmetricProduct::analyze(const NodeGraph& graph) {
  graph_ = graph;
  const int nodes = graph_.nodes();
  left_start_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const int node : graph_.later)
    ++left_start_[node + 1];
  for (int k = 0; k < nodes; ++k)
    left_start_[k + 1] += left_start_[k];
  left_.resize(graph_.later.size());
  std::vector<int> next(left_start_.begin(), left_start_.end() - 1);
  for (int k = 0; k < nodes; ++k) {
    int rows = graph_.width(k);
    for (const int node : graph_.neighbours(k)) {
      left_[next[node]++] = {k, rows};
      rows += graph_.width(node);
    }
  }
}

// The rows of a node of this width: what is left of the diagonal, and what the columns of the same numbers have from
// the diagonal on.
template <int Width>
void SymmetricProduct::multiply_rows(const SparseLower& a, int node, const double* x, double* y) const {
  double left[Width] = {}, below[Width] = {};
  const double* const values = a.values.data();
  for (int b = left_start_[node]; b < left_start_[node + 1]; ++b) {
    const auto [column_node, rows] = left_[b];
    for (int d = 0, c = graph_.first[column_node]; c < graph_.first[column_node + 1]; ++c, ++d)
      for (int r = 0; r < Width; ++r)
        left[r] += values[a.starts[c] + rows - d + r] * x[c];
  }
  const int first = graph_.first[node];
  const double* column[Width]; // from row 0 of the node on
  for (int d = 0; d < Width; ++d) {
    column[d] = values + a.starts[first + d] - d;
    for (int c = 0; c < d; ++c)
      left[d] += column[c][d] * x[first + c];
  }
  for (int d = 0; d < Width; ++d)
    for (int r = d; r < Width; ++r)
      below[d] += column[d][r] * x[first + r];
  int rows = Width;
  for (const int other : graph_.neighbours(node))
    for (int r = graph_.first[other]; r < graph_.first[other + 1]; ++r, ++rows)
      for (int d = 0; d < Width; ++d)
        below[d] += column[d][rows] * x[r];
  for (int d = 0; d < Width; ++d)
    y[first + d] = left[d] + below[d];
}

void SymmetricProduct::multiply(const SparseLower& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(a.size);
  tbb::parallel_for(tbb::blocked_range<int>(0, graph_.nodes(), nodes_at_once), [&](const auto& range) {
    for (int node = range.begin(); node < range.end(); ++node)
      switch (graph_.width(node)) {
      case 1:
        multiply_rows<1>(a, node, x.data(), y.data());
        break;
      case 3:
        multiply_rows<3>(a, node, x.data(), y.data());
        break;
      default:
        throw std::logic_error("a node has one unknown or three");
      }
  });
}

} // namespace sheet
