// SPDX-License-Identifier: GPL-3.0-or-later
// What the unknowns of a stage may not do. Held ones have a prescribed value: the assembly turns their rows into those
// of the unit matrix. Vertices that slide keep to a plane or a line: with P the projection on what is left to a vertex,
// forces become P f and blocks of the Hessian P_v H P_w, with a multiple of I - P on the diagonal, so that the matrix
// stays positive definite and its structure what it was.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

struct Slide {
  std::uint32_t vertex;
  Matrix3 free; // the projection on the directions that are left
};

struct Constraints {
  std::vector<char> held = {};              // one flag an unknown; empty: none is held
  std::vector<Slide> slides = {};           // of vertices that are not held along all axes
  std::vector<std::uint32_t> slide_of = {}; // of each vertex, or no_index; empty without slides

  // For one vertex: its slide, or null.
  [[nodiscard]] const Slide* slide(std::size_t vertex) const {
    return slide_of.empty() || slide_of[vertex] == no_index ? nullptr : &slides[slide_of[vertex]];
  }
  // Sets the slides of a sheet with that many vertices.
  void let_slide(std::vector<Slide> of, std::size_t vertices) {
    slides = std::move(of);
    slide_of.assign(slides.empty() ? 0 : vertices, no_index);
    for (std::uint32_t s = 0; s < slides.size(); ++s)
      slide_of[slides[s].vertex] = s;
  }
  // Takes away of forces or moves, in the order of the unknowns, what is not free.
  void project(Eigen::VectorXd& x) const {
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k] != 0)
        x[static_cast<Eigen::Index>(k)] = 0;
    for (const Slide& s : slides)
      x.segment<3>(3 * static_cast<Eigen::Index>(s.vertex)) =
          s.free * x.segment<3>(3 * static_cast<Eigen::Index>(s.vertex));
  }
};

} // namespace sheet
