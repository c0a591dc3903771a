// SPDX-License-Identifier: GPL-3.0-or-later
// V7, V8, V9, V16, V17: films without bending; V28: one that bends.
#include <random>

#include <Eigen/Cholesky>

#include "tests/support/holds.h"
#include "tests/validation/instant.h"
#include "tests/validation/liquids.h"

namespace sheet::validation {

namespace {

Hold all(const State& s, Axes axes) {
  return hold(
      s, [](const Vector3&) { return true; }, axes, false);
}

// Root mean square of z, less the plane that fits best.
double roughness(const State& s) {
  const auto n = static_cast<Eigen::Index>(s.positions.size());
  Eigen::MatrixX3d plane(n, 3);
  Eigen::VectorXd z(n);
  for (Eigen::Index v = 0; v < n; ++v) {
    const Vector3& x = s.positions[static_cast<std::size_t>(v)];
    plane.row(v) << x.x(), x.y(), 1;
    z[v] = x.z();
  }
  z -= plane * (plane.transpose() * plane).ldlt().solve(plane.transpose() * z);
  return std::sqrt(z.squaredNorm() / static_cast<double>(n));
}

double mean_ring(const State& s, const std::vector<std::uint32_t>& ring) {
  double sum = 0;
  for (const auto v : ring)
    sum += s.positions[v].head<2>().norm();
  return sum / static_cast<double>(ring.size());
}

} // namespace

// V7: a tube under pressure, its ends held along the axis: hoop strain rate ṙ/r alone, N = 4 μ h ṙ/r = p r, h r = h0
// r0: r⁻² = r0⁻² - p t/(2 μ h0 r0).
Result v7(const Settings& s) {
  constexpr double mu = 1, h = 0.05, p = 0.1;
  const double until = 0.75 * 2 * mu * h / p; // the radius doubles
  return blown_tube(s, {.viscosity = mu}, h, p, p / (4 * mu * h), until, 2);
}

Result blown_tube(const Settings& s, const Liquid& liquid, double h, double p, double rate, double until, double end) {
  constexpr double length = 2;
  State start = film(make_tube(1, length, mesh_options(s, 1)), h);
  Model m = viscous(1, s);
  m.liquid = liquid;
  m.bending = Bending::none;
  m.pressures = {PressureLaw{PressureLaw::Kind::constant, p, 1, 1}};
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return std::abs(x.z()) > length / 2 - 1e-9; }, axis_bit(2), false));
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = rate * Vector3(start.positions[v].x(), start.positions[v].y(), 0);
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  double r = 0;
  for (const Vector3& x : run.state().positions)
    r += x.head<2>().norm();
  return run.result(r / static_cast<double>(run.state().positions.size()) / end);
}

// V8: a free disk: isotropic stress 6 μ h Ṙ/R = -2 γ: R⁻² = R0⁻² + 2π γ t/(3 μ V), until R = R0/2.
Result v8(const Settings& s) {
  constexpr double mu = 1, h = 0.05, tension = 0.1;
  const double until = 3 * 3 * mu * h / (2 * tension);
  State start = film(make_disk(1, mesh_options(s, 1)), h);
  Model m = viscous(mu, s);
  m.bending = Bending::none;
  m.liquid.surface_tension = tension;
  m.holds.push_back(all(start, axis_bit(2)));
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = -tension / (3 * mu * h) * start.positions[v];
  const double area = sheet_area(start);
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  return run.result(2 * std::sqrt(sheet_area(run.state()) / area));
}

// V9: a hole opens. Sets: 1 outer rim held at Ro = 1, Ṙ = γ R (1-s²)/(μ h (1+3s²)), s = R/Ro, h = h0
// (Ro²-R0²)/(Ro²-R²), from R0 = 0.3 to about 0.42; 2 the rim at Ro = 1 far from R0 = 0.1, the same equation.
Result v9(const Settings& s) {
  constexpr double mu = 1, h0 = 0.05, tension = 0.1;
  const double r0 = s.set == 1 ? 0.3 : 0.1, until = (s.set == 1 ? 0.3 : 0.4) * mu * h0 / tension;
  State start = film(make_annulus(r0, 1, mesh_options(s, 1)), h0);
  Model m = viscous(mu, s);
  m.bending = Bending::none;
  m.liquid.surface_tension = tension;
  m.holds.push_back(all(start, axis_bit(2)));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return x.norm() > 1 - 1e-9; }, all_axes, false));
  const std::vector<std::uint32_t> ring =
      hold(
          start, [&](const Vector3& x) { return x.norm() < r0 + 1e-9; }, all_axes, false)
          .vertices;
  using Y = Eigen::Matrix<double, 1, 1>;
  const double exact = runge_kutta(Y(r0), 0, until, 20000, [&](double, const Y& y) {
    const double q = y[0] * y[0], h = h0 * (1 - r0 * r0) / (1 - q);
    return Y(tension * y[0] * (1 - q) / (mu * h * (1 + 3 * q)));
  })[0];
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  Result r = run.result(mean_ring(run.state(), ring) / exact);
  r.more = {{"hole_radius", exact}, {"far_rim_law", r0 * std::exp(tension * until / (mu * h0))}};
  return r;
}

// V16: an annulus (radii 0.4 and 1) whose inner rim turns: u = A r + B/r, torque -4π μ h B on the inner rim, from the
// reactions there; also the greatest error of u over the rim's speed.
Result v16(const Settings& s) {
  constexpr double mu = 100, h = 0.01, ri = 0.4, spin = 1, dt = 1e-6;
  State start = film(make_annulus(ri, 1, mesh_options(s, 1)), h);
  Model m = viscous(mu, s);
  m.bending = Bending::none;
  m.holds.push_back(all(start, axis_bit(2)));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return x.norm() > 1 - 1e-9; }, all_axes, false));
  Hold inner = hold(
      start, [](const Vector3& x) { return x.norm() < ri + 1e-9; }, all_axes, false);
  test::move_steadily(inner, {0, 0, spin});
  m.holds.push_back(inner);
  const Instant i = solve_instant(start, m, dt);
  double torque = 0, worst = 0;
  for (const auto v : inner.vertices) {
    const Vector3 x = i.end.segment<3>(3 * v), f = i.reaction.segment<3>(3 * v);
    torque += x.cross(f).z();
  }
  const double b = spin * ri * ri / (1 - ri * ri); // u = B (1/r - r)
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    const Vector3 x = start.positions[v];
    const Vector3 u = (i.end - i.begin).segment<3>(static_cast<Eigen::Index>(3 * v)) / dt;
    const double r = x.norm();
    worst = std::max(worst, (u - b * (1 / (r * r) - 1) * Vector3::UnitZ().cross(x)).norm() / (spin * ri));
  }
  Result result;
  result.value = torque / (4 * pi * mu * h * b);
  result.error = result.value - 1;
  result.vertices = start.positions.size();
  result.edge = mean_edge(start);
  result.steps = 1;
  result.iterations = i.iterations;
  result.seconds = i.seconds;
  result.more = {{"velocity_error", worst}};
  return result;
}

// V17: a pinned square inviscid film: z = a sin(π x) sin(π y) sin(ω t), ω = π sqrt(2) sqrt(2γ/(ρ h)), one period; the
// amplitude a = 1e-3 is that of the start velocity. Error: the mode's greatest deviation from a sin(ω t), over a.
Result v17(const Settings& s) {
  constexpr double rho = 1000, h = 1e-3, tension = 0.05, a = 1e-3;
  const double omega = pi * std::sqrt(2.0) * std::sqrt(2 * tension / (rho * h));
  State start = film(make_rectangle(1, 1, mesh_options(s, 1)), h);
  Model m;
  m.liquid.density = rho;
  m.liquid.surface_tension = tension;
  const auto shape = [](const Vector3& x) { return std::cos(pi * x.x()) * std::cos(pi * x.y()); };
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v].z() = a * omega * shape(start.positions[v]);
  m.holds.push_back(all(start, axis_bit(0) | axis_bit(1)));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return std::max(std::abs(x.x()), std::abs(x.y())) > 0.5 - 1e-9; }, all_axes,
      false));
  double worst = 0;
  Run run(std::move(start), m, s, 1);
  run.advance(2 * pi / omega, s.steps, [&](const State& at) {
    double up = 0, down = 0;
    for (const Vector3& x : at.positions)
      up += shape(x) * x.z(), down += shape(x) * shape(x);
    const double off = up / down / a - std::sin(omega * at.time);
    worst = std::abs(off) > std::abs(worst) ? off : worst;
  });
  return run.result(1 + worst);
}

// V28: a free disk of 10 mm and 0.1 mm thickness with a noise of 5 µm contracts as V8, for 0.5 s, by 3.3 %. No net
// stress is left in it, so nothing bends it: whatever holds the noise (bending its curvature, so its height; the
// membrane its slope, so its height over the radius), its height stays, or shrinks with the radius. Tension and the
// viscous membrane that did not act on the same area would together bend up directors at the rate γ l²/(2 μ h³).
Result v28(const Settings& s) {
  constexpr double mu = 1000, h = 1e-4, rho = 980, tension = 0.021, radius = 0.01, until = 0.5, noise = 5e-6;
  State start = film(make_disk(radius, mesh_options(s, radius)), h);
  Model m = viscous(mu, s);
  m.liquid.surface_tension = tension;
  m.liquid.density = rho;
  m.inertia = true; // nothing holds it
  std::mt19937_64 engine(s.seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  for (Vector3& x : start.positions)
    x.z() = uniform(engine);
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = -tension / (3 * mu * h) * start.positions[v];
  const double area = sheet_area(start), rough = roughness(start);
  Run run(std::move(start), m, s, radius);
  run.advance(until, s.steps);
  Result r = run.result(roughness(run.state()) / rough);
  const double shrunk = 1 / (1 + 2 * tension * until / (3 * mu * h)); // the area
  r.more = {{"area_error", sheet_area(run.state()) / area / shrunk - 1}, {"radius", std::sqrt(shrunk)}};
  return r;
}

} // namespace sheet::validation
