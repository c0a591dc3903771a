// SPDX-License-Identifier: GPL-3.0-or-later
// A frame of the stream seen as a sheet: typed access to its standard arrays (formats/sheet.md, section 5). SI units.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// A new frame at rest at time 0, its arrays in the standard order. `volumes` [m³] one a triangle.
[[nodiscard]] formats::Frame make_frame(std::span<const Eigen::Vector3d> positions, std::span<const Corners> triangles,
                                        std::span<const double> volumes);

[[nodiscard]] std::span<Eigen::Vector3d> positions(formats::Frame& frame); // [m]
[[nodiscard]] std::span<const Eigen::Vector3d> positions(const formats::Frame& frame);
[[nodiscard]] std::span<const Corners> triangles(const formats::Frame& frame);
[[nodiscard]] std::span<double> volumes(formats::Frame& frame); // [m³]
[[nodiscard]] std::span<const double> volumes(const formats::Frame& frame);
// Of each triangle [K]; empty if the frame has none.
[[nodiscard]] std::span<const double> temperatures(const formats::Frame& frame);
// Adds or replaces them.
void put_temperatures(std::span<const double> temperatures, formats::Frame& frame);
// Velocities [m/s]; a frame without them gets zeros.
[[nodiscard]] std::span<Eigen::Vector3d> velocities(formats::Frame& frame);
// Empty if the frame has none: it is at rest.
[[nodiscard]] std::span<const Eigen::Vector3d> velocities(const formats::Frame& frame);
// One of the arrays of bits a vertex: hold, touch, inlet. Empty if the frame has none of that name.
[[nodiscard]] std::span<const std::uint64_t> masks(const formats::Frame& frame, std::string_view name);
// Bit i: held by the scene's i-th [[hold]]. Empty if the frame has no holds.
[[nodiscard]] inline std::span<const std::uint64_t> holds(const formats::Frame& frame) { return masks(frame, "hold"); }
// Adds or replaces one; all bits are 0.
[[nodiscard]] std::span<std::uint64_t> put_masks(formats::Frame& frame, std::string_view name);

// The array touch: for each vertex the first of the scene's `solids` solids that it touches, or no_solid.
inline constexpr std::int32_t no_solid = -1;
[[nodiscard]] std::vector<std::int32_t> touched_solids(const formats::Frame& frame, std::size_t solids);
// The same of a frame whose scene is not known.
[[nodiscard]] std::vector<std::int32_t> touched_solids(const formats::Frame& frame);
// Adds or replaces it; `touch` has a solid or no_solid for each vertex.
void put_touched_solids(formats::Frame& frame, std::span<const std::int32_t> touch, std::size_t solids);

// Bits of the array inlet, of the first inlet; the next ones have the bits above them.
inline constexpr std::uint64_t in_inlet = 1;        // moves at the inflow's velocity
inline constexpr std::uint64_t at_inlet_border = 2; // where liquid enters
inline constexpr std::size_t bits_of_an_inlet = 3, most_inlets = 21;
// Those of inlet i alone, as if it were the first.
[[nodiscard]] inline std::uint64_t of_inlet(std::uint64_t bits, std::size_t i) {
  return bits >> (bits_of_an_inlet * i) & ((std::uint64_t{1} << bits_of_an_inlet) - 1);
}

// Whether the bits are those of a vertex at the border of any inlet.
[[nodiscard]] inline bool at_a_border(std::uint64_t bits) {
  for (; bits != 0; bits >>= bits_of_an_inlet)
    if ((bits & at_inlet_border) != 0)
      return true;
  return false;
}

// Adds or replaces a float64 array of one row at place frame: a standard one, or one of the caller's.
void put_number(formats::Frame& frame, std::string_view name, double value);
void put_number(formats::Frame& frame, std::string_view name, std::string_view unit, double value);
// Its value, or `otherwise` where it is not there. Throws Error (bad_input) where it is another kind of array.
[[nodiscard]] double number(const formats::Frame& frame, std::string_view name, double otherwise);

} // namespace sheet
