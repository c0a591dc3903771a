// SPDX-License-Identifier: GPL-3.0-or-later
// The ring that `sheet-init --check` proposes: its stages, with lengths and times from the scene.
#pragma once
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/plan/quality.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// How thick the thinnest of the sheet is when it lands [m]: of an inflow, what the fall to the first solid below
// leaves, h v0/v, v as in landing.h; of what is there from the start, its thickness.
[[nodiscard]] double landing_thickness(const Scene& scene, const formats::Frame& first);

// How to remesh what folds where it lands: edges that lie nearer to it than `nearness`, with lengths between these [m].
struct EdgesInFolds {
  double nearness, shortest, longest;
};

// How to run a scene.
struct ProposedRing {
  double until;                           // [s]
  double fps;                             // frames to keep [1/s]
  std::optional<EdgesInFolds> folds = {}; // where something folds or piles up (piling.h)
  std::string stages;                     // joined by pipes
};
// What the user has settled.
struct RingWishes {
  Quality quality = Quality::normal;
  std::optional<double> until, fps;
};
// `first`: the scene's first frame, at that quality. A run that would blow up ends at nine tenths of the time to it
// (blow_up.h), one that hangs some times of free fall after it has run away (hanging.h), unless the user wishes
// otherwise; one that is warmed until it flows goes on until it has flowed when warm. One that a solid comes through at
// its beginning, as a squeegee that passes over paint, which then runs down for minutes, ends soon after that where few
// of 250 frames would show it.
[[nodiscard]] ProposedRing proposed_ring(const Scene& with_heat, const formats::Frame& first, const RingWishes& wishes);

// Of what a scene prescribes at the beginning of a long run: that few frames show it, and the run that does; or that
// the run ends soon after it, and the one that goes on. "" where five frames or more show it, or the user has settled
// how many.
[[nodiscard]] std::string few_frames_warning(const Scene& with_heat, const formats::Frame& first,
                                             const RingWishes& wishes);

// The same as commands to paste, and what they compute with. `init` is the command that makes the first frame.
[[nodiscard]] std::string ring_text(const Scene& with_heat, const formats::Frame& first, const RingWishes& wishes,
                                    const std::string& init);
// The same for a program: lines "first INIT", "until SECONDS", "fps FPS", "stages PIPELINE", and forecast_lines.
[[nodiscard]] std::string ring_lines(const Scene& with_heat, const formats::Frame& first, const RingWishes& wishes,
                                     const std::string& init);

} // namespace sheet
