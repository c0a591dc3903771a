// SPDX-License-Identifier: GPL-3.0-or-later
// What a run will come to: frames, megabytes, steps and seconds, by order of magnitude, from the scene's own scales.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct Forecast {
  double frames;   // kept, with the first one
  double bytes;    // of all of them
  double vertices; // in the mean over the run
  double steps;
  double seconds; // of computing, on one thread
};

// Vertices are those of the first frame, of sheets from when they enter and, at the first frame's density, of the area
// that flows in until the end and, at the speed of the inflow, has not reached an outflow: what stretches or is drawn
// together is not foreseen.
// Each output time ends a step. What moves takes steps more, of sqrt(tolerance l/a): an acceleration a that begins
// or ends is an error of a dt² of an edge's length l. Sheets that fall freely have a = g, for 2.25 times their fall,
// by which time most of them have come to rest; whatever else is driven has a = V²/L (scene/scales.h), until the
// end, or until its inflow ends. Layers that flow or slip on a solid that turns take steps of (l/2R)^(1/3) radians, R
// half their size. Most scenes take a third to three times as many (docs/model.md): strands, thin films and what
// crumples take more, films on rolls and what is blown fewer. A step of a liquid that is not Newtonian takes three
// times as long, in the mean: as long where it hardly thins or stands, ten times where it falls and folds.
[[nodiscard]] Forecast forecast(const Scene& scene, const formats::Frame& first, const ProposedRing& ring,
                                double tolerance);

// A paragraph of it, indented as ring_text.
[[nodiscard]] std::string forecast_text(const Scene& scene, const formats::Frame& first, const ProposedRing& ring,
                                        double tolerance);
// The same for a program: lines "frames N", "megabytes MB", "steps N", "seconds S".
[[nodiscard]] std::string forecast_lines(const Forecast& run);

} // namespace sheet
