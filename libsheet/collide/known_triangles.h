// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of which it is known that no two of them intersect: those of a sheet that was made safe. In a later sheet
// they are found again by the places of their corners, bit for bit, whatever their numbers and whatever else has
// changed; pairs of two of them need no test.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {

class KnownTriangles {
public:
  // From now on those of this sheet are known, but for those that are, or were at the start of the step, so thin that
  // the exact test may pass them over. `start` and `end` of the step: one place a vertex.
  void remember(std::span<const Corners> triangles, std::span<const Vector3> start, std::span<const Vector3> end);
  void forget();

  // A flag a triangle: 0 where it is known. Two triangles with flag 0 have a corner in common if, and only if, they had
  // it when they became known: places at which more than one vertex stands, then or now, are not found again.
  [[nodiscard]] std::vector<std::uint8_t> unknown(std::span<const Corners> triangles,
                                                  std::span<const Vector3> positions) const;

private:
  std::vector<std::uint32_t> find_again(std::span<const Vector3> positions) const;

  std::vector<Vector3> positions_;
  std::vector<Corners> triangles_;   // corners ascending, by their first ones
  std::vector<std::uint32_t> first_; // of each vertex: the first triangle with it as the least corner
  std::vector<std::uint32_t> table_; // of vertices, by a hash of their places
};

} // namespace sheet::collide
