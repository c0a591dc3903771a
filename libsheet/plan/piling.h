// SPDX-License-Identifier: GPL-3.0-or-later
// What will fold or pile up where it lands.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct Piling {
  std::string_view what; // "what flows in", "the upright sheet"
  std::size_t solid;     // on which
};

// What falls on a solid for more than three thicknesses, an inflow, or sheets that are free, without a pressure that
// keeps them open, and rather upright (steeper than 60 degrees); but not on a belt that draws it away faster than it
// comes. all: of the sheet's vertices.
[[nodiscard]] std::optional<Piling> what_piles_up(const Scene& scene, const formats::Frame& first,
                                                  const std::vector<Landing>& all);

// Whether that inflow does so, where it lands.
[[nodiscard]] bool inflow_piles_up(const Scene& scene, const formats::Frame& first, std::size_t number,
                                   const Landing& landing);

} // namespace sheet
