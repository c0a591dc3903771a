// SPDX-License-Identifier: GPL-3.0-or-later
// The stage sheet-remesh.
#pragma once
#include <optional>

#include "libsheet/health/teller.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet::remesh {

struct StageOptions {
  std::optional<double> edge_length; // [m]; absent: the scene's
  Options remeshing;                 // its edge length is taken from above
};

class RemeshStage {
public:
  // Error(usage) if the options say something impossible.
  explicit RemeshStage(const StageOptions& options);
  void remesh(formats::Frame& frame); // errors as remesh::remesh; usage: no edge length; bad_input: a scene
                                      // that cannot be read
  void report() const; // with -v: how many edits of each kind, over all frames; trouble that came more than once

private:
  void cut_threads(formats::Frame& frame, const Scene& scene);

  StageOptions options_;
  FrameScene scenes_;
  Report total_;
  health::Teller teller_;
  std::uint64_t frames_ = 0, threads_ = 0, thread_drops_ = 0;
  double thread_volume_ = 0; // [m³]
};

} // namespace sheet::remesh
