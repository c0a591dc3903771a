// SPDX-License-Identifier: GPL-3.0-or-later
// A fill-reducing order of the vertices of a graph, in which the first is to be eliminated first. Of the graph alone,
// not of positions, so that a resumed run has the same one.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sheet {

using GraphEdge = std::array<std::uint32_t, 2>; // (lower, higher) vertex

// Below 20,000 vertices by minimum degree (CSYMAMD); above, nested dissection [George 1973] with METIS's separators
// down to parts of that size, and to parts of 1,000 where layers that touch make a dear factor, for so many unknowns at
// each vertex. graph: each edge once, by its lower vertex, then the higher.
[[nodiscard]] std::vector<std::uint32_t> elimination_order(std::size_t vertices, std::span<const GraphEdge> graph,
                                                           int unknowns = 1);

} // namespace sheet
