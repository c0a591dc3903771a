// SPDX-License-Identifier: GPL-3.0-or-later
// Symbolic analysis, on the graph of the nodes.
#include "libsheet/linear/supernodes.h"

#include <algorithm>

namespace sheet {

namespace {

// Nanoseconds that eliminating a supernode takes and its factor costs in the solutions after: to start a front, for
// each of its rows, for each entry of its panel and of its update matrix, and for a product of the dense kernels.
constexpr double front_cost = 250, row_cost = 4, panel_entry_cost = 0.2, update_entry_cost = 0.3, product_cost = 0.03;

double nanoseconds_of(double pivots, double rows) {
  const double below = rows - pivots;
  const double products = pivots * (below * (below + pivots) / 2 + pivots * pivots / 6);
  return front_cost + row_cost * rows + panel_entry_cost * pivots * rows + update_entry_cost * below * below / 2 +
         product_cost * products;
}

} // namespace

void Supernodes::analyze(const NodeGraph& graph) {
  first_unknown_ = graph.first;
  graph_start_ = graph.start;
  graph_ = graph.later;
  find_tree();
  find_postorder();
  count_columns();
  merge();
  number_fronts();
  find_rows();
}

double Supernodes::seconds() const {
  double sum = 0;
  for (const Supernode& f : fronts)
    sum += 1e-9 * nanoseconds_of(f.pivots, f.rows);
  return sum;
}

// [Liu 1990], from the rows of the lower triangle, with compressed paths.
void Supernodes::find_tree() {
  const int nodes = static_cast<int>(graph_start_.size()) - 1;
  upper_start_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const int v : graph_)
    ++upper_start_[v + 1];
  for (int v = 0; v < nodes; ++v)
    upper_start_[v + 1] += upper_start_[v];
  next_.assign(upper_start_.begin(), upper_start_.end());
  upper_.resize(std::max(upper_.size(), static_cast<std::size_t>(graph_start_[nodes])));
  for (int v = 0; v < nodes; ++v)
    for (int p = graph_start_[v]; p < graph_start_[v + 1]; ++p)
      upper_[next_[graph_[p]]++] = v;
  parent_.assign(nodes, -1);
  ancestor_.assign(nodes, -1);
  for (int v = 0; v < nodes; ++v)
    for (int p = upper_start_[v]; p < upper_start_[v + 1]; ++p)
      for (int u = upper_[p]; u != -1 && u < v;) {
        const int up = ancestor_[u];
        ancestor_[u] = v;
        if (up == -1)
          parent_[u] = v;
        u = up;
      }
}

void Supernodes::find_postorder() {
  const int nodes = static_cast<int>(parent_.size());
  head_.assign(nodes, -1);
  sibling_.resize(nodes);
  int root = -1;
  for (int v = nodes - 1; v >= 0; --v) {
    int& list = parent_[v] == -1 ? root : head_[parent_[v]];
    sibling_[v] = list;
    list = v;
  }
  post_.clear();
  post_rank_.resize(nodes);
  for (int v = root; v != -1;) {
    while (head_[v] != -1)
      v = head_[v];
    for (;;) {
      post_rank_[v] = static_cast<int>(post_.size());
      post_.push_back(v);
      if (sibling_[v] != -1 || parent_[v] == -1) {
        v = sibling_[v];
        break;
      }
      v = parent_[v];
    }
  }
}

// [Gilbert, Ng and Peyton 1994], with nodes counted by their width.
void Supernodes::count_columns() {
  const int nodes = static_cast<int>(parent_.size());
  first_.assign(nodes, -1);
  count_.assign(nodes, 0);
  for (int k = 0; k < nodes; ++k) {
    int v = post_[k];
    count_[v] = first_[v] == -1 ? width(v) : 0;
    for (; v != -1 && first_[v] == -1; v = parent_[v])
      first_[v] = k;
  }
  highest_.assign(nodes, -1);
  previous_.assign(nodes, -1);
  ancestor_.resize(nodes);
  for (int v = 0; v < nodes; ++v)
    ancestor_[v] = v;
  for (int k = 0; k < nodes; ++k) {
    const int v = post_[k];
    if (parent_[v] != -1)
      count_[parent_[v]] -= width(v);
    for (const int row : of_graph(v)) {
      if (first_[v] <= highest_[row])
        continue; // not a leaf of the row's subtree
      highest_[row] = first_[v];
      count_[v] += width(row);
      const int last = previous_[row];
      previous_[row] = v;
      if (last == -1)
        continue;
      int common = last;
      while (common != ancestor_[common])
        common = ancestor_[common];
      for (int u = last; u != common;) {
        const int up = ancestor_[u];
        ancestor_[u] = common;
        u = up;
      }
      count_[common] -= width(row);
    }
    if (parent_[v] != -1)
      ancestor_[v] = parent_[v];
  }
  for (int k = 0; k < nodes; ++k)
    if (const int v = post_[k]; parent_[v] != -1)
      count_[parent_[v]] += count_[v];
}

// From the leaves up, each child joins its parent if one front is cheaper than two. Those that touch most of the
// parent's rows come first.
void Supernodes::merge() {
  const int nodes = static_cast<int>(parent_.size());
  std::vector<int>&pivots = first_, &rows = highest_;
  into_.assign(nodes, -1);
  std::vector<int> candidates;
  for (int k = 0; k < nodes; ++k) {
    const int v = post_[k];
    pivots[v] = width(v);
    rows[v] = count_[v];
    candidates.clear();
    for (int c = head_[v]; c != -1; c = sibling_[c])
      candidates.push_back(c);
    std::sort(candidates.begin(), candidates.end(), [&](int a, int b) {
      const int x = rows[a] - pivots[a], y = rows[b] - pivots[b];
      return x != y ? x > y : a < b;
    });
    double cost = nanoseconds_of(pivots[v], rows[v]);
    for (const int c : candidates) {
      const double together = nanoseconds_of(pivots[v] + pivots[c], rows[v] + pivots[c]);
      if (together > cost + nanoseconds_of(pivots[c], rows[c]))
        continue;
      cost = together;
      into_[c] = v;
      pivots[v] += pivots[c];
      rows[v] += pivots[c];
    }
  }
}

void Supernodes::number_fronts() {
  const int nodes = static_cast<int>(parent_.size());
  std::vector<int>& front_of = ancestor_; // of a node as given
  fronts.clear();
  for (int k = 0; k < nodes; ++k)
    if (const int v = post_[k]; into_[v] == -1) {
      front_of[v] = static_cast<int>(fronts.size());
      fronts.emplace_back();
    }
  for (int k = nodes - 1; k >= 0; --k) {
    const int v = post_[k];
    if (into_[v] != -1)
      front_of[v] = front_of[into_[v]];
    else if (parent_[v] != -1)
      fronts[front_of[v]].parent = front_of[parent_[v]];
    ++fronts[front_of[v]].end_node;
    fronts[front_of[v]].pivots += width(v);
  }
  int node = 0, column = 0, child = 0;
  for (Supernode& f : fronts) {
    f.first_node = node;
    node += f.end_node;
    f.end_node = f.first_node;
    f.first_column = column;
    column += f.pivots;
    if (f.parent != -1)
      ++fronts[f.parent].children;
  }
  node_at.resize(nodes);
  rank_.resize(nodes);
  width_at.resize(nodes);
  for (int k = 0; k < nodes; ++k) {
    const int v = post_[k];
    rank_[v] = fronts[front_of[v]].end_node++;
    node_at[rank_[v]] = v;
    width_at[rank_[v]] = width(v);
  }
  for (Supernode& f : fronts) {
    f.first_child = child;
    child += f.children;
    f.children = 0;
  }
  children.resize(child);
  for (int s = 0; s < static_cast<int>(fronts.size()); ++s)
    if (const int up = fronts[s].parent; up != -1)
      children[fronts[up].first_child + fronts[up].children++] = s;
}

// The rows of the children and the neighbours of the pivots; from here on the graph names nodes by their rank.
void Supernodes::find_rows() {
  mark_.assign(node_at.size(), -1);
  touched.clear();
  for (int s = 0; s < static_cast<int>(fronts.size()); ++s) {
    Supernode& f = fronts[s];
    f.first_touched = touched.size();
    const auto add = [&](int node) { // not yet known, and not a pivot
      if (node < f.end_node || mark_[node] == s)
        return;
      mark_[node] = s;
      touched.push_back(node);
    };
    int greatest = -1; // its rows are sorted already
    for (int i = 0; i < f.children; ++i)
      if (const int c = children[f.first_child + i];
          greatest == -1 || fronts[c].rows - fronts[c].pivots > fronts[greatest].rows - fronts[greatest].pivots)
        greatest = c;
    const auto add_child = [&](int c) {
      for (std::size_t p = fronts[c].first_touched; p < fronts[c].end_touched; ++p)
        add(touched[p]);
    };
    if (greatest != -1)
      add_child(greatest);
    const auto sorted = static_cast<std::ptrdiff_t>(touched.size());
    for (int i = 0; i < f.children; ++i)
      if (const int c = children[f.first_child + i]; c != greatest)
        add_child(c);
    for (int k = f.first_node; k < f.end_node; ++k)
      for (int p = graph_start_[node_at[k]]; p < graph_start_[node_at[k] + 1]; ++p) {
        graph_[p] = rank_[graph_[p]]; // for neighbours()
        add(graph_[p]);
      }
    f.end_touched = touched.size();
    const auto begin = touched.begin() + static_cast<std::ptrdiff_t>(f.first_touched);
    std::sort(touched.begin() + sorted, touched.end());
    std::inplace_merge(begin, touched.begin() + sorted, touched.end());
    f.rows = f.pivots;
    for (auto p = begin; p != touched.end(); ++p)
      f.rows += width_at[*p];
  }
}

} // namespace sheet
