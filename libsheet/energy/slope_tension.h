// SPDX-License-Identifier: GPL-3.0-or-later
// Surface tension of faces that slope, where the thickness differs between two triangles (geometry/faces.h):
//   W = 2 b γ (√(P² + Q²) - P) + c γ (√(P² + 4 Q²) - P),   P = 2 (A1 + A2)/3,   Q = l (h1 - h2)/2,
// h = V/A, l the length of the common edge, b and c the parts of the four vertices with two free faces and with one, as
// on walls and other layers, times 1 + ε (h1 + h2)/(2 l) where the edge is one of a thread. What lies between two walls
// has no free face there. An element is an inner edge: its two vertices, then those opposite it.
#pragma once
#include "libsheet/energy/element.h"
#include "libsheet/geometry/faces.h"

namespace sheet {

class SlopeTension {
public:
  static constexpr Stencil stencil = Stencil::four;
  static constexpr Kind kind = Kind::elastic;
  explicit SlopeTension(std::vector<SlopedEdge> edges) : edges_(std::move(edges)) {}
  [[nodiscard]] const char* name() const { return "slope tension"; }
  [[nodiscard]] std::size_t size() const { return edges_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return edges_[i].vertices; }
  void begin(const Stage& stage);
  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const;
  double gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const;
  // The positive form is that of √(P² + Q²) as a norm of (P, Q), without the second derivatives of the two.
  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const;

private:
  struct Loads {
    std::array<double, 2> volumes;  // of the two triangles [m³]
    std::array<double, 2> tensions; // of √(P² + Q²) - P, of √(P² + 4 Q²) - P [N/m]
    double thread;                  // ε, so far as the edge is one of a thread
  };

  std::vector<SlopedEdge> edges_;
  std::vector<Loads> loads_;
};

} // namespace sheet
