// SPDX-License-Identifier: GPL-3.0-or-later
// Directors of a mesh that is being edited: a unit vector for each side of a triangle, the same for both sides of an
// edge. Sides within a patch that is made anew take theirs at the middle of the edge from the linear field that the
// three directors of an old triangle make there (that of Crouzeix and Raviart 1973); sides that stay keep theirs.
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/overlap.h"
#include "libsheet/remesh/edit.h"

namespace sheet::remesh {

class SideDirectors {
public:
  // Takes them from the frame; empty if it has none, and then everything else costs nothing.
  explicit SideDirectors(const formats::Frame& frame);
  [[nodiscard]] bool empty() const { return directors_.empty(); }

  // Finds those of an edit's new triangles while the mesh is the old one. The triangles in the patch's plane, old and
  // new; positions with the edit's vertex where it will be.
  void prepare(const Mesh& mesh, const Edit& edit, std::span<const FlatTriangle> old_flat,
               std::span<const FlatTriangle> new_flat, const std::vector<Vector3>& positions);
  // The new triangles have got these slots.
  void commit(std::span<const std::uint32_t> slots);

  // Into a frame with the edited mesh; kept: the slots of its triangles in their order.
  void put(std::span<const std::uint32_t> kept, formats::Frame& frame) const;

private:
  [[nodiscard]] Vector3 interpolated(const Edit& edit, std::span<const FlatTriangle> old_flat,
                                     const Eigen::Vector2d& x) const;

  std::vector<Vector3> directors_; // of side 3 t + i, from corner i to corner i + 1; zero: not known
  std::vector<Vector3> found_;     // of the sides of the added triangles
};

} // namespace sheet::remesh
