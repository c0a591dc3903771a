// SPDX-License-Identifier: GPL-3.0-or-later
// A sparse symmetric matrix, and the graph of its nodes: unknowns that have the same neighbours, as the coordinates of
// a vertex have.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace sheet {

// Lower triangle of a symmetric matrix, compressed columns, rows ascending.
struct SparseLower {
  int size = 0;
  std::vector<int> starts, rows;
  std::vector<double> values;
};

// Which nodes have elements in common; nodes and rows are numbered in the order of elimination. Node k has the columns
// first[k] to first[k + 1] of the matrix, and each of these has the rows of the node from the column's own on, then all
// rows of the nodes later[start[k]] to later[start[k + 1]], which ascend.
struct NodeGraph {
  std::vector<int> first, start, later;
  [[nodiscard]] int nodes() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] int width(int node) const { return first[node + 1] - first[node]; }
  [[nodiscard]] std::span<const int> neighbours(int node) const {
    return {later.data() + start[node], static_cast<std::size_t>(start[node + 1] - start[node])};
  }
};

} // namespace sheet
