// SPDX-License-Identifier: GPL-3.0-or-later
// How the scene's liquids look on the page, where slabs are opaque: each has one colour.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/quantities/palette.h"
#include "libsheet/render/slab.h"
#include "libsheet/scene/scene.h"

namespace sheet::view {

// Of each of the scene's liquids (scene::liquids_of): the names of the sheets of it, with commas; "liquid 2" and so on
// where they have none.
[[nodiscard]] std::vector<std::string> names_of_liquids(const Scene& scene);

// All volume over all area of each of so many liquids in the frame [m]; 0 of one that is not there. `numbers`: of each
// triangle's liquid; empty: all are of the first.
[[nodiscard]] std::vector<double> liquid_thickness(const formats::Frame& frame, std::span<const std::uint32_t> numbers,
                                                   std::size_t liquids);

// What a slab of thickness h [m] that lies on white (a reflectance of 0.8) throws back of light from straight above,
// without the mirror image of its face. With passed = T + C rho_t and thrown = C rho_r (slab.h), which stand for the
// light that comes from the white as well, white being W:
//   thrown + passed² W / (1 - W (R + thrown)).
[[nodiscard]] DisplayedColour colour_on_white(const render::Liquid& liquid, double h);

} // namespace sheet::view
