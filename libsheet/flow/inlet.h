// SPDX-License-Identifier: GPL-3.0-or-later
// The inlets of a frame, one for each [inflow] (arrays inlet and inlet_origin, formats/sheet.md, section 5). Liquid
// enters at its border, which moves at the inflow's velocity; behind it the sheet is free. Once enough has entered, a
// strip of it hangs there, two triangles behind each edge of the border, which takes up what enters until there is
// enough for another row.
//
//     a' -> b'   border: bits in_inlet and at_inlet_border
//     |  /  |    strip, or the same with the other diagonal
//     a --- b    first row: bit behind_inlet, and the origin of the border's vertex above; in_inlet, too, on a wall
//
// On a wall along which liquid flows the inlet is a channel one row long: the first row moves at the inflow's velocity
// as the border does. Else liquid that piles up before it, as it cannot flow away as fast as it enters, turns the strip
// around the inlet's ends, and comes back behind it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

inline constexpr std::uint64_t behind_inlet = 4; // beside in_inlet and at_inlet_border (libsheet/sheet/sheet.h)

// A connected piece of the border.
struct InletChain {
  bool closed = false;
  std::vector<std::uint32_t> border; // vertices in the order in which the sheet lies to the left of a -> b
  std::vector<std::uint32_t> behind; // for each edge of the border, the triangle at it
  std::vector<std::uint32_t> row;    // the first row, for each vertex of the border; empty: there is no strip yet
  std::vector<std::array<std::uint32_t, 2>>
      strip; // for each edge of the border its triangles, that at the border first

  [[nodiscard]] std::size_t edges() const { return behind.size(); }
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == border.size() ? 0 : i + 1; }
};

// All pieces of inlet `number`, open ones first, each kind by its first vertex. A strip that is not as drawn above
// (somebody has remeshed it) is none. Throws Error (bad_input) where the border is no manifold.
[[nodiscard]] std::vector<InletChain> find_inlet(const formats::Frame& frame, std::size_t number);

} // namespace sheet::flow
