// SPDX-License-Identifier: GPL-3.0-or-later
// What the faces of a sheet have beyond twice the area of its middle surface, in closed form from what triangles carry:
//   rim    (π/4) h l       the side of a half-round rim that carries its own volume, l long, h = V/A of its triangle:
//                          a strip w wide is a stadium, whose round ends reach π h/8 less far out than the strip does
//   slope  2 (√(P² + Q²) - P),   P = 2 (A1 + A2)/3,   Q = l (h1 - h2)/2
//                          the two faces between the middles of two triangles, of which each rises or falls by half of
//                          the difference over the distance P/l across their edge; for small slopes ∫ |∇h|²/4 dA
// (That is so where triangles are near to equilateral; in right-angled ones of a grid it is 0.83 to 1.5 of it, by the
// direction. Weights that are right in any triangle, cotangents between the medians, vanish or change sign at the short
// sides of needles, and sheets then fold into needles.)
// A strip is then at rest with the section and the energy of the round thread, w = π h/4, and a layer's faces level.
// On a wall one face carries the whole slope, √(P² + 4 Q²) - P, and what the rim costs is the contact angle's.
#pragma once
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// Round, over flat: of the side of a rim.
inline constexpr double rim_roundness = std::numbers::pi / 4;

// √(p² + q²) - p for p > 0, without cancellation.
[[nodiscard]] inline double slant(double p, double q) { return q * q / (std::sqrt(p * p + q * q) + p); }

// Which faces a sheet has.
struct FreeFaces {
  std::vector<double> rims;  // of each edge: the part of it that is a free rim; 0 within the sheet
  std::vector<char> on_wall; // of each vertex: whether it touches a wall; empty: none does

  // Of the vertices.
  [[nodiscard]] double part_on_wall(std::span<const std::uint32_t> vertices) const;
};

// All rims free, no wall.
[[nodiscard]] FreeFaces all_free(const Connectivity& mesh);

// An inner edge, its vertices, those opposite it (of edge_triangles, in that order), and which part of it is on a wall.
struct SlopedEdge {
  std::uint32_t edge = 0;
  std::array<std::uint32_t, 4> vertices{};
  double on_wall = 0;
};

// Inner edges at which the thickness is not even, the slope being above `least`, and those that end on a free rim.
[[nodiscard]] std::vector<SlopedEdge> sloped_edges(const Connectivity& mesh, std::span<const Vector3> positions,
                                                   std::span<const double> volumes, const FreeFaces& faces,
                                                   double least);

// The area that all of them have beyond twice that of the middle surface [m²].
[[nodiscard]] double extra_area(const Connectivity& mesh, std::span<const Vector3> positions,
                                std::span<const double> volumes, const FreeFaces& faces);

} // namespace sheet
