// SPDX-License-Identifier: GPL-3.0-or-later
// What all shapes ask of their numbers, and how many segments a length gets.
#pragma once
#include <cstdint>

#include "libsheet/shape/shapes.h"

namespace sheet {

// Fails unless the length is positive and finite. `shape` and `what` name it in the message.
void check_length(const char* shape, const char* what, double length);

// Fails unless the edge length is positive, at most `largest` (what the shape has room for) and the mesh of that area
// stays below most_triangles.
void check_edge_length(const char* shape, double edge_length, double largest, double area);

// The explicit segments, checked, or nothing. `least` is the smallest number along the first and the second direction,
// `triangles` a product of constants: the mesh has triangles * first * second triangles.
[[nodiscard]] std::optional<std::array<std::uint32_t, 2>> explicit_segments(const char* shape,
                                                                            const MeshOptions& options,
                                                                            std::array<std::uint32_t, 2> least,
                                                                            double triangles = 2.0);

// length / step, rounded, at least `least`; to an even number if asked for.
[[nodiscard]] std::uint32_t segments_of(double length, double step, std::uint32_t least = 1);
[[nodiscard]] std::uint32_t even_segments_of(double length, double step, std::uint32_t least = 4);

// Leg of right triangles whose mean edge is 1: two legs and a diagonal for every square.
constexpr double right_leg = 3.0 / (2.0 + 1.41421356237309505);
// Distance of rows of equilateral triangles of edge 1.
constexpr double row_height = 0.86602540378443865;

} // namespace sheet
