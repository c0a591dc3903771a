// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes for tests: an icosphere, disks and rectangles, irregular on request. Deterministic.
#pragma once
#include <cstdint>

#include "libsheet/energy/state.h"

namespace sheet::test {

struct Mesh {
  std::vector<Vector3> positions;
  std::vector<Corners> triangles;
};

// Radius 1, the icosahedron's edges cut into 2^level; normals outwards. 10 * 4^level + 2 vertices.
[[nodiscard]] Mesh icosphere(int level);
// Rings of 6k vertices; radius r, in the plane z = 0. shift: interior vertices moved at random by up to this part of an
// edge.
[[nodiscard]] Mesh disk(double radius, int rings, double shift);
// [0, lx] x [0, ly] in the plane z = 0, nx x ny cells cut into triangles, interior vertices moved as above.
[[nodiscard]] Mesh rectangle(double lx, double ly, int nx, int ny, double shift);

// A state at rest whose thickness is h [m] everywhere.
[[nodiscard]] State at_rest(const Mesh& mesh, double thickness);

} // namespace sheet::test
