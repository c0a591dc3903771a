// SPDX-License-Identifier: GPL-3.0-or-later
// The stage sheet-collide: the end of a step made safe, and the contact springs for the next one.
#pragma once
#include <memory>

#include "formats/cpp/stream_frame.h"

namespace sheet::collide {

class CollideStage {
public:
  CollideStage();
  ~CollideStage();
  CollideStage(const CollideStage&) = delete;
  CollideStage& operator=(const CollideStage&) = delete;

  // Corrects positions and velocities of a frame behind sheet-step and sets its `touch` and `contact_*` arrays. What
  // the scene does not have costs nothing: without solids and [contact] the frame stays as it is. Throws Error
  // (bad_input): no scene, no start of the step (start_position, start_time), a mesh that is no oriented manifold, a
  // sheet that passes through itself at the start.
  void step(formats::Frame& frame);

  // With -v: how often each means was needed, and the processor time of each part.
  void report() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet::collide
