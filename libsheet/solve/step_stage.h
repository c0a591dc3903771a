// SPDX-License-Identifier: GPL-3.0-or-later
// The stage sheet-step: one implicit time step a frame. Keeps connectivity, order and analysis while the mesh stays.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/energy/model.h"
#include "libsheet/solve/step.h"

namespace sheet {

struct StepStageOptions {
  std::optional<double> dt;        // fixed step [s]; absent: chosen by the tolerance
  std::optional<double> tolerance; // error estimate of a step, in lengths of the edges; absent: default_tolerance
  Scheme scheme = Scheme::sdirk2;
  Bending bending = Bending::mid_edge;
  std::string failed = "failed-step.sheet"; // where a frame goes whose step fails; "" for nowhere
};

class StepStage {
public:
  explicit StepStage(StepStageOptions options);
  ~StepStage();
  StepStage(const StepStage&) = delete;
  StepStage& operator=(const StepStage&) = delete;

  // Advances the frame by one step, never past its next_output_time. Throws Error: bad_input (no scene, a mesh that is
  // no oriented manifold, nothing to do), not_converged.
  void step(formats::Frame& frame);
  // Throws what step throws before it begins to compute.
  void check(const formats::Frame& frame);

  // With -v: the assembled terms, their shares of the time, steps, Newton iterations.
  void report() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet
