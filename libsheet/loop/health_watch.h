// SPDX-License-Identifier: GPL-3.0-or-later
// Watches over the health of a run: notes trouble in its frames, and tells when it becomes serious and at the end.
#pragma once
#include <set>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet {

class HealthWatch {
public:
  // Every so many steps a frame is looked at, so that it costs next to nothing.
  static constexpr std::uint64_t every = 10;

  // A step has led from `before` to `after`, which gets what is to be noted. Looks at it at every tenth step, and if it
  // is `kept`.
  void follow(const formats::Frame& before, formats::Frame& after, bool kept);
  // What has become serious in the frame's run since the last call, a line or two each; "" if nothing.
  [[nodiscard]] std::string become_serious(const formats::Frame& frame);
  // All that was wrong in the run that ends with this frame, of which none is noted any more; "" if nothing.
  [[nodiscard]] std::string at_the_end(const formats::Frame& frame);

private:
  void look_at(formats::Frame& frame);

  FrameScene scenes_;
  std::set<double> told_; // kinds
};

} // namespace sheet
