// SPDX-License-Identifier: GPL-3.0-or-later
// V19 and V20: what holds for any sheet. Here error is not value - 1 but the defect itself.
#include <algorithm>

#include "libsheet/energy/stage_setup.h"
#include "tests/support/holds.h"
#include "tests/validation/instant.h"

namespace sheet::validation {

namespace {

// A bumpy disk of radius 1.
State bumpy(const Settings& s, double thickness) {
  TriangleMesh mesh = make_disk(1, mesh_options(s, 1));
  for (Vector3& x : mesh.positions)
    x.z() = 0.2 * std::sin(2 * x.x() + 1) * std::cos(3 * x.y()) + 0.1 * x.x() * x.y();
  return film(mesh, thickness);
}

double worst_stretch(const State& before, const State& after) {
  double worst = 0;
  for (const Edge& e : before.mesh->edges) {
    const double l0 = (before.positions[e[1]] - before.positions[e[0]]).norm();
    worst = std::max(worst, std::abs((after.positions[e[1]] - after.positions[e[0]]).norm() / l0 - 1));
  }
  return worst;
}

std::vector<double> vertex_masses(const State& s, double density) {
  std::vector<double> mass(s.positions.size(), 0);
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    for (const auto v : s.mesh->triangles[t])
      mass[v] += density * s.volumes[t] / 3;
  return mass;
}

} // namespace

// V19, a quarter turn about a skew axis in one step. Sets: 1 forces of the viscous terms at the turned state, greatest
// over μ V/(τ edge), τ the step; 2 one step of a turning sheet whose rim is held to it: greatest relative change of an
// edge; 3 the same from rest, the rim turned at once.
Result v19(const Settings& s) {
  constexpr double mu = 3, h = 0.05, dt = 0.1;
  State start = bumpy(s, h);
  Model m = viscous(mu, s);
  const Vector3 spin = pi / 2 / dt * (Vector3(1, 2, 2) / 3);
  const double edge = mean_edge(start);
  if (s.set == 1) {
    Hold whole = hold(
        start, [](const Vector3&) { return true; }, all_axes, false);
    for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e)
      whole.clamped_edges.push_back(e);
    test::move_steadily(whole, spin);
    m.holds.push_back(whole);
    const Instant i = solve_instant(start, m, dt);
    double volume = 0;
    for (const double v : start.volumes)
      volume += v;
    Result r;
    r.error = i.reaction.cwiseAbs().maxCoeff() * dt * edge / (mu * volume);
    r.value = 1 + r.error;
    r.vertices = start.positions.size();
    r.edge = edge;
    r.seconds = i.seconds;
    r.steps = 1;
    r.iterations = i.iterations;
    r.more = {{"energy", i.potential * dt / (mu * volume)}};
    return r;
  }
  Hold rim = hold(
      start, [](const Vector3& x) { return x.head<2>().norm() > 1 - 1e-9; }, all_axes, true);
  test::move_steadily(rim, spin);
  if (s.set == 2)
    for (std::size_t v = 0; v < start.positions.size(); ++v)
      start.velocities[v] = spin.cross(start.positions[v]);
  m.holds.push_back(rim);
  Run run(start, m, s, 1);
  run.advance(dt, 1);
  Result r = run.result(1);
  r.error = worst_stretch(start, run.state());
  r.value = 1 + r.error;
  return r;
}

// V20, a bumpy disk thrown into space with a strain and a spin, inertia, viscosity, bending and surface tension. Sets:
// 1 linear momentum, change over Σ m |v|; 2 angular momentum, change over Σ m |x| |v|; 3 energy: kinetic + surface at
// the start, minus at the end, minus dissipated (Simpson's rule over the frames), over what was dissipated.
Result v20(const Settings& s) {
  constexpr double mu = 0.2, rho = 10, tension = 0.05, h = 0.05, until = 0.4;
  State start = bumpy(s, h);
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    const Vector3& x = start.positions[v];
    start.velocities[v] = Vector3(0.3, -0.2, 0.5) + 0.5 * Vector3(1, 1, 2).cross(x) +
                          0.4 * Vector3(std::sin(2 * x.y()), x.x() * x.x(), std::cos(2 * x.x()));
  }
  Model m = viscous(mu, s);
  m.inertia = true;
  m.liquid.density = rho;
  m.liquid.surface_tension = tension;
  const std::vector<double> mass = vertex_masses(start, rho);

  struct Sums {
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
    double scale = 0, arm_scale = 0, energy = 0;
  };
  const auto sums = [&](const State& at) {
    Sums sum;
    for (std::size_t v = 0; v < mass.size(); ++v) {
      const Vector3 p = mass[v] * at.velocities[v];
      sum.linear += p;
      sum.angular += at.positions[v].cross(p);
      sum.scale += p.norm();
      sum.arm_scale += at.positions[v].norm() * p.norm();
      sum.energy += 0.5 * p.dot(at.velocities[v]);
    }
    sum.energy += 2 * tension * sheet_area(at);
    return sum;
  };
  // Twice the potential of the flow at this instant, directors where they cost least.
  const auto power = [&](const State& at) {
    constexpr double d = 1e-6;
    Model flow = viscous(mu, s);
    flow.holds.push_back(hold(
        at, [](const Vector3&) { return true; }, all_axes, false));
    return 2 / d * solve_instant(at, flow, d, [&](const Stage& stage, Unknowns& u) {
                     for (std::size_t v = 0; v < stage.vertices(); ++v)
                       u.segment<3>(static_cast<Eigen::Index>(3 * v)) += d * at.velocities[v];
                   }).potential;
  };
  std::vector<double> powers;
  if (s.set == 3)
    powers.push_back(power(start));
  const Sums before = sums(start);
  Run run(start, m, s, 1);
  run.tolerance = 1e-11;
  const int steps = s.steps + s.steps % 2;
  run.advance(until, steps, [&](const State& at) {
    if (s.set == 3)
      powers.push_back(power(at));
  });
  const Sums after = sums(run.state());
  Result r = run.result(1);
  r.error = (after.linear - before.linear).norm() / before.scale;
  if (s.set == 2)
    r.error = (after.angular - before.angular).norm() / before.arm_scale;
  if (s.set == 3) {
    double dissipated = 0;
    for (int k = 0; k < steps; k += 2)
      dissipated += until / steps / 3 *
                    (powers[static_cast<std::size_t>(k)] + 4 * powers[static_cast<std::size_t>(k) + 1] +
                     powers[static_cast<std::size_t>(k) + 2]);
    r.error = (before.energy - after.energy - dissipated) / dissipated;
    r.more = {{"dissipated", dissipated}};
  }
  r.value = 1 + r.error;
  return r;
}

} // namespace sheet::validation
