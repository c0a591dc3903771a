// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/stages.h"

#include <chrono>

#include "libsheet/flow/emit.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/solve/step_stage.h"

namespace sheet::validation {

Staged run_stages(const std::string& scene_text, const Settings& s, double duration,
                  const std::function<void(const formats::Frame&)>& each,
                  const std::function<void(formats::Frame&)>& prepare) {
  const Scene scene = parse_scene(scene_text, "validation case");
  Staged run{build_frame(scene)};
  if (prepare)
    prepare(run.frame);
  StepStageOptions options;
  options.dt = duration / s.steps;
  options.scheme = s.scheme;
  options.failed = "";
  StepStage stage(options);
  flow::EmitStage emit;
  remesh::Options remeshing;
  remeshing.size.edge_length = s.edge;
  remeshing.smooth = true;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < s.steps; ++k) {
    if (flows_in_or_out(scene))
      emit.emit(run.frame);
    stage.step(run.frame);
    run.edits += remesh::remesh(run.frame, &scene, remeshing).edits();
    if (each)
      each(run.frame);
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

Result result_of(const Staged& run, const Settings& s, double value) {
  Result r;
  r.value = value;
  r.error = value - 1;
  r.seconds = run.seconds;
  r.vertices = run.frame.vertices;
  r.edge = s.edge;
  r.steps = s.steps;
  return r;
}

} // namespace sheet::validation
