// SPDX-License-Identifier: GPL-3.0-or-later
// Most sheets need CSYMAMD alone, which is linked: loading CHOLMOD, METIS and OpenBLAS takes 4 ms, as long as four
// steps of a sheet of 600 vertices.
#include "libsheet/linear/elimination_order.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include <ccolamd.h>

#include "libsheet/base/error.h"
#include "libsheet/linear/nested_dissection.h"
#include "libsheet/linear/sparse_lower.h"
#include "libsheet/linear/supernodes.h"

namespace sheet {

namespace {

// Parts of fewer vertices are not dissected: METIS takes longer for them than the minimum degree does, and the
// factorisation is as fast (docs/speed-error.md).
constexpr std::size_t least_dissected = 20000;
// Where layers touch the graph is not that of a surface, and minimum degree leaves up to twice the work. Parts of that
// size are dissected where the factorisation would take longer than that, of graphs of more edges a vertex than those
// of surfaces have.
constexpr std::size_t least_of_pile = 1000;
constexpr double seconds_of_pile = 0.8, edges_of_pile = 4;
constexpr int lower_triangle = -1;

// The graph as the lower triangle of a matrix without its diagonal and values.
SparseLower pattern_of(std::size_t vertices, std::span<const GraphEdge> graph) {
  SparseLower a;
  a.size = static_cast<int>(vertices);
  a.starts.assign(vertices + 1, 0);
  for (const GraphEdge& e : graph)
    ++a.starts[e[0] + 1];
  for (std::size_t v = 0; v < vertices; ++v)
    a.starts[v + 1] += a.starts[v];
  a.rows.reserve(graph.size() + 1);
  for (const GraphEdge& e : graph)
    a.rows.push_back(static_cast<int>(e[1]));
  if (graph.empty())
    a.rows.push_back(0);
  return a;
}

void minimum_degree(SparseLower& a, std::vector<int>& order) {
  int statistics[CCOLAMD_STATS] = {};
  if (csymamd(a.size, a.rows.data(), a.starts.data(), order.data(), nullptr, statistics, std::calloc, std::free,
              nullptr, lower_triangle) == 0)
    fail(ExitCode::internal, "no order found for {} vertices (status {})", a.size, statistics[CCOLAMD_STATUS]);
}

// Of the matrix with `unknowns` at each vertex, in that order, by the model of the machine.
double seconds_of_factor(std::size_t vertices, std::span<const GraphEdge> graph, std::span<const int> order,
                         int unknowns) {
  std::vector<int> rank(vertices);
  NodeGraph ordered;
  ordered.first.push_back(0);
  for (std::size_t k = 0; k < vertices; ++k) {
    rank[order[k]] = static_cast<int>(k);
    ordered.first.push_back(ordered.first.back() + unknowns);
  }
  const auto ranks = [&](const GraphEdge& e) { return std::minmax({rank[e[0]], rank[e[1]]}); };
  ordered.start.assign(vertices + 1, 0);
  for (const GraphEdge& e : graph)
    ++ordered.start[ranks(e).first + 1];
  std::partial_sum(ordered.start.begin(), ordered.start.end(), ordered.start.begin());
  std::vector<int> next(ordered.start.begin(), ordered.start.end() - 1);
  ordered.later.resize(graph.size());
  for (const GraphEdge& e : graph)
    ordered.later[next[ranks(e).first]++] = ranks(e).second;
  for (std::size_t k = 0; k < vertices; ++k)
    std::sort(ordered.later.begin() + ordered.start[k], ordered.later.begin() + ordered.start[k + 1]);
  Supernodes supernodes;
  supernodes.analyze(ordered);
  return supernodes.seconds();
}

} // namespace

std::vector<std::uint32_t> elimination_order(std::size_t vertices, std::span<const GraphEdge> graph, int unknowns) {
  SparseLower a = pattern_of(vertices, graph);
  std::vector<int> order(vertices + 1); // one more, as CSYMAMD wants it
  if (vertices >= least_dissected)
    nested_dissection(a, least_dissected, order);
  else
    minimum_degree(a, order);
  const bool pile = static_cast<double>(graph.size()) > edges_of_pile * static_cast<double>(vertices);
  if (pile && seconds_of_factor(vertices, graph, order, unknowns) > seconds_of_pile)
    nested_dissection(a, least_of_pile, order);
  return {order.begin(), order.end() - 1};
}

} // namespace sheet
