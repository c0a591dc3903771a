// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points of a closed triangle mesh, through a binary tree of boxes.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "libsheet/solid/distance.h"
#include "libsheet/solid/mesh.h"

namespace sheet::solid {

class TriangleTree {
public:
  // The surface must be closed and not intersect itself. Its boxes split at the median along their longest side.
  explicit TriangleTree(SolidSurface surface);

  [[nodiscard]] const SolidSurface& surface() const { return surface_; }
  [[nodiscard]] const Box3& bounds() const { return nodes_.front().box; }

  // Signed distance and outward normal. The sign is that of the angle-weighted normal at the nearest point, which is
  // right for every closed mesh [Baerentzen, Aanaes 2005]. Nothing where the surface is `within` [m] away or more.
  [[nodiscard]] std::optional<Near> nearest(const Vector3& x, double within) const;

  // The least distance between the mesh and a triangle, where it is below `within`; else `within`. Zero where they
  // intersect. `point`: the triangle's point nearest to the mesh, its normal the direction from the mesh.
  struct Pair {
    double distance;
    TrianglePoint point;
  };
  [[nodiscard]] Pair nearest(const Triangle3& triangle, double within) const;

  // As SolidDistance::first_hit; what is near the point is the part of the mesh that it hits.
  [[nodiscard]] std::optional<TriangleHit> first_hit(const MovingTriangle& triangle, double clearance,
                                                     double tolerance) const;

private:
  struct Node {
    Box3 box;
    std::uint32_t first; // a leaf's first triangle, else the second child; the first child follows its parent
    std::uint32_t count; // of a leaf's triangles, else 0
  };
  void build(std::uint32_t first, std::uint32_t last, std::vector<Vector3>& centers);

  SolidSurface surface_;
  std::vector<std::uint32_t> order_; // triangles, leaf after leaf
  std::vector<Triangle3> corners_;   // theirs, in that order
  std::vector<Node> nodes_;
  std::vector<Vector3> face_normals_, vertex_normals_;
  std::vector<std::array<Vector3, 3>> edge_normals_; // of each triangle, edge i opposite corner i
};

} // namespace sheet::solid
