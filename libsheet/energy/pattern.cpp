// SPDX-License-Identifier: GPL-3.0-or-later
// The map from element entries to matrix slots: counting sorts over pairs of nodes.
#include "libsheet/energy/pattern.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace sheet {

namespace {
constexpr std::size_t columns_at_once = 256;
constexpr int most_nodes = 6;     // of a stencil
constexpr std::size_t ahead = 48; // sources are asked for this early, as they lie all over the buffer
constexpr std::size_t line = 8;   // numbers in a cache line; the buffer has one more at its end

// The places of the blocks of each local node a and those b <= a before it, among an element's packed numbers: pairs of
// vertices first, then of an edge and a vertex, then of edges.
std::vector<std::uint32_t> packed_blocks(Stencil s) {
  std::vector<std::uint32_t> places;
  const int v = stencil_vertices(s), e = stencil_edges(s);
  const int edge_vertex = 9 * v * (v + 1) / 2, edges = edge_vertex + 3 * v * e;
  for (int a = 0; a < v + e; ++a)
    for (int b = 0; b <= a; ++b) {
      const int edge = a - v;
      const int place = a < v   ? 9 * (a * (a + 1) / 2 + b)
                        : b < v ? edge_vertex + 3 * (edge * v + b)
                                : edges + edge * (edge + 1) / 2 + (b - v);
      places.push_back(static_cast<std::uint32_t>(place));
    }
  return places;
}

// A block (rows x columns, by columns) on the free directions of its row and column nodes, which have a slide or none.
// What is not free gets the mean stiffness of the rest, so that scaling treats a vertex as one. Of a diagonal block the
// lower triangle counts.
void project(double* block, int rows, int columns, const Slide* row, const Slide* column, bool diagonal) {
  if (row == nullptr && column == nullptr)
    return;
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  Eigen::Map<Block> h(block, rows, columns);
  if (diagonal)
    for (int c = 1; c < columns; ++c)
      for (int r = 0; r < c; ++r)
        h(r, c) = h(c, r);
  if (row != nullptr)
    h = Block(row->free * h);
  if (column != nullptr)
    h = Block(h * column->free);
  if (!diagonal)
    return;
  const double rank = row->free.trace();
  const double stiffness = rank > 0.5 ? std::abs(h.trace()) / rank : 0;
  h += (stiffness > 0 ? stiffness : 1.0) * (Matrix3::Identity() - row->free);
}

} // namespace

// Every pair of nodes of an element, sorted by column (the node eliminated earlier), then row, then place in the
// buffer.
struct MatrixPattern::Pairs {
  struct Pair {
    std::uint32_t row, source; // rank of the row's node; place in the buffer
  };
  std::vector<std::uint32_t> start; // of each column, in elimination order
  std::vector<Pair> pairs;
};

MatrixPattern::MatrixPattern(std::size_t vertices, std::size_t edges, std::span<const ElementGroup> groups, int stride,
                             std::span<const std::uint32_t> order)
    : vertices_(vertices), stride_(stride), order_(order.begin(), order.end()) {
  number_columns(vertices + edges);
  tbb::parallel_invoke([&] { make_blocks(sorted_pairs(groups)); },
                       [&] {
                         note_reversed(groups);
                         place_gradient(groups);
                       });
}

void MatrixPattern::number_columns(std::size_t nodes) {
  rank_.resize(nodes);
  column_start_.resize(nodes + 1, 0);
  for (std::uint32_t k = 0; k < nodes; ++k) {
    rank_[order_[k]] = k;
    column_start_[k + 1] = column_start_[k] + static_cast<std::uint32_t>(width(order_[k]));
    for (int d = 0; d < width(order_[k]); ++d)
      permutation_.push_back(first_unknown(order_[k]) + static_cast<std::uint32_t>(d));
  }
}

void MatrixPattern::note_reversed(std::span<const ElementGroup> groups) {
  for (const ElementGroup& group : groups)
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::uint32_t* n = &group.nodes[i * static_cast<std::size_t>(group.width)];
      unsigned mask = 0;
      for (int a = 1, bit = 0; a < stencil_vertices(group.stencil); ++a)
        for (int b = 0; b < a; ++b, ++bit)
          mask |= static_cast<unsigned>(rank_[n[a]] < rank_[n[b]]) << bit;
      reversed_.push_back(static_cast<std::uint8_t>(mask));
    }
}

MatrixPattern::Pairs MatrixPattern::sorted_pairs(std::span<const ElementGroup> groups) const {
  using Pair = Pairs::Pair;
  const std::size_t nodes = order_.size();
  const auto each_pair = [&](auto&& visit) {
    for (const ElementGroup& group : groups) {
      const std::vector<std::uint32_t> block = packed_blocks(group.stencil);
      const auto size = static_cast<std::size_t>(packed_size(group.stencil));
      const std::uint32_t* n = group.nodes.data();
      auto base = static_cast<std::uint32_t>(group.first_hessian);
      for (std::size_t i = 0; i < group.size(); ++i, n += group.width, base += static_cast<std::uint32_t>(size)) {
        std::uint32_t rank[most_nodes];
        for (int a = 0, pair = 0; a < group.width; ++a) {
          rank[a] = rank_[n[a]];
          for (int b = 0; b <= a; ++b, ++pair)
            visit(std::min(rank[a], rank[b]), Pair{std::max(rank[a], rank[b]), base + block[pair]});
        }
      }
    }
  };
  Pairs sorted{std::vector<std::uint32_t>(nodes + 1, 0), {}};
  std::vector<std::uint32_t>& start = sorted.start;
  std::vector<Pair>& pairs = sorted.pairs;
  each_pair([&](std::uint32_t column, const Pair&) { ++start[column + 1]; });
  for (std::size_t k = 0; k < nodes; ++k)
    start[k + 1] += start[k];
  pairs.resize(start[nodes]);
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  each_pair([&](std::uint32_t column, const Pair& pair) { pairs[next[column]++] = pair; });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes, columns_at_once), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k)
      std::sort(pairs.begin() + start[k], pairs.begin() + start[k + 1],
                [](const Pair& p, const Pair& q) { return p.row != q.row ? p.row < q.row : p.source < q.source; });
  });
  return sorted;
}

void MatrixPattern::make_blocks(const Pairs& sorted) {
  const auto& [start, pairs] = sorted;
  const std::size_t nodes = order_.size();
  sources_.resize(pairs.size() + ahead);
  block_start_.assign(nodes + 1, 0);
  for (std::uint32_t k = 0; k < nodes; ++k) {
    std::uint32_t offset = 0;
    // A node without elements still has its diagonal.
    if (start[k] == start[k + 1]) {
      blocks_.push_back({order_[k], 0, start[k]});
      offset = static_cast<std::uint32_t>(width(order_[k]));
    }
    for (std::uint32_t p = start[k]; p < start[k + 1]; ++p) {
      sources_[p] = pairs[p].source;
      if (p == start[k] || pairs[p].row != pairs[p - 1].row) {
        blocks_.push_back({order_[pairs[p].row], offset, p});
        offset += static_cast<std::uint32_t>(width(order_[pairs[p].row]));
      }
    }
    block_start_[k + 1] = static_cast<std::uint32_t>(blocks_.size());
  }
  blocks_.push_back({0, 0, static_cast<std::uint32_t>(pairs.size())}); // the end of the last block's sources
}

SparseLower MatrixPattern::structure() const {
  SparseLower a;
  a.size = static_cast<int>(permutation_.size());
  a.starts.reserve(permutation_.size() + 1);
  a.starts.push_back(0);
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    const Block& last = blocks_[block_start_[k + 1] - 1];
    const int rows = static_cast<int>(last.offset) + width(last.row_node);
    for (int d = 0; d < width(order_[k]); ++d)
      a.starts.push_back(a.starts.back() + rows - d);
  }
  a.rows.resize(static_cast<std::size_t>(a.starts.back()));
  a.values.resize(a.rows.size());
  const auto list_rows = [&](std::uint32_t k) {
    for (int d = 0; d < width(order_[k]); ++d) {
      int* rows = &a.rows[static_cast<std::size_t>(a.starts[column_start_[k] + d])];
      for (std::uint32_t b = block_start_[k]; b < block_start_[k + 1]; ++b) {
        const std::uint32_t row = column_start_[rank_[blocks_[b].row_node]];
        for (int r = b == block_start_[k] ? d : 0; r < width(blocks_[b].row_node); ++r)
          *rows++ = static_cast<int>(row) + r;
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(order_.size()), columns_at_once),
                    [&](const auto& range) {
                      for (std::uint32_t k = range.begin(); k < range.end(); ++k)
                        list_rows(k);
                    });
  return a;
}

NodeGraph MatrixPattern::node_graph() const {
  NodeGraph graph;
  graph.first.assign(column_start_.begin(), column_start_.end());
  graph.start.reserve(order_.size() + 1);
  graph.start.push_back(0);
  graph.later.reserve(blocks_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::uint32_t b = block_start_[k] + 1; b < block_start_[k + 1]; ++b) // after the diagonal
      graph.later.push_back(static_cast<int>(rank_[blocks_[b].row_node]));
    graph.start.push_back(static_cast<int>(graph.later.size()));
  }
  return graph;
}

void MatrixPattern::place_gradient(std::span<const ElementGroup> groups) {
  const std::size_t nodes = order_.size();
  const auto each_node = [&](auto&& visit) {
    for (const ElementGroup& group : groups)
      for (std::size_t i = 0, n = group.size() * static_cast<std::size_t>(group.width), p = 0; i < n; ++i) {
        const std::uint32_t node = group.nodes[i];
        if (i % static_cast<std::size_t>(group.width) == 0)
          p = (group.first + i / static_cast<std::size_t>(group.width)) * static_cast<std::size_t>(stride_);
        visit(node, static_cast<std::uint32_t>(p));
        p += static_cast<std::size_t>(width(node));
      }
  };
  gradient_start_.assign(nodes + 1, 0);
  each_node([&](std::uint32_t node, std::uint32_t) { ++gradient_start_[node + 1]; });
  for (std::size_t n = 0; n < nodes; ++n)
    gradient_start_[n + 1] += gradient_start_[n];
  gradient_sources_.resize(gradient_start_[nodes]);
  std::vector<std::uint32_t> next(gradient_start_.begin(), gradient_start_.end() - 1);
  each_node([&](std::uint32_t node, std::uint32_t place) { gradient_sources_[next[node]++] = place; });
}

void MatrixPattern::pack(const ElementGroup& group, std::size_t element, const double* hessian, double* packed) const {
  const int vertices = stencil_vertices(group.stencil), edges = stencil_edges(group.stencil);
  const unsigned reversed = reversed_[group.first + element];
  for (int a = 0, bit = 0; a < vertices; ++a)
    for (int b = 0; b <= a; ++b) {
      const bool swapped = b < a && (reversed >> bit++ & 1) != 0;
      const double* from = hessian + 3 * (b * stride_ + a);
      const int along = swapped ? stride_ : 1, across = swapped ? 1 : stride_;
      for (int c = 0; c < 3; ++c, from += across, packed += 3)
        packed[0] = from[0], packed[1] = from[along], packed[2] = from[2 * along];
    }
  for (int e = 0; e < edges; ++e)
    for (int k = 0; k < 3 * vertices; ++k)
      *packed++ = hessian[k * stride_ + 3 * vertices + e];
  for (int e = 0; e < edges; ++e)
    for (int f = 0; f <= e; ++f)
      *packed++ = hessian[(3 * vertices + f) * stride_ + 3 * vertices + e];
}

void MatrixPattern::gather_gradient(const double* buffer, Eigen::VectorXd& gradient) const {
  gradient.resize(static_cast<Eigen::Index>(permutation_.size()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order_.size(), 4 * columns_at_once), [&](const auto& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      double sum[3] = {0, 0, 0};
      const int w = width(static_cast<std::uint32_t>(n));
      for (std::uint32_t s = gradient_start_[n]; s < gradient_start_[n + 1]; ++s)
        for (int d = 0; d < w; ++d)
          sum[d] += buffer[gradient_sources_[s] + static_cast<std::size_t>(d)];
      for (int d = 0; d < w; ++d)
        gradient[first_unknown(static_cast<std::uint32_t>(n)) + d] = sum[d];
    }
  });
}

void MatrixPattern::gather_matrix(const double* buffer, const Constraints& constraints, SparseLower& matrix) const {
  const std::vector<char>& held = constraints.held;
  const auto slide = [&](std::uint32_t node) { return node < vertices_ ? constraints.slide(node) : nullptr; };
  const auto gather = [&](std::uint32_t k) {
    const std::uint32_t column_node = order_[k];
    const int columns = width(column_node);
    const int* starts = &matrix.starts[column_start_[k]];
    for (std::uint32_t b = block_start_[k]; b < block_start_[k + 1]; ++b) {
      const Block& block = blocks_[b];
      const int rows = width(block.row_node);
      double sum[9] = {}; // by columns
      const auto add = [&]<int Size>(std::integral_constant<int, Size>) {
        for (std::uint32_t s = block.first_source; s < blocks_[b + 1].first_source; ++s) {
          const double* next = buffer + sources_[s + ahead]; // a block may lie in two cache lines
          __builtin_prefetch(next);
          __builtin_prefetch(next + line);
          for (int at = 0; at < Size; ++at)
            sum[at] += buffer[sources_[s] + static_cast<std::size_t>(at)];
        }
      };
      if (rows * columns == 9)
        add(std::integral_constant<int, 9>());
      else if (rows * columns == 3)
        add(std::integral_constant<int, 3>());
      else
        add(std::integral_constant<int, 1>());
      const bool diagonal = block.row_node == column_node;
      if (!constraints.slides.empty())
        project(sum, rows, columns, slide(block.row_node), slide(column_node), diagonal);
      if (!held.empty())
        for (int c = 0; c < columns; ++c)
          for (int r = 0; r < rows; ++r)
            if (held[first_unknown(block.row_node) + r] || held[first_unknown(column_node) + c])
              sum[rows * c + r] = diagonal && r == c ? 1 : 0;
      for (int c = 0; c < columns; ++c) {
        // Column c of the node lists its rows from its own diagonal on.
        double* to = &matrix.values[static_cast<std::size_t>(starts[c]) + block.offset] - (diagonal ? 0 : c);
        for (int r = diagonal ? c : 0; r < rows; ++r)
          *to++ = sum[rows * c + r];
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(order_.size()), columns_at_once),
                    [&](const auto& range) {
                      for (std::uint32_t k = range.begin(); k < range.end(); ++k)
                        gather(k);
                    });
}

Vector3 MatrixPattern::sum_of_blocks(const SparseLower& matrix) const {
  // In pieces that do not depend on the number of threads, each added up in its order.
  std::vector<Vector3> sums((order_.size() + columns_at_once - 1) / columns_at_once, Vector3::Zero());
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t piece) {
    const auto end = static_cast<std::uint32_t>(std::min(order_.size(), (piece + 1) * columns_at_once));
    for (auto k = static_cast<std::uint32_t>(piece * columns_at_once); k < end; ++k) {
      if (order_[k] >= vertices_)
        continue;
      for (std::uint32_t b = block_start_[k]; b < block_start_[k + 1]; ++b) {
        if (blocks_[b].row_node >= vertices_)
          continue;
        const double times = b == block_start_[k] ? 1 : 2; // the other half is not stored
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
          const auto diagonal = static_cast<std::size_t>(matrix.starts[column_start_[k] + axis]);
          sums[piece][axis] += times * matrix.values[diagonal + blocks_[b].offset];
        }
      }
    }
  });
  Vector3 sum = Vector3::Zero();
  for (const Vector3& s : sums)
    sum += s;
  return sum;
}

} // namespace sheet
