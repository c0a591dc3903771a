// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices taken apart: the corners at a vertex that reach each other across edges that hold are a fan, and each fan
// gets a vertex of its own.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"

namespace sheet::flow {

struct Fans {
  std::vector<Corners> triangles;        // by new vertices; all of them, dropped ones too
  std::vector<std::uint32_t> old_vertex; // of each new one
  std::vector<std::uint32_t> fan_count;  // of each old one; 0: it has no triangle
};

// The first fan of a vertex (that of its first triangle) keeps its number, the others follow behind all old vertices,
// in the order of their first corners. cut[e]: edge e does not hold.
[[nodiscard]] Fans take_apart(const Connectivity& mesh, const std::vector<bool>& cut);

} // namespace sheet::flow
