// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/remesh_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/base/stopwatch.h"
#include "libsheet/flow/threads.h"
#include "libsheet/scene/inner_faces.h"
#include "libsheet/scene/sheet_edges.h"

namespace sheet::remesh {

RemeshStage::RemeshStage(const StageOptions& options) : options_(options) {
  if (options_.edge_length) {
    options_.remeshing.size.edge_length = *options_.edge_length;
    options_.remeshing.size.check();
  }
}

namespace {

// The shortest of a scene that does not say how long all edges are: those of its sheets when they were first remeshed,
// which the frame keeps, so that a run that is resumed goes on with it.
double own_edge_length(formats::Frame& frame) {
  constexpr const char* name = "remesh.edge_length";
  const double known = number(frame, name, 0);
  if (known > 0)
    return known;
  const double own = scene::shortest_own_edge(frame);
  if (!(own > 0))
    fail(ExitCode::usage, "--edge-length is needed: neither the scene nor the mesh says how long edges are");
  put_number(frame, name, "m", own);
  return own;
}

// How many times as long as `edge_length` [m] the edges of each vertex's sheet are; empty: all alike.
std::vector<double> scale_at_vertices(const formats::Frame& frame, double edge_length) {
  const std::span<const double> edges = scene::sheet_edges(frame);
  if (edges.empty())
    return {};
  std::vector<double> scale(frame.vertices, std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < edges.size(); ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      scale[v] = std::min(scale[v], edges[t] / edge_length);
  for (double& factor : scale)
    factor = std::isfinite(factor) ? factor : 1;
  return scale;
}

} // namespace

void RemeshStage::remesh(formats::Frame& frame) {
  check_magnitudes(frame);
  const Scene* scene = frame.find("scene") == nullptr ? nullptr : &scenes_.of(frame);
  if (!options_.edge_length) {
    const auto stated = scene != nullptr ? scene::shortest_stated_edge(*scene) : std::nullopt;
    options_.remeshing.size.edge_length = stated ? *stated : own_edge_length(frame);
    options_.remeshing.size.scale = scale_at_vertices(frame, options_.remeshing.size.edge_length);
  }
  if (scene != nullptr && options_.remeshing.size.chord_error)
    options_.remeshing.size.inner_faces = inner_faces(*scene, frame);
  const std::uint64_t vertices = frame.vertices;
  Stopwatch watch;
  const Report report = remesh::remesh(frame, scene, options_.remeshing);
  if (scene != nullptr && !report.budget_reached) // what is only fine has been made coarser by then
    cut_threads(frame, *scene);
  const double seconds = watch.lap();
  log::detail(
      "step {}: {} splits, {} collapses, {} flips, {} moved, {} absorbed, {} filled; {} to {} vertices, {:.1f} ms",
      frame.step, report.splits, report.collapses, report.flips, report.smoothed, report.absorbed, report.filled,
      vertices, frame.vertices, 1e3 * seconds);
  if (report.budget_reached)
    teller_.tell(frame, {.trouble = health::Trouble::edits_due, .value = static_cast<double>(report.edits())},
                 fmt::format("step {}: more edits were due than one call makes ({} were made); the next call goes on",
                             frame.step, report.edits()));
  if (report.sharp > 0)
    log::detail("step {}: {} triangles have an angle below 20 degrees", frame.step, report.sharp);
  total_ += report;
  ++frames_;
}

void RemeshStage::cut_threads(formats::Frame& frame, const Scene& scene) {
  const flow::Shed cut = flow::cut_threads(frame, scene, options_.remeshing.size.shortest_in_strips());
  if (cut.sum.triangles == 0)
    return;
  log::detail("step {}: {} triangles of threads cut, {:.3g} m^3, {} drops", frame.step, cut.sum.triangles,
              cut.sum.volume, cut.drops.size());
  threads_ += cut.sum.triangles;
  thread_drops_ += cut.drops.size();
  thread_volume_ += cut.sum.volume;
}

void RemeshStage::report() const {
  teller_.report();
  if (threads_ > 0)
    log::detail("{} triangles of threads cut, {:.3g} m^3 ({})", threads_, thread_volume_,
                thread_drops_ > 0 ? fmt::format("{} drops", thread_drops_) : "the frame's array tear.volume");
  if (frames_ > 0)
    log::detail("{} frames: {} splits, {} collapses, {} flips, {} moved, {} absorbed, {} filled", frames_,
                total_.splits, total_.collapses, total_.flips, total_.smoothed, total_.absorbed, total_.filled);
}

} // namespace sheet::remesh
