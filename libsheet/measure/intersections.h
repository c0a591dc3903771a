// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a sheet intersect: decided exactly on the vertices' coordinates as they are (CGAL's exact
// predicates), at any scale. Triangles are closed sets, so touching counts; neighbours may meet in what they share,
// their common vertex or edge, and in nothing else.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet {

// Precondition of both: `usable` triangles name three different vertices in range at finite positions; one flag a
// triangle. The others are passed over.

// Triangles whose corners lie on a line, ascending.
[[nodiscard]] std::vector<std::uint64_t> find_degenerate(std::span<const Eigen::Vector3d> positions,
                                                         std::span<const Corners> triangles,
                                                         const std::vector<bool>& usable);

struct Intersections {
  std::uint64_t count = 0; // of intersecting pairs
  std::vector<std::pair<std::uint64_t, std::uint64_t>>
      pairs; // the first `limit` of them in ascending order, first < second
};

// Degenerate triangles must not be usable. Two triangles at the same three vertices are not a pair here: they are
// duplicates.
[[nodiscard]] Intersections find_intersections(std::span<const Eigen::Vector3d> positions,
                                               std::span<const Corners> triangles, const std::vector<bool>& usable,
                                               std::size_t limit);

} // namespace sheet
