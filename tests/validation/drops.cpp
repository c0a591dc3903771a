// SPDX-License-Identifier: GPL-3.0-or-later
// V45: a strip that is drawn out parts where it has become as narrow as the scene says. V46: rain on a sheet that
// flies.
#include <chrono>

#include <fmt/core.h>

#include "libsheet/collide/collide_stage.h"
#include "libsheet/remesh/remesh_stage.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

using formats::Frame;

Result result_of_frame(const Frame& frame, const Settings& s, double value) {
  Result r;
  r.value = value;
  r.error = value - 1;
  r.vertices = frame.vertices;
  r.edge = s.edge;
  r.steps = s.steps;
  return r;
}

} // namespace

// A strip of 60 x 6 x 1 mm, its ends guided, creeps as it is drawn out to five times its length, and becomes narrower
// as the root of that; it is to part where it is half as wide (set 1) or a third (set 2). Value: its width when it
// does, over that; 0 if it does not. More: by how much the volume of pieces and drops differs from that at the start.
Result v45(const Settings& s) {
  constexpr double length = 0.06, width = 6e-3, longest = 10.5;
  const double snap = width / (s.set + 1);
  const Scene scene = parse_scene(
      fmt::format(
          "[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [{}, {}]\nedge_length = {}\nthickness = 1e-3\n"
          "seed = {}\n[material]\nviscosity = 1\ndensity = 1000\n[model]\ninertia = false\n"
          "[[hold]]\nregion = \"x_min\"\naxes = \"x\"\n[[hold]]\nregion = \"x_max\"\naxes = \"x\"\n"
          "motion = {{kind = \"translating\", velocity = [{}, 0, 0]}}\n[tear]\nsnap = {}\ndrops = true\n",
          length, width, s.edge * width, s.seed, length * (longest - 1), snap),
      "V45");
  Frame frame = build_frame(scene);
  const double volume = volume_of_all(frame);
  StepStage step(equal_steps(s, 1));
  remesh::StageOptions options;
  options.remeshing.smooth = true;
  remesh::RemeshStage remesh(options);
  double parted = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < s.steps && parted == 0; ++k) {
    step.step(frame);
    remesh.remesh(frame);
    if (!read_drops(frame).empty())
      parted = width / std::sqrt(1 + (longest - 1) * frame.time);
  }
  Result result = result_of_frame(frame, s, parted / snap);
  result.seconds = since(start);
  result.more = {{"volume", volume_of_all(frame) / volume - 1}};
  return result;
}

// A disk of 0.2 m flies, turns, and is rained on by 40 drops from both sides, which it takes up. Value: its speed in
// the end, mean by mass, over that of all momentum. More: the volume over that at the start, less 1; drops that are
// left.
Result v46(const Settings& s) {
  const Scene scene = parse_scene(
      fmt::format(
          "[sheet]\nshape = \"disk\"\nplane = \"xy\"\nradius = 0.2\nedge_length = {}\nthickness = 1e-3\nseed = {}\n"
          "velocity = [0.3, 0, 0.5]\nangular_velocity = [0, 0.5, 0]\n[material]\nviscosity = 10\n"
          "density = 1000\nsurface_tension = 0.05\n[tear]\ndrops = true\n",
          s.edge * 0.2, s.seed),
      "V46");
  Frame frame = build_frame(scene);
  std::vector<Drop> drops;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.4 * i, radius = 0.15 * std::sqrt((i + 0.5) / 40), side = i % 2 == 0 ? 1 : -1;
    const Vector3 velocity(0.3, 0.1 * side, 0.5 - (1 + 0.05 * i) * side);
    drops.push_back({.position = Vector3(radius * std::cos(angle), radius * std::sin(angle), 0) -
                                 0.1 * (velocity - Vector3(0.3, 0, 0.5)),
                     .velocity = velocity,
                     .volume = 1e-9 * (1 + i)});
  }
  write_drops(frame, drops);
  const auto momentum = [](const Frame& of) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t t = 0; t < of.triangles; ++t)
      for (const std::uint32_t v : triangles(of)[t])
        sum += volumes(of)[t] / 3 * velocities(of)[v];
    for (const Drop& drop : read_drops(of))
      sum += drop.volume * drop.velocity;
    return sum;
  };
  const double volume = volume_of_all(frame);
  const Vector3 before = momentum(frame);
  StepStage step(equal_steps(s, 0.3));
  collide::CollideStage collide;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < s.steps; ++k) {
    step.step(frame);
    collide.step(frame);
  }
  Result result = result_of_frame(frame, s, 1 + (momentum(frame) - before).norm() / before.norm());
  result.seconds = since(start);
  result.more = {{"volume", volume_of_all(frame) / volume - 1},
                 {"left", static_cast<double>(read_drops(frame).size())}};
  return result;
}

} // namespace sheet::validation
