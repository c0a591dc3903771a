// SPDX-License-Identifier: GPL-3.0-or-later
// Which edges of a thin sheet part. The paper separates every edge whose triangles are thinner than a threshold [Batty
// et al. 2012, section 4, Tearing], which leaves dust; here the same edges are candidates, and are cut, the thinnest
// first, only where
//   - a crack opens: an edge with an end on a border, or two edges that meet inside the sheet. (One edge inside a sheet
//     opens nothing: its triangles hang together round both of its ends.)
//   - no triangle gets more than one open side, or two where the cut joins two borders; none gets two sides of one cut
//   - no crumb comes off, a piece of fewer triangles than `crumb`; or, where crumbs may be dropped, one that is held
//   - the crack can open: not both ends of the edge are held by the same thing; none is in the inlet
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"

namespace sheet::flow {

inline constexpr std::size_t crumb = 8;

struct TearInput {
  const Connectivity& mesh;               // without pinched vertices
  std::span<const double> volumes, areas; // of the triangles [m³], [m²]
  double below = 0;                       // thickness [m]
  bool drop_crumbs = false;
  std::vector<bool> pierced = {}; // triangles that count as thin, however thick; empty: none
  // In each list, vertices whose bits have one in common are held by the same thing.
  std::vector<std::vector<std::uint64_t>> grips = {};
  std::vector<bool> whole = {}; // vertices whose edges are never cut; empty: none
};

struct TearCuts {
  std::vector<bool> cut;     // edges
  std::vector<bool> dropped; // triangles, those of crumbs
  std::size_t edges = 0;     // cut
  std::size_t vetoed = 0;    // edges that would part, but for a crumb
};

[[nodiscard]] TearCuts find_cuts(const TearInput& input);

} // namespace sheet::flow
