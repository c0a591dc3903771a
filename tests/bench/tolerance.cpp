// SPDX-License-Identifier: GPL-3.0-or-later
// What the tolerance of Newton's method costs and gains: iterations a step and the greatest difference of a position to
// the result of a tight tolerance, in edges, beside the error of the time step itself. CSV.
#include <cmath>
#include <cstdio>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

constexpr int cells = 20;

State run(State s, const Model& m, double until, int steps, double tolerance, int* iterations) {
  StepOptions options;
  options.newton.tolerance = tolerance;
  Stepper stepper(m, options);
  for (int k = 0; k < steps; ++k)
    *iterations += stepper.step(s, until / steps).newton.iterations;
  return s;
}

double difference(const State& a, const State& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.positions.size(); ++v)
    worst = std::max(worst, (a.positions[v] - b.positions[v]).norm() * cells);
  return worst;
}

} // namespace

int main() {
  // A viscous catenary: 1 m, clamped ends, until it hangs by about 0.4 m.
  const State start = test::at_rest(test::rectangle(1, 1, cells, cells, 0.2), 0.06);
  Model m;
  m.liquid.viscosity = 0.0333;
  m.liquid.density = 0.1;
  m.liquid.surface_tension = 0.002;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.arcs = true;
  Hold ends;
  for (std::uint32_t v = 0; v < start.positions.size(); ++v)
    if (start.positions[v].x() == 0 || start.positions[v].x() == 1)
      ends.vertices.push_back(v);
  for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e) {
    const Vector3 &a = start.positions[start.mesh->edges[e][0]], &b = start.positions[start.mesh->edges[e][1]];
    if (a.x() == b.x() && (a.x() == 0 || a.x() == 1))
      ends.clamped_edges.push_back(e);
  }
  m.holds.push_back(ends);
  constexpr double until = 0.3;
  std::printf("steps,tolerance,iterations a step,difference to 1e-11 [edges],error of the time step [edges]\n");
  for (const int steps : {10, 30, 90}) {
    int ignored = 0;
    const State tight = run(start, m, until, steps, 1e-11, &ignored);
    const double error = difference(tight, run(start, m, until, 4 * steps, 1e-11, &ignored));
    for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      int iterations = 0;
      const State s = run(start, m, until, steps, tolerance, &iterations);
      std::printf("%d,%.0e,%.2f,%.2e,%.2e\n", steps, tolerance, static_cast<double>(iterations) / steps,
                  difference(s, tight), error);
      std::fflush(stdout);
    }
  }
}
