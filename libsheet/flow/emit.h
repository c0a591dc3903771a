// SPDX-License-Identifier: GPL-3.0-or-later
// Inflow: new liquid enters at the inlet (inlet.h) at the scene's [inflow] velocity and thickness.
//
// In a step the border of the inlet moves with the liquid that is there; then it is put back to where it belongs, and
// the gap is what has entered: the strip behind it takes up area swept x thickness. The strip is between 1/2 and 3/2
// rows long; where it is longer, a row of vertices comes into it, one row above its first row, which that becomes now,
// and thickness on both sides of it so that it is the inflow's at the border. So rows are a row's length apart when
// they come in, whatever the time step, and are as long as the inlet's edges are on average (measured across the
// border). Until the border has gone half a row for the first time, nothing enters.
#pragma once
#include <optional>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/solid/solids.h"

namespace sheet::flow {

struct Emitted {
  double volume = 0;    // [m³]
  std::size_t rows = 0; // of new vertices
};

// Lets in what has entered since the frame's border was last put back; nothing more the second time. Where the inflow
// has ended, the inlet is set free (its arrays go). Everything that is known about new vertices comes from the vertex
// of the border that they enter at, about new triangles from the one that was nearest; amounts (rule conserve) stay
// with the old liquid. The frame array `emit.volume` [m³] is the volume that has entered so far, and what rounding has
// left out of it. Throws Error (bad_input): no inlet, an inlet along which liquid would flow, or out of which, an inlet
// that a [[hold]] holds fast.
Emitted emit(formats::Frame& frame, const Scene& scene);

// The stage: outflow (outflow.h), then inflow, and how deep inlets are under liquid (drowned_inlets.h). Without
// [inflow] and [[outflow]] in the scene, frames pass unchanged.
class EmitStage {
public:
  void emit(formats::Frame& frame);

private:
  FrameScene scenes_;
  std::optional<solid::Solids> solids_; // if liquid flows on some
};

} // namespace sheet::flow
