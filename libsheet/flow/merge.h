// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that become one: what lies wholly on another layer, and has for longer than the scene's [merge] after
// (merge_patches.h says which), gives it its liquid (deposit.h) and goes. The border of what goes is a free rim of what
// stays, welded to the layer below by springs that never part: no liquid goes through the edges of a Lagrangian mesh
// anyway, and force goes through springs. What does not go through is a moment: the border is a hinge.
//
// A weld is a spring with the date -inf in the array contact_since, at rest where it is made, as stiff along as across:
//   k = μ h/(2 T) + A ρ h/T²,   T = √(d/g)/10, without gravity the step,
// with h = d the mean thickness of both layers there and A half of the border vertex' area, as contacts have it
// (collide/contact_springs.h). It gives way by some ε' T edges where the sheet is stretched at the rate ε', which is
// nothing. Forty times as stiff, folds of honey took half as many steps again. SI units.
#pragma once
#include <cstdint>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet::flow {

struct Merged {
  std::size_t triangles = 0; // taken up
  std::size_t welds = 0;     // made
  std::size_t staying = 0;   // vertices that had no room to move to the centre of mass
  double volume = 0;         // moved [m³]
  double energy = 0;         // kinetic, lost [J]
  double ripe = 0;           // that has touched for long enough and is left, in the last frame [m³]

  Merged& operator+=(const Merged& later); // all but the last adds up
};

// Merges the frame; bit for bit the same frame if nothing merges. What has merged is added to the frame's arrays
// `merge.volume` [m³] and `merge.energy` [J] (account.h). Throws Error (bad_input) for a mesh that is no oriented
// manifold. Precondition: the scene has a [merge] table.
Merged merge(formats::Frame& frame, const Scene& scene);

// The stage. Without [merge] in the scene, frames pass unchanged.
class MergeStage {
public:
  void merge(formats::Frame& frame);
  void report() const; // with -v, what merged

private:
  FrameScene scenes_;
  Merged total_;
};

} // namespace sheet::flow
