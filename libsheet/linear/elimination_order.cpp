// SPDX-License-Identifier: GPL-3.0-or-later
// Most sheets need CSYMAMD alone, which is linked: loading CHOLMOD, METIS and OpenBLAS takes 4 ms, as long as four
// steps of a sheet of 600 vertices.
#include "libsheet/linear/elimination_order.h"

#include <cstdlib>

#include <ccolamd.h>

#include "libsheet/base/error.h"
#include "libsheet/linear/nested_dissection.h"
#include "libsheet/linear/sparse_lower.h"

namespace sheet {

namespace {

// Parts of fewer vertices are not dissected: METIS takes longer for them than the minimum degree does, and the
// factorisation is as fast (docs/speed-error.md).
constexpr std::size_t least_dissected = 20000;
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

} // namespace

std::vector<std::uint32_t> elimination_order(std::size_t vertices, std::span<const GraphEdge> graph) {
  SparseLower a = pattern_of(vertices, graph);
  std::vector<int> order(vertices + 1); // one more, as CSYMAMD wants it
  if (vertices >= least_dissected) {
    nested_dissection(a, least_dissected, order);
  } else {
    int statistics[CCOLAMD_STATS] = {};
    if (csymamd(a.size, a.rows.data(), a.starts.data(), order.data(), nullptr, statistics, std::calloc, std::free,
                nullptr, lower_triangle) == 0)
      fail(ExitCode::internal, "no order found for {} vertices (status {})", vertices, statistics[CCOLAMD_STATUS]);
  }
  return {order.begin(), order.end() - 1};
}

} // namespace sheet
