// SPDX-License-Identifier: GPL-3.0-or-later
// In which order a mesh's slots leave it.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/remesh/mesh.h"

namespace sheet::remesh {

struct Numbering {
  std::vector<std::uint32_t> vertices, triangles; // slots in use, in the order of the frame to be
  std::vector<std::uint32_t> number;              // of each vertex slot in that order; none: not in use
};
// That of the slots: what stays keeps its order, what is new follows. Meshes above 32,768 vertices whose triangles'
// corners lie more than a twentieth of all numbers apart, on average, no longer pass through the processor's caches;
// they are numbered anew along a curve that fills space [Morton 1966], triangles by their smallest corner.
[[nodiscard]] Numbering numbering(const Mesh& mesh, std::span<const Vector3> positions);

} // namespace sheet::remesh
