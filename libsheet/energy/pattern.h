// SPDX-License-Identifier: GPL-3.0-or-later
// Where every element entry goes in the sparse matrix. Nodes are the vertices (three unknowns each), then the edges
// (one each, if the sheet has angle unknowns). The matrix is the lower triangle, by columns, in a given order of the
// nodes. Each block of it, a pair of nodes, knows all places in the element buffer that it is the sum of, in a fixed
// order: so gathering is parallel over columns and the result does not depend on the number of threads.
// The buffer keeps of each symmetric element Hessian one block a pair of nodes, as the matrix wants it (rows of the
// node that is eliminated later), each block by columns in one piece: 87 numbers a triangle with edges instead of 144.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/energy/constraints.h"
#include "libsheet/energy/element.h"
#include "libsheet/linear/sparse_lower.h"

namespace sheet {

// Elements of one stencil: the nodes of element i are nodes[i * width ...].
struct ElementGroup {
  Stencil stencil;
  int width = 0;
  std::vector<std::uint32_t> nodes;
  std::size_t first = 0;         // of its elements among all
  std::size_t first_hessian = 0; // of its elements' packed Hessians in the common buffer
  [[nodiscard]] std::size_t size() const { return width ? nodes.size() / static_cast<std::size_t>(width) : 0; }
};

// Numbers that the buffer keeps of an element's Hessian.
constexpr int packed_size(Stencil s) {
  const int v = stencil_vertices(s), e = stencil_edges(s);
  return 9 * v * (v + 1) / 2 + 3 * v * e + e * (e + 1) / 2;
}

class MatrixPattern {
public:
  // order: the nodes in the order of elimination. stride: numbers of an element in the gradient buffer.
  MatrixPattern(std::size_t vertices, std::size_t edges, std::span<const ElementGroup> groups, int stride,
                std::span<const std::uint32_t> order);

  [[nodiscard]] std::size_t unknowns() const { return permutation_.size(); }
  // permutation()[k] is the unknown in row k of the matrix.
  [[nodiscard]] const std::vector<std::uint32_t>& permutation() const { return permutation_; }
  // The first of the three rows of a vertex.
  [[nodiscard]] Eigen::Index first_row(std::uint32_t vertex) const { return column_start_[rank_[vertex]]; }
  // The matrix, of zeros.
  [[nodiscard]] SparseLower structure() const;
  [[nodiscard]] NodeGraph node_graph() const;

  // Puts the Hessian of an element (column major, stride x stride; its lower triangle counts) into its place,
  // packed_size(group.stencil) numbers.
  void pack(const ElementGroup& group, std::size_t element, const double* hessian, double* packed) const;
  void gather_gradient(const double* buffer, Eigen::VectorXd& gradient) const;
  // Rows and columns of held unknowns become those of the unit matrix, blocks of vertices that slide are projected on
  // what is free. matrix must be one of structure().
  void gather_matrix(const double* buffer, const Constraints& constraints, SparseLower& matrix) const;
  // For each axis the sum of the (whole) matrix over all pairs of vertices: what resists a translation.
  [[nodiscard]] Vector3 sum_of_blocks(const SparseLower& matrix) const;

private:
  struct Block {
    std::uint32_t row_node;
    std::uint32_t offset;       // of its first row among the rows of its column's nodes, counted from the node's own
    std::uint32_t first_source; // in sources_
  };
  struct Pairs;
  void number_columns(std::size_t nodes);                   // rank_, column_start_, permutation_
  void note_reversed(std::span<const ElementGroup> groups); // reversed_
  [[nodiscard]] Pairs sorted_pairs(std::span<const ElementGroup> groups) const;
  void make_blocks(const Pairs& sorted);                     // blocks_, block_start_, sources_
  void place_gradient(std::span<const ElementGroup> groups); // gradient_start_, gradient_sources_
  [[nodiscard]] std::uint32_t first_unknown(std::uint32_t node) const {
    return node < vertices_ ? 3 * node : static_cast<std::uint32_t>(3 * vertices_ + (node - vertices_));
  }
  [[nodiscard]] int width(std::uint32_t node) const { return node < vertices_ ? 3 : 1; }

  std::size_t vertices_;
  int stride_;
  std::vector<std::uint32_t> order_, rank_, permutation_; // rank_: of each node in the order
  std::vector<std::uint32_t> column_start_;               // scalar column of each node, in elimination order
  std::vector<std::uint32_t> block_start_;                // of each node column, in elimination order
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> sources_; // places in the Hessian buffer
  std::vector<std::uint8_t> reversed_; // for each element: bit a(a-1)/2 + b, whether vertex a > b is eliminated first
  std::vector<std::uint32_t> gradient_start_, gradient_sources_;
};

} // namespace sheet
