// SPDX-License-Identifier: GPL-3.0-or-later
// Tearing: holes open in a sheet where inclusions pierce it (exposure.h, holes.h), and it parts where it has become
// thinner than the scene's [tear] allows (tear_cuts.h says at which edges). Then the corners of each vertex are united
// across uncut edges only, so that the sheet is a manifold without pinched vertices, also where it had some before.
//
// A vertex that has come apart moves into its own piece, by a thousandth of the way to the nearest opposite side, so
// that the lips of a crack do not touch (cracks.h); triangles keep their volumes, vertices their velocities, so volume,
// momentum and kinetic energy are what they were.
#pragma once
#include <cstdint>

#include "formats/cpp/stream_frame.h"
#include "libsheet/flow/shed.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet::flow {

struct Torn {
  std::size_t edges = 0;              // cut
  std::size_t vertices = 0;           // that came apart
  std::size_t vetoed = 0;             // edges left whole because a crumb would come off
  std::size_t crossing = 0;           // edges left whole because the sheet would pass through itself
  std::size_t holes = 0;              // opened at inclusions
  std::size_t without_room = 0;       // inclusions that opened none
  std::size_t dropped = 0;            // triangles of crumbs
  double volume = 0;                  // dropped [m³]
  Vector3 momentum = Vector3::Zero(); // dropped [kg m/s]

  std::size_t drops = 0; // that came off, in scenes with them; nothing is dropped there

  void add(const Shed& shed);
  Torn& operator+=(const Torn& later); // all adds up
};

// Tears the frame; bit for bit the same frame, but for `tear.exposure`, if there is nothing to tear. What comes off in
// crumbs and round pieces becomes what shed.h says. Throws Error (bad_input) for a mesh that is no oriented manifold
// but for pinched vertices. Precondition: the scene has a [tear] table.
Torn tear(formats::Frame& frame, const Scene& scene);

// The stage. Without [tear] in the scene, frames pass unchanged.
class TearStage {
public:
  void tear(formats::Frame& frame);
  // What was dropped: a warning; with -v, what was torn.
  void report() const;

private:
  FrameScene scenes_;
  Torn total_;
};

} // namespace sheet::flow
