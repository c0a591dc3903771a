// SPDX-License-Identifier: GPL-3.0-or-later
// Which volume each triangle of a sheet helps to enclose, where there are several, or not all triangles enclose one:
// the array "enclosure", place triangle, uint32, rule copy: 0 none, else the enclosure's number from 1. So a piece
// keeps its own through changes of the mesh, and shares it with what comes off.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet {

// Empty if the frame has none: all triangles enclose one volume. Throws Error (bad_input) where it is something else.
[[nodiscard]] std::span<const std::uint32_t> enclosures(const formats::Frame& frame);
// One number a triangle.
void put_enclosures(std::span<const std::uint32_t> numbers, formats::Frame& frame);
// The greatest number; 0 if there is none.
[[nodiscard]] std::uint32_t last_enclosure(const formats::Frame& frame);
// Those that there are, each once, ascending.
[[nodiscard]] std::vector<std::uint32_t> enclosure_numbers(const formats::Frame& frame);
// What the frame says of each enclosure's gas in the array of that name (formats/sheet.md), from the first one on;
// empty if it has none. Throws Error (bad_input) where it is something else.
[[nodiscard]] std::span<const double> of_enclosures(const formats::Frame& frame, std::string_view name);

} // namespace sheet
