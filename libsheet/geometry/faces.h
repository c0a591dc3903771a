// SPDX-License-Identifier: GPL-3.0-or-later
// What the faces of a sheet have beyond twice the area of its middle surface, in closed form from what triangles carry:
//   rim    c h l           the side of a rim l long, h = V/A of its triangle. c = π/4: half-round, carrying its own
//   volume,
//                          as a strip w wide is a stadium whose round ends reach π h/8 less far out than the strip
//                          does. Where triangles are narrow, the slopes behind the rim make it round themselves, and
//                          what is left is flat: with z = 2 A/(l h), the triangle's height over h, c = π/4 + (1 - π/4)
//                          (1 - 8 z/π)² for z < π/8
//   slope  2 (√(P² + Q²) - P),   P = 2 (A1 + A2)/3,   Q = l (h1 - h2)/2
//                          the two faces between the middles of two triangles, of which each rises or falls by half of
//                          the difference over the distance P/l across their edge; for small slopes ∫ |∇h|²/4 dA
//   thread  (1 + ε (h1 + h2)/(2 l)) times the slope's where the common edge leads from rim to rim
// (That is so where triangles are near to equilateral; in right-angled ones of a grid it is 0.83 to 1.5 of it, by the
// direction. Weights that are right in any triangle, cotangents between the medians, vanish or change sign at the short
// sides of needles, and sheets then fold into needles.)
// A thread of one row of triangles, w = π h/4 wide, whose section varies along it has the curvature of the round one
// by that factor: per length and (dr/dx)² the round one has π r, half of it, of the cylinder that it is. Of the
// strip's, slopes of faces give π r/2 and the slant of its rims π³ r/32; what is missing is that of round rims of
// varying thickness, c h √(1 + β (dh/dx)²) along each, β = 1/4 - (π/8)², written with the jumps of h from triangle to
// triangle: of one row of near to equilateral ones ε = 2 π β/√3. A strip is then at rest with the section and the
// energy of the round thread (one row of triangles at w = π h/4, exactly; any number within 0.5 %, where c = π/4 alone
// would be 5 % low in 20), and a layer's faces level. On a wall, or on another layer, one face carries the whole slope,
// √(P² + 4 Q²) - P, between layers none; what the rim costs on a wall is the contact angle's.
#pragma once
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// c of a rim's side and, as derivatives by ln z, z c' and z² c''.
struct RimSide {
  explicit RimSide(double z) {
    constexpr double resolved = std::numbers::pi / 8, rest = 1 - std::numbers::pi / 4;
    if (const double x = z / resolved; x < 1) {
      c += rest * (1 - x) * (1 - x);
      c1 = -2 * rest * x * (1 - x);
      c2 = 2 * rest * x * x;
    }
  }
  double c = std::numbers::pi / 4, c1 = 0, c2 = 0;
};

// ε above.
inline constexpr double thread_slope =
    2 * std::numbers::pi * (0.25 - std::numbers::pi * std::numbers::pi / 64) / std::numbers::sqrt3;

// √(p² + q²) - p for p > 0, without cancellation.
[[nodiscard]] inline double slant(double p, double q) { return q * q / (std::sqrt(p * p + q * q) + p); }

// Which faces a sheet has.
struct FreeFaces {
  std::vector<double> rims;   // of each edge: the part of it that is a free rim; 0 within the sheet
  std::vector<double> closed; // of each vertex: how many of its two faces lie on something, 0 to 2; empty: none does
};

// All rims free, no face on anything.
[[nodiscard]] FreeFaces all_free(const Connectivity& mesh);

// An inner edge, its vertices, those opposite it (of edge_triangles, in that order), in which parts it has two free
// faces and one, and to which part it leads from one free rim to another.
struct SlopedEdge {
  std::uint32_t edge = 0;
  std::array<std::uint32_t, 4> vertices{};
  double two_faces = 1, one_face = 0, of_thread = 0;
};

// Slopes of the thickness that count.
struct LeastSlope {
  double free = 0, on_something = 0; // where an end of the edge lies on something, with a face that is free, the second
};

// Inner edges at which the thickness is not even, the slope being above `least`, and those that end on a free rim.
[[nodiscard]] std::vector<SlopedEdge> sloped_edges(const Connectivity& mesh, std::span<const Vector3> positions,
                                                   std::span<const double> volumes, const FreeFaces& faces,
                                                   const LeastSlope& least);

// The area that all of them have beyond twice that of the middle surface [m²]; of such factors of the triangles, their
// sum over it, between two triangles with the mean of both.
[[nodiscard]] double extra_area(const Connectivity& mesh, std::span<const Vector3> positions,
                                std::span<const double> volumes, const FreeFaces& faces,
                                std::span<const double> factors = {});

} // namespace sheet
