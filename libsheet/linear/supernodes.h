// SPDX-License-Identifier: GPL-3.0-or-later
// Symbolic analysis of a sparse Cholesky factorisation: which columns are eliminated together (supernodes), in what
// order, and which rows each of them touches. It knows nodes only (the coordinates of a vertex are one). Elimination
// tree [Liu 1990], column counts [Gilbert, Ng and Peyton 1994], supernodes merged with their parents where that saves
// time by a model of the machine [after Ashcraft and Grimes 1989].
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/linear/sparse_lower.h"

namespace sheet {

// One supernode. Its front's rows are its own nodes (the pivots), then those of `touched`.
struct Supernode {
  int first_node = 0, end_node = 0; // in the order of elimination
  int first_column = 0;             // in the order of elimination
  int pivots = 0, rows = 0;
  int parent = -1;                                // comes after its children
  int first_child = 0, children = 0;              // in Supernodes::children
  std::size_t first_touched = 0, end_touched = 0; // in Supernodes::touched
};

class Supernodes {
public:
  // The graph must be in a fill-reducing order.
  void analyze(const NodeGraph& graph);

  // That the factorisation takes on one thread, by the model by which supernodes were merged.
  [[nodiscard]] double seconds() const;

  std::vector<Supernode> fronts; // every subtree in one piece, ascending
  std::vector<int> children;
  std::vector<int> touched;  // nodes in the order of elimination, ascending in each front
  std::vector<int> node_at;  // the given number of the node that is eliminated k-th
  std::vector<int> width_at; // its unknowns

  // The k-th node's neighbours after it, by their order of elimination, in the order of the given graph.
  [[nodiscard]] std::span<const int> neighbours(int k) const { return of_graph(node_at[k]); }

private:
  [[nodiscard]] int width(int node) const { return first_unknown_[node + 1] - first_unknown_[node]; }
  [[nodiscard]] std::span<const int> of_graph(int node) const {
    return {graph_.data() + graph_start_[node], static_cast<std::size_t>(graph_start_[node + 1] - graph_start_[node])};
  }
  void find_tree();
  void find_postorder();
  void count_columns();
  void merge();
  void number_fronts();
  void find_rows();

  std::vector<int> first_unknown_, graph_start_, graph_; // as given
  std::vector<int> upper_start_, upper_, next_;
  std::vector<int> parent_, post_, post_rank_;             // of nodes as given; post_[k] is the k-th in postorder
  std::vector<int> count_;                                 // rows of the node's first column in the factor
  std::vector<int> first_, highest_, previous_, ancestor_; // of counting
  std::vector<int> head_, sibling_;                        // lists of children
  std::vector<int> rank_;                                  // the inverse of node_at
  std::vector<int> into_;                                  // what a node in postorder is merged into
  std::vector<int> mark_;
};

} // namespace sheet
