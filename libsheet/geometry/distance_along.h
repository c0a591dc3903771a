// SPDX-License-Identifier: GPL-3.0-or-later
// How far two points of a triangle mesh are from each other along it, as far as a bound. Lengths in any unit.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"

namespace sheet {

// A vertex, or a place on an edge or in a triangle, which are named by their vertices.
struct MeshPoint {
  std::span<const std::uint32_t> vertices;
  Vector3 place;
};

class DistanceAlong {
public:
  // `mesh` must outlive it.
  explicit DistanceAlong(const Connectivity& mesh);

  // True if a way of at most `limit` leads from one point to the other along the mesh. Distances pass from two corners
  // of a triangle to the third as in the plane, from the image of the source there, or along a side where the straight
  // line would leave the edge between them [Kimmel and Sethian 1998; Novotni and Klein 2002], until none falls any
  // more: exact where the mesh is flat, or can be unfolded, and the way straight (an eighth of an edge too long at most
  // where only what is farther than the limit would tell); else of the order of an edge too long or too short. Vertices
  // from which `to` is out of reach in a straight line, and more than an edge, are not gone on from. `to`: a vertex or
  // a place on an edge.
  [[nodiscard]] bool within(std::span<const Vector3> positions, const MeshPoint& from, const MeshPoint& to,
                            double limit) const;

private:
  const Connectivity& mesh_;
  std::vector<std::uint32_t> begin_, around_; // the triangles of each vertex
};

} // namespace sheet
