// SPDX-License-Identifier: GPL-3.0-or-later
// V5, V6: a strip pulled by a constant force. V13, V32: the viscous catenary. V15: a strip compressed on a bath.
#include "tests/support/holds.h"
#include "tests/validation/instant.h"
#include "tests/validation/liquids.h"

namespace sheet::validation {

namespace {

constexpr double strip_width = 0.25;

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

// Edges of the rim along the two long sides.
void clamp_sides(const State& s, Hold& side) {
  for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e) {
    const double a = s.positions[s.mesh->edges[e][0]].y(), b = s.positions[s.mesh->edges[e][1]].y();
    if (s.mesh->on_rim(e) && near(a, b) && (near(a, 0) || near(a, strip_width)))
      side.clamped_edges.push_back(e);
  }
}

Hold sides_across(const State& s) {
  Hold side = hold(
      s, [](const Vector3& x) { return near(x.y(), 0) || near(x.y(), strip_width); }, axis_bit(1), false);
  clamp_sides(s, side);
  return side;
}

// The load is a very long, soft spring k (d - L) between each vertex of the moving end and one of the held end, in
// proportion to the edges beside it; the reference is told so: L' = L γ̇(τ)/c, τ = k (d - L) L/(c V), c = √3 with the
// sides free, 2 planar, γ̇(τ) = τ/μ of a Newtonian liquid.
Result pulled(const Settings& s, bool planar, const Liquid& liquid, const std::function<double(double)>& rate,
              double pull, double until) {
  constexpr double h = 0.01, rest = 1e3;
  const double c = planar ? 2 : std::numbers::sqrt3, volume = strip_width * h;
  State start = film(strip_mesh(s, 1, strip_width), h);
  Model m = viscous(1, s);
  m.liquid = liquid;
  m.bending = Bending::none;
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return near(x.x(), 0); }, axis_bit(0), false));
  m.holds.push_back(planar ? sides_across(start)
                           : hold(
                                 start, [](const Vector3& x) { return x.norm() < 1e-9; }, all_axes, false));
  m.holds.push_back(hold(
      start, [](const Vector3&) { return true; }, axis_bit(2), false));
  const auto at_end = [&](std::uint32_t v) { return near(start.positions[v].x(), 1); };
  std::uint32_t anchor = 0;
  std::array<std::uint32_t, 2> idle{no_index, no_index}; // fill the spring's four places with weight 0
  for (std::uint32_t v = 0; v < start.positions.size(); ++v)
    if (near(start.positions[v].x(), 0)) {
      anchor = start.positions[v].norm() < 1e-9 ? v : anchor;
      if (start.positions[v].norm() > 1e-9)
        idle = {idle[1], v};
    }
  std::vector<double> share(start.positions.size(), 0);
  for (const Edge& e : start.mesh->edges)
    if (at_end(e[0]) && at_end(e[1]))
      for (const auto v : e)
        share[v] += (start.positions[e[1]] - start.positions[e[0]]).norm() / (2 * strip_width);
  for (std::uint32_t v = 0; v < share.size(); ++v)
    if (share[v] > 0) {
      ContactSpring spring;
      spring.vertices = {v, anchor, idle[0], idle[1]};
      spring.weights = {1, -1, 0, 0};
      spring.normal = Vector3::UnitX();
      spring.rest = rest;
      spring.stiffness[0] = share[v] * pull / (rest - 1);
      m.contacts.push_back(spring);
    }
  using Y = Eigen::Matrix<double, 1, 1>;
  const double k = pull / (rest - 1);
  const double exact = runge_kutta(Y(1.0), 0, until, 20000, [&](double, const Y& y) {
    return Y(y[0] / c * rate(k * (rest - y[0]) * y[0] / (c * volume)));
  })[0];
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  double length = 0;
  for (std::size_t v = 0; v < share.size(); ++v)
    length += share[v] * run.state().positions[v].x();
  return run.result(length / exact);
}

// The length doubles.
Result pulled_newtonian(const Settings& s, bool planar) {
  constexpr double mu = 100, pull = 1.2; // [Pa s], [N]
  const double trouton = planar ? 4 : 3, volume = strip_width * 0.01;
  return pulled(
      s, planar, {.viscosity = mu}, [](double stress) { return stress / mu; }, pull,
      0.5 * trouton * mu * volume / pull);
}

} // namespace

Result pulled_strip(const Settings& s, bool width_held, const TestedLiquid& liquid, double end) {
  const double c = width_held ? 2 : std::numbers::sqrt3, volume = strip_width * 0.01;
  const Growth growth{tested_stress, 1, c};
  return pulled(s, width_held, liquid.liquid, liquid.rate, c * volume * tested_stress,
                time_of_growth(liquid, growth, end));
}

Result v5(const Settings& s) { return pulled_newtonian(s, false); } // sides free: Trouton's 3 μ
Result v6(const Settings& s) { return pulled_newtonian(s, true); }  // width held: 4 μ

namespace {

constexpr double catenary_density = 1000, catenary_gravity = 9.81;

// Pinned ends, plane strain; `when` it has a sag, how fast it grows then. A parabola that sags from 0.25 % of the span
// (the formulas neglect terms of order (s/L)², below 1e-4).
Result catenary(const Settings& s, const Liquid& liquid, double last, const std::function<double(double)>& when,
                const std::function<double(double)>& speed) {
  constexpr double h = 2.5e-5, first = 0.0025;
  State start = film(strip_mesh(s, 1, strip_width), h);
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    Vector3& x = start.positions[v];
    const double shape = -4 * x.x() * (1 - x.x());
    x.z() = first * shape;
    start.velocities[v].z() = speed(first) * shape;
  }
  start.time = when(first);
  Model m = viscous(1, s);
  m.liquid = liquid;
  m.liquid.density = catenary_density;
  m.gravity = {0, 0, -catenary_gravity};
  m.holds.push_back(sides_across(start));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return near(x.x(), 0) || near(x.x(), 1); }, all_axes, false));
  Run run(std::move(start), m, s, 1);
  run.advance(when(last) - when(first), s.steps);
  // The parabola of least squares.
  double up = 0, down = 0;
  for (const Vector3& x : run.state().positions) {
    const double shape = 4 * x.x() * (1 - x.x());
    up -= shape * x.z(), down += shape * shape;
  }
  return run.result(up / down / last);
}

// Of a power law: tension q L²/(8 s) = 2 K h (2 d/dt(8 s²/(3 L²)))^n, so s^(2 + 1/n) = (2 + 1/n) c t with
// c = (3 L²/32) (ρ g L²/(16 K))^(1/n); from 0.25 to 0.5 % of the span.
Result power_law_catenary(const Settings& s, double consistency, double n, Liquid liquid) {
  const double power = 2 + 1 / n;
  const double c = 3.0 / 32 * std::pow(catenary_density * catenary_gravity / (16 * consistency), 1 / n);
  liquid.viscosity = consistency;
  return catenary(
      s, liquid, 0.005, [=](double sag) { return std::pow(sag, power) / (power * c); },
      [=](double sag) { return c * std::pow(sag, 1 - power); });
}

// Of a Bingham liquid: s² s' = c (1 - s/s_f), c = 3 ρ g L⁴/(512 μ), which ends at s_f = ρ g L²/(16 τ_y).
Result bingham_catenary(const Settings& s) {
  constexpr double mu = 100, end = 0.006, c = 3 * catenary_density * catenary_gravity / (512 * mu);
  const Liquid liquid{
      .viscosity = mu,
      .law = {.kind = FlowLawKind::bingham, .yield_stress = catenary_density * catenary_gravity / (16 * end)}};
  return catenary(
      s, liquid, 0.005,
      [=](double sag) {
        const double part = sag / end;
        return -end * end * end * (std::log1p(-part) + part + part * part / 2) / c;
      },
      [=](double sag) { return c * (1 - sag / end) / (sag * sag); });
}

} // namespace

// V13: stretching holds the weight: tension q L²/(8 s) = 4 μ h d/dt(8 s²/(3 L²)), so s³ = 9 ρ g L⁴ t/(512 μ).
Result v13(const Settings& s) { return power_law_catenary(s, 100, 1, {}); }

// V32: the same of liquids that are not Newtonian; K such that the first sag grows about as fast.
Result v32(const Settings& s) {
  if (s.set == 4)
    return bingham_catenary(s);
  constexpr double indices[3] = {1.0 / 3, 0.5, 1.5};
  const double n = indices[s.set - 1];
  return power_law_catenary(s, 100 * std::pow(0.5, 1 - n), n, {.law = {.kind = FlowLawKind::power, .flow_index = n}});
}

// V15: growth rate of a perturbation a cos(k x) of a strip that is shortened at the rate e, P = 4 μ h e, on a bath:
// σ = ((P - 2γ) k² - ρ_b g)/(D k⁴), D = μ h³/3, fastest at k_m² = 2 ρ_b g/(P - 2γ). The strip is two wavelengths long,
// its ends move inwards and keep their normals upright. Sets 1 to 5: k/k_m = 0.8, 0.9, 1, 1.25, 1.6. The edge length is
// relative to the wavelength.
Result v15(const Settings& s) {
  constexpr double mu = 1000, h = 0.01, gravity = 10, bath = 1000, tension = 0.5, wave_m = 0.25;
  constexpr double factors[5] = {0.8, 0.9, 1, 1.25, 1.6};
  const double km = 2 * pi / wave_m, net = 2 * bath * gravity / (km * km); // P - 2γ
  const double rate = (net + 2 * tension) / (4 * mu * h);
  const double k = factors[s.set - 1] * km, wave = 2 * pi / k, length = 2 * wave, bending = mu * h * h * h / 3;
  const auto sigma = [&](double q) { return (net * q * q - bath * gravity) / (bending * q * q * q * q); };
  const double amplitude = 1e-4 * h;
  Settings scaled = s;
  scaled.edge = s.edge * wave;
  TriangleMesh mesh = make_rectangle(length, strip_width * wave, mesh_options(scaled, 1));
  State start = film(mesh, h);
  const std::vector<Vector3> flat = start.positions;
  for (std::size_t v = 0; v < flat.size(); ++v) {
    const double shape = amplitude * std::cos(k * (flat[v].x() + length / 2));
    start.positions[v].z() = shape;
    start.velocities[v] = {-rate * flat[v].x(), 0, sigma(k) * shape};
  }
  Model m = viscous(mu, s);
  m.liquid.surface_tension = tension;
  m.gravity = {0, 0, -gravity};
  m.bath = BathLiquid{bath, 0, true};
  const double half = strip_width * wave / 2;
  Hold side = hold(
      start, [&](const Vector3& x) { return near(std::abs(x.y()), half); }, axis_bit(1), false);
  for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e) {
    const double a = flat[start.mesh->edges[e][0]].y(), b = flat[start.mesh->edges[e][1]].y();
    if (start.mesh->on_rim(e) && near(a, b) && near(std::abs(a), half))
      side.clamped_edges.push_back(e);
  }
  m.holds.push_back(side);
  for (const double end : {-0.5, 0.5}) {
    Hold h_end = hold(
        start, [&](const Vector3& x) { return near(x.x(), end * length); }, axis_bit(0), true);
    test::move_steadily(h_end, Vector3::Zero(), {-end * length * rate, 0, 0});
    m.holds.push_back(h_end);
  }
  const double dt = 2e-3 / sigma(km);
  Run run(std::move(start), m, s, wave);
  run.tolerance = 1e-13;
  run.advance(dt, 1);
  double up = 0, down = 0;
  for (std::size_t v = 0; v < flat.size(); ++v) {
    const double shape = std::cos(k * (flat[v].x() + length / 2));
    up += shape * run.state().positions[v].z(), down += shape * shape;
  }
  const double measured = std::log(up / down / amplitude) / dt;
  Result r = run.result(measured / sigma(k));
  r.more = {{"k_over_km", factors[s.set - 1]}, {"growth_rate", measured / sigma(km)}, {"exact", sigma(k) / sigma(km)}};
  return r;
}

} // namespace sheet::validation
