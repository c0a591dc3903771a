// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that start as layers on slopes along which they flow, or close above: they creep, and there is something to
// see only after a time that their weight and viscosity say.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct RunningDown {
  double speed; // of a layer as thick as the sheet, or as it carries what flows in for ever, under its weight
                // (scene/layer_scales.h), of the liquid that runs fastest [m/s]
  double time;  // in which it runs by its length [s]
};

// At the time t [s], when the solids have turned and carried what lies on them. Nothing unless half of the sheet lies
// on solids along which it flows and which are, in the mean, steeper than 6 degrees then, or turn so fast that they
// drive it outwards as such slopes do.
[[nodiscard]] std::optional<RunningDown> runs_down(const Scene& scene, const formats::Frame& first, double t);

// Of a free sheet without heat that lands on such solids, and would run down them by half its length long after the
// run's end at `until` [s], of which what happens while it falls asks for short times; else "", and of what turns, and
// where that is a thousand runs.
[[nodiscard]] std::string late_running_warning(const Scene& scene, const formats::Frame& first, double until);

struct Spreading {
  std::size_t ground; // the solid's number
  bool lies;          // on it from the start
  double time;        // in which it lands and spreads by a tenth of its radius [s]
};

// Of a free sheet without heat, the only one, Newtonian or of a power law and thicker than tension lets lie, that lands
// or lies on level ground; nothing where a solid moves, which may be what there is to see, or carries it out.
[[nodiscard]] std::optional<Spreading> spreads(const Scene& scene, const formats::Frame& first);

// In which the waves of its thickness, a hundredth of it and more, fall to 1/e where it lies on level ground from the
// start and is Newtonian, the slowest of them [s]: μ (3/(h + 3 b) + 4 k² h)/(k² (ρ g + γ k²) h²) [Orchard 1962], the
// layer stretched, too; γ with `faces` only. 0 where there are none.
[[nodiscard]] double levelling_time(const Scene& scene, const formats::Frame& first);

// Where it has spread by a tenth long after the run's end; likewise "" where that is a thousand runs.
[[nodiscard]] std::string late_spreading_warning(const Scene& scene, const formats::Frame& first, double until);

// Likewise of one that lands on the level top of a solid at rest, Newtonian, and comes over its edge. In the time t it
// spreads to the radius 0.894 (g V³ t/(3 nu))^(1/8) [Huppert 1982], V its volume, then runs down the side by half its
// length, or all there is of that, in a layer half as thick as the sheet. Of what flows in straight down, Q, to the
// radius 0.715 (g Q³/(3 nu))^(1/8) t^½, then all around as far down the side as that is wide, (3 nu q/g)^⅓ thick. ""
// where surface tension or a wall keeps it on the top, or all that takes many times the run.
[[nodiscard]] std::string late_overrun_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
