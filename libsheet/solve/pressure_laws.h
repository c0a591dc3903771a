// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure as a scene asks for it in a frame, and the frame's gas: the arrays gas.amount, gas.pressure, gas.escaped,
// gas.hole_area and gas.hole_place, a row for each enclosure (formats/sheet.md, section 5).
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/energy/pressure.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet {

// As the environment, which has pressure, says of the start.
[[nodiscard]] PressureLaw pressure_law(const scene::Environment& environment);

// One law for each enclosure that is left; gas leaves through the holes that the frame has (gas_holes.h). solids: the
// scene's; null only if it has none, or no gas. Throws Error (bad_input) where the frame does not say what encloses
// what.
[[nodiscard]] std::vector<PressureLaw> pressure_laws(const Scene& scene, const formats::Frame& frame,
                                                     const Connectivity& mesh, const solid::Solids* solids);

// The amounts in a frame, and what has escaped; as the laws have settled them for the start of a step.
[[nodiscard]] std::vector<Gas> gas_of(const formats::Frame& frame);
void settle_gas(std::span<const PressureLaw> laws, std::vector<Gas>& gas);

// Writes the gas at the end of a step, and the holes that it had in it.
void put_gas(std::span<const Gas> gas, formats::Frame& frame);
void put_gas_holes(std::span<const PressureLaw> laws, formats::Frame& frame);

} // namespace sheet
