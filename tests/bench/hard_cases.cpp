// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases, each with what happened: steps, Newton iterations, whether the potential fell monotonically. CSV. Each is
// done in fixed steps and in steps chosen by their error.
//   bench_hard_cases [flat] [PART OF A NAME]
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "libsheet/base/error.h"
#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

constexpr int greatest_steps = 100; // chosen by their error

std::string wanted; // part of the names of the cases to run

void add(StepReport& sum, const StepReport& r) {
  sum.substeps += r.substeps;
  sum.failed += r.failed;
  sum.rejected += r.rejected;
  sum.euler_fallbacks += r.euler_fallbacks;
  sum.flat_fallbacks += r.flat_fallbacks;
  sum.unfinished += r.unfinished;
  sum.inaccurate += r.inaccurate;
  sum.newton.iterations += r.newton.iterations;
  sum.newton.factorizations += r.newton.factorizations;
  sum.newton.positive += r.newton.positive;
  sum.newton.shifted += r.newton.shifted;
  sum.newton.halvings += r.newton.halvings;
  sum.newton.monotone = sum.newton.monotone && r.newton.monotone;
}

// chosen: by their error, to the same times.
void run_one(const std::string& name, State s, const Model& m, double dt, int steps, const StepOptions& options,
             bool chosen) {
  StepReport sum;
  sum.newton.monotone = true;
  std::string outcome = "ok";
  double drop = 0;
  int done = 0;
  const auto start = std::chrono::steady_clock::now();
  try {
    Stepper stepper(m, options);
    if (chosen) {
      StepControl control;
      for (int k = 1; k <= steps; ++k)
        while (s.time < k * dt && done < greatest_steps) {
          add(sum, stepper.step_within(s, k * dt, control));
          ++done;
        }
      if (s.time < steps * dt)
        outcome = "not further than " + std::to_string(s.time / dt / steps) + " of the time";
    } else {
      for (; done < steps; ++done)
        add(sum, stepper.step(s, dt));
    }
  } catch (const Error& e) {
    outcome = e.what();
  }
  for (const Vector3& x : s.positions)
    drop = std::min(drop, x.z());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s,%s,%g,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%s,%.4g,%.2f,\"%s\"\n", name.c_str(),
              chosen ? "chosen" : "fixed", dt, done, sum.substeps, sum.failed, sum.rejected, sum.euler_fallbacks,
              sum.flat_fallbacks, sum.unfinished, sum.inaccurate, sum.newton.iterations, sum.newton.factorizations,
              sum.newton.positive, sum.newton.shifted, sum.newton.halvings, sum.newton.monotone ? "yes" : "no", drop,
              seconds, outcome.c_str());
  std::fflush(stdout);
}

void run(const std::string& name, const State& s, const Model& m, double dt, int steps, StepOptions options = {}) {
  if (name.find(wanted) == std::string::npos)
    return;
  for (const bool chosen : {false, true})
    if (!chosen || options.scheme == Scheme::sdirk2)
      run_one(name, s, m, dt, steps, options, chosen);
}

Hold where(const State& s, auto&& chosen) {
  Hold hold;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (chosen(s.positions[v]))
      hold.vertices.push_back(v);
  return hold;
}

bool arcs = true; // no argument is "flat"

Model sag(const State& s) {
  Model m;
  m.arcs = arcs;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.holds.push_back(where(s, [](const Vector3& x) { return x.x() == 0 || x.x() == 1; }));
  return m;
}

} // namespace

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k)
    if (std::string(argv[k]) == "flat")
      arcs = false;
    else
      wanted = argv[k];
  std::printf("case,steps are,dt,steps,substeps,failed,rejected,euler,flat,unfinished,inaccurate,newton,factorizations,"
              "positive,shifted,halvings,monotone,lowest_z,seconds,outcome\n");
  const test::Mesh square = test::rectangle(1, 1, 20, 20, 0.2);
  const State flat = test::at_rest(square, 0.02);
  // Time of the sag: μ/(ρ g L) = 0.01 s.
  for (const double dt : {1e-8, 1e-5, 1e-3, 1e-2, 1e-1, 1.0, 10.0})
    run("sag dt", flat, sag(flat), dt, 3);
  for (const double viscosity : {1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9}) {
    Model m = sag(flat);
    m.liquid.viscosity = viscosity;
    run("sag viscosity " + std::to_string(viscosity), flat, m, 0.01, 3);
  }
  {
    State s = flat;
    for (std::size_t t = 0; t < s.volumes.size(); ++t)
      s.volumes[t] *= t % 2 ? 1e-3 : 1e3;
    run("thickness contrast 1e6", s, sag(s), 0.01, 3);
    Model m = sag(s);
    m.inertia = false;
    run("thickness contrast 1e6 without inertia", s, m, 0.001, 3);
    // Heavy triangles of 20 m hang from films of 20 µm: the scene's own time is μ h_film/(ρ g h_heavy L) = 1e-8 s.
    for (const double dt : {1e-9, 1e-8, 1e-7})
      run("thickness contrast 1e6 without inertia", s, m, dt, 3);
  }
  for (const double h : {1e-3, 1e-4, 5e-8}) {
    const State s = test::at_rest(square, h);
    Model m = sag(s);
    run("thickness " + std::to_string(h / 0.05) + " edge", s, m, 0.01, 3);
    m.inertia = false;
    run("thickness " + std::to_string(h / 0.05) + " edge without inertia", s, m, 0.001, 3);
  }
  {
    test::Mesh mesh = test::rectangle(1, 1, 20, 20, 0);
    for (Vector3& x : mesh.positions) // one column of triangles squeezed to 0.01 degrees
      x.x() = x.x() < 0.5 ? x.x() : x.x() - 0.05 + 0.05 * std::tan(0.01 * std::numbers::pi / 180);
    const State s = test::at_rest(mesh, 0.02);
    Model m = sag(s);
    m.holds = {where(s, [&](const Vector3& x) { return x.x() == 0 || x.x() > 0.95 - 1e-4; })};
    run("triangles of 0.01 degrees", s, m, 0.01, 3);
    m.liquid.surface_tension = 10;
    run("triangles of 0.01 degrees with surface tension", s, m, 0.01, 3);
  }
  {
    test::Mesh mesh = test::rectangle(1, 1, 20, 20, 0);
    for (Vector3& x : mesh.positions)
      x.x() = x.x() > 0.5 ? 1 - x.x() : x.x();
    const State s = test::at_rest(mesh, 0.02);
    Model m = sag(s);
    m.holds = {where(s, [](const Vector3& x) { return x.x() == 0; })};
    run("folded flat by 180 degrees", s, m, 0.01, 3);
    m.bending = Bending::hinge;
    run("folded flat by 180 degrees (hinge)", s, m, 0.01, 3);
  }
  for (const double left : {0.5, 0.1, 0.01}) {
    Model m = sag(flat);
    m.holds = {where(flat, [](const Vector3& x) { return x.x() == 0; }),
               where(flat, [](const Vector3& x) { return x.x() == 1; })};
    test::move_steadily(m.holds[1], Vector3::Zero(), {(left - 1) / 0.1, 0, 0});
    run("ends brought to " + std::to_string(left) + " of their distance in a step", flat, m, 0.1, 1);
  }
  for (const double ratio : {0.1, 0.5, 1.0, 2.0, 5.0}) { // gamma dt/(mu h) at free edges
    const State s = test::at_rest(test::disk(1, 10, 0.2), 0.02);
    Model m;
    m.liquid.viscosity = 100;
    m.inertia = false;
    m.liquid.surface_tension = 1;
    run("free disk: gamma dt/(mu h) = " + std::to_string(ratio), s, m, ratio * 100 * 0.02, 5);
    StepOptions options;
    options.scheme = Scheme::backward_euler;
    run("free disk (backward Euler): gamma dt/(mu h) = " + std::to_string(ratio), s, m, ratio * 100 * 0.02, 5, options);
  }
}
