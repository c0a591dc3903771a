// SPDX-License-Identifier: GPL-3.0-or-later
// V22 to V24, V31: liquid that flows along walls. Lubrication theory has neither the sheet's own viscosity along the
// wall nor, at a wall of radius R, anything of the order of h/R: layers are a thousandth as thick as they are long.
#include <algorithm>

#include "libsheet/energy/walls.h"
#include "libsheet/geometry/area.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double thin = 1e-3;                          // thickness over length
constexpr double density = 1, gravity = 1, radius = 1; // units
constexpr double kinematic = 1;                        // viscosity over density

Model layer(const Settings& s, const Vector3& weight) {
  Model m = viscous(kinematic * density, s);
  m.bending = Bending::none; // on a plane
  m.liquid.density = density;
  m.gravity = weight;
  return m;
}

// The plane z = 0, under all of the sheet.
Wall floor_under(const State& s) {
  Wall wall;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [](double, const Vector3& x) { return WallPoint{x.z(), Vector3::UnitZ()}; };
  return wall;
}

// Thickness as a function of place, times what makes the volume that.
void set_thickness(State& s, double volume, const std::function<double(const Vector3&)>& thickness) {
  double sum = 0;
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Corners& c = s.mesh->triangles[t];
    const Vector3 middle = (s.positions[c[0]] + s.positions[c[1]] + s.positions[c[2]]) / 3;
    s.volumes[t] = thickness(middle) * TriangleArea(s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]).area;
    sum += s.volumes[t];
  }
  for (double& v : s.volumes)
    v *= volume / sum;
}

// Parts of a run of equal ratio, as a similarity solution slows down, each in equal steps.
void advance_in_ratio(Run& run, double from, double to, int steps) {
  constexpr int parts = 10;
  const double ratio = std::pow(to / from, 1.0 / parts);
  for (int k = 0; k < parts; ++k)
    run.advance(from * std::pow(ratio, k) * (ratio - 1), std::max(1, steps / parts));
}

double thickness_of(const State& s) {
  double volume = 0;
  for (const double v : s.volumes)
    volume += v;
  return volume / sheet_area(s);
}

// A strip along x, between walls y = 0 and y = width that do not drag; its end x = 0 held along `axes`.
struct Channel {
  State state;
  double width;
};

Channel channel(const Settings& s, double length, double thickness) {
  const double width = 3 * s.edge * length;
  return {film(strip_mesh(s, length, width), thickness), width};
}

void hold_channel(const Channel& c, Axes at_start, Model& m) {
  m.holds.push_back(hold(
      c.state, [&](const Vector3& x) { return x.y() < 1e-9 || x.y() > c.width - 1e-9; }, axis_bit(1), false));
  if (at_start != 0)
    m.holds.push_back(hold(
        c.state, [](const Vector3& x) { return x.x() < 1e-9; }, at_start, false));
}

// [Huppert 1982]: in a plane x_N = 1.41124 (g q³ t/(3 ν))^(1/5), about an axis r_N = 0.89391 (g Q³ t/(3 ν))^(1/8), for
// q of a half and Q of all; h ~ (1 - (x/x_N)²)^(1/3). From then on 32 times as long.
Result spreading(const Settings& s, bool axis) {
  constexpr double times = 32;
  const double power = axis ? 1.0 / 8 : 1.0 / 5, constant = axis ? 0.89391 : 1.41124;
  const auto profile = [](const Vector3& x) { return std::cbrt(std::max(0.0, 1 - x.squaredNorm())); };
  const auto along = [](const Vector3& x) { return std::cbrt(std::max(0.0, 1 - x.x() * x.x())); };
  Channel c = axis ? Channel{film(make_disk(radius, mesh_options(s, radius)), thin), 0} : channel(s, radius, thin);
  const double amount = axis ? pi * thin : thin; // of all, of a half and unit width
  if (axis)
    set_thickness(c.state, amount, profile);
  else
    set_thickness(c.state, amount * c.width, along);
  Model m = layer(s, {0, 0, -gravity});
  if (!axis)
    hold_channel(c, axis_bit(0), m);
  m.walls.push_back(floor_under(c.state));
  const double from = std::pow(radius / constant, 1 / power) * 3 * kinematic / (gravity * std::pow(amount, 3));
  const double width = c.width;
  Run run(std::move(c.state), m, s, radius);
  advance_in_ratio(run, from, times * from, s.steps);
  const double area = sheet_area(run.state()), front = axis ? std::sqrt(area / pi) : area / width;
  Result r = run.result(front / (radius * std::pow(times, power)));
  if (axis) { // how round it is
    double low = 1e9, high = 0;
    const Connectivity& mesh = *run.state().mesh;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      if (mesh.on_rim(e))
        for (const auto v : mesh.edges[e]) {
          const double at = run.state().positions[v].head<2>().norm();
          low = std::min(low, at);
          high = std::max(high, at);
        }
    r.more = {{"scatter of the rim", (high - low) / (high + low)}};
  }
  return r;
}

} // namespace

Result v22(const Settings& s) { return spreading(s, s.set == 2); }

// A block on an incline whose upper end stays: from 1.5 times its length on, x_N = (9 A² g sin(a) t/(4 ν))^(1/3), A of
// a unit width [Huppert 1982]; to 3 times its length.
Result v23(const Settings& s) {
  const double angle = pi / 4;
  Channel c = channel(s, radius, thin);
  Model m = layer(s, gravity * Vector3(std::sin(angle), 0, -std::cos(angle)));
  hold_channel(c, all_axes, m);
  m.walls.push_back(floor_under(c.state));
  const double speed = gravity * std::sin(angle) * thin * thin / kinematic, until = 12 * radius / speed;
  const double width = c.width;
  Run run(std::move(c.state), m, s, radius);
  run.advance(until, s.steps);
  return run.result(sheet_area(run.state()) / width / (3 * radius));
}

namespace {

// u = g h (h + 3 b) sin(a)/(3 ν), b the slip length.
Result down_an_incline(const Settings& s, double slip_length) {
  Channel c = channel(s, radius, thin);
  Model m = layer(s, {gravity, 0, 0});
  hold_channel(c, 0, m);
  m.walls.push_back(floor_under(c.state));
  m.walls.back().slip_length = slip_length;
  const double speed = gravity * thin * (thin + 3 * slip_length) / (3 * kinematic), until = 2 * radius / speed;
  const Vector3 start = c.state.positions.front();
  Run run(std::move(c.state), m, s, radius);
  run.advance(until, s.steps);
  return run.result((run.state().positions.front() - start).x() / (speed * until));
}

// Of a liquid that is not Newtonian: the speed that its law has.
Result curved_down_an_incline(const Settings& s, const Liquid& liquid, double slip_length, double exact) {
  Channel c = channel(s, radius, thin);
  Model m = layer(s, {gravity, 0, 0});
  m.liquid = liquid;
  m.liquid.density = density;
  hold_channel(c, 0, m);
  m.walls.push_back(floor_under(c.state));
  m.walls.back().slip_length = slip_length;
  const double until = 2 * radius / exact;
  const Vector3 start = c.state.positions.front();
  Run run(std::move(c.state), m, s, radius);
  run.advance(until, s.steps);
  return run.result((run.state().positions.front() - start).x() / (exact * until));
}

// τ = τ_y + K γ̇^n, s = τ_w - τ_y, m = 1/n: u = h K^-m s^(m+1)/τ_w² (s/(m+2) + τ_y/(m+1)) + b (s/K)^m.
Result herschel_bulkley_down_an_incline(const Settings& s, double yield_part, double n, double slip_length) {
  const double stress = density * gravity * thin, yield = yield_part * stress, above = stress - yield, m = 1 / n;
  const Liquid liquid{.viscosity = kinematic * density,
                      .law = {.kind = FlowLawKind::herschel_bulkley, .flow_index = n, .yield_stress = yield}};
  const double consistency = liquid.viscosity; // at 1/s
  const double exact = thin * std::pow(consistency, -m) * std::pow(above, m + 1) / (stress * stress) *
                           (above / (m + 2) + yield / (m + 1)) +
                       slip_length * std::pow(above / consistency, m);
  return curved_down_an_incline(s, liquid, slip_length, exact);
}

// n/(2n + 1) h (τ_w/K)^(1/n).
Result power_law_down_an_incline(const Settings& s, double n) {
  const double rate = std::pow(density * gravity * thin / (kinematic * density), 1 / n);
  return curved_down_an_incline(
      s, {.viscosity = kinematic * density, .law = {.kind = FlowLawKind::power, .flow_index = n, .rest_rate = 1e-16}},
      0, n / (2 * n + 1) * thin * rate);
}

// A layer of this thickness and yield stress slumps until it rests, which it comes near algebraically: its length over
// that which is due, by its area and, in a channel, the width that it keeps.
Result slumped(const Settings& s, Channel c, double thickness, double yield_stress,
               const std::function<double(double area, double width)>& over_what_is_due) {
  Model m = layer(s, {0, 0, -gravity});
  m.liquid.law = {.kind = FlowLawKind::bingham, .yield_stress = yield_stress};
  m.liquid.law.rest_rate = 1e-6 * m.liquid.law.yield_stress / m.liquid.viscosity;
  if (c.width > 0)
    hold_channel(c, axis_bit(0), m);
  m.walls.push_back(floor_under(c.state));
  const double time = 3 * kinematic * radius * radius / (gravity * std::pow(thickness, 3)), width = c.width;
  Run run(std::move(c.state), m, s, radius);
  run.advance(1e-3 * time, 4);
  advance_in_ratio(run, 1e-3 * time, 1e3 * time, s.steps);
  return run.result(over_what_is_due(sheet_area(run.state()), width));
}

// A Bingham liquid slumps until its weight no longer overcomes the yield stress at the wall: ρ g h h' = -τ_y, so in a
// plane x_N = (3 q/(2 a))^(2/3), about an axis r_N = (15 Q/(8π a))^(2/5), a = sqrt(2 τ_y/(ρ g)), of a half q or all Q.
// The yield stress is such that the layer becomes 1.5 times as long.
Result slumping(const Settings& s, bool axis) {
  constexpr double end = 1.5;
  Channel c = axis ? Channel{film(make_disk(radius, mesh_options(s, radius)), thin), 0} : channel(s, radius, thin);
  const double amount = axis ? pi * thin : thin;
  const double a = axis ? 15 * amount / (8 * pi * std::pow(end, 2.5)) : 3 * amount / (2 * std::pow(end, 1.5));
  return slumped(s, std::move(c), thin, density * gravity * a * a / 2, [&](double area, double width) {
    return (axis ? std::sqrt(area / pi) : area / width) / (radius * end);
  });
}

// The same of a layer so thick that what bears stretching counts: in a plane (ρ g h²/2 - 2 τ_y h)' = -τ_y, so it ends
// in a step of the height 4 B, B = τ_y/(ρ g), and of the height h at its middle has the length (h²/2 - 2 B h)/B. (Of a
// layer whose shear is at yield at the wall, too, the mean of 2 sqrt(τ_y² - τ²), π/2 τ_y, takes the place of 2 τ_y.)
Result slumping_thickly(const Settings& s) {
  constexpr double end = 1.5, thick = 0.1 * radius, bears = 2;
  Channel c = channel(s, radius, thick);
  const auto length = [](double height) { return height * height / 2 - bears * height; };                // over B
  const auto half = [](double height) { return std::pow(height, 3) / 3 - bears * height * height / 2; }; // over B²
  double low = 2 * bears, high = 1e3; // heights over B: the slenderer, the higher
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high), area = half(middle) - half(2 * bears);
    (area / (length(middle) * length(middle)) > thick / (radius * end * end) ? low : high) = middle;
  }
  return slumped(s, std::move(c), thick, density * gravity * radius * end / length(low),
                 [&](double area, double width) { return area / width / (radius * end); });
}

// A plug of speed U comes to rest after U h²/(3 ν).
Result stopping(const Settings& s) {
  Channel c = channel(s, radius, thin);
  Model m = layer(s, Vector3::Zero());
  m.inertia = true;
  hold_channel(c, 0, m);
  m.walls.push_back(floor_under(c.state));
  const double time = thin * thin / (3 * kinematic), speed = 0.5 * radius / time;
  for (Vector3& v : c.state.velocities)
    v = {speed, 0, 0};
  const Vector3 start = c.state.positions.front();
  Run run(std::move(c.state), m, s, radius);
  run.advance(10 * time, s.steps);
  return run.result((run.state().positions.front() - start).x() / (speed * time * (1 - std::exp(-10.0))));
}

// Without drag: h = h0/(1 + g h0 t/(8 ν)); to half the thickness.
Result free_slip_spreading(const Settings& s) {
  Channel c = channel(s, radius, thin);
  Model m = layer(s, {0, 0, -gravity});
  hold_channel(c, axis_bit(0), m);
  m.walls.push_back(floor_under(c.state));
  m.walls.back().slip_length = free_slip;
  Run run(std::move(c.state), m, s, radius);
  run.advance(8 * kinematic / (gravity * thin), s.steps);
  return run.result(thickness_of(run.state()) / (thin / 2));
}

// On a bath twice as dense, on which it floats: h = h0/(1 + g' h0 t/(8 ν)), g' = g (1 - ρ/ρ_b) [Pegler and Worster
// 2012]; to half the thickness.
Result floating(const Settings& s) {
  constexpr double denser = 2, buoyant = gravity * (1 - 1 / denser);
  Channel c = channel(s, radius, thin);
  for (Vector3& x : c.state.positions)
    x.z() = -thin / denser;
  Model m = layer(s, {0, 0, -gravity});
  hold_channel(c, axis_bit(0), m);
  m.bath = BathLiquid{.density = denser * density, .spreads = true};
  Run run(std::move(c.state), m, s, radius);
  run.advance(8 * kinematic / (buoyant * thin), s.steps);
  return run.result(thickness_of(run.state()) / (thin / 2));
}

// The same as a free disk, which is drawn out both ways: h = h0/(1 + g' h0 t/(6 ν)); to half the thickness.
Result floating_disk(const Settings& s) {
  constexpr double denser = 2, buoyant = gravity * (1 - 1 / denser);
  State state = film(make_disk(radius, mesh_options(s, radius)), thin);
  for (Vector3& x : state.positions)
    x.z() = -thin / denser;
  Model m = layer(s, {0, 0, -gravity});
  m.bath = BathLiquid{.density = denser * density, .spreads = true};
  Run run(std::move(state), m, s, radius);
  run.advance(6 * kinematic / (buoyant * thin), s.steps);
  return run.result(thickness_of(run.state()) / (thin / 2));
}

// The film on top of a cylinder: h = h0/sqrt(1 + 2 g h0² t/(3 ν R)); to half the thickness.
Result on_a_cylinder(const Settings& s) {
  Channel c = channel(s, radius, thin);
  Model m = layer(s, {0, 0, -gravity});
  for (Vector3& x : c.state.positions)
    x = {(radius + thin / 2) * std::sin(x.x()), x.y(), (radius + thin / 2) * std::cos(x.x())};
  hold_channel(c, axis_bit(0), m);
  m.walls.push_back(floor_under(c.state));
  m.walls.back().nearest = [](double, const Vector3& x) {
    const double r = std::hypot(x.x(), x.z());
    return WallPoint{r - radius, Vector3(x.x(), 0, x.z()) / r};
  };
  Run run(std::move(c.state), m, s, radius);
  run.advance(3 * 3 * kinematic * radius / (2 * gravity * thin * thin), s.steps);
  double volume = 0, area = 0; // of what is near the top
  const State& end = run.state();
  for (std::size_t t = 0; t < end.volumes.size(); ++t) {
    const Corners& k = end.mesh->triangles[t];
    const Vector3 &a = end.positions[k[0]], &b = end.positions[k[1]], &d = end.positions[k[2]];
    if (std::max({a.x(), b.x(), d.x()}) > std::max(0.25, 2.5 * s.edge) * radius)
      continue;
    volume += end.volumes[t];
    area += TriangleArea(a, b, d).area;
  }
  return run.result(volume / area / (thin / 2));
}

// Spin coating: h = h0/sqrt(1 + 4 w² h0² t/(3 ν)); to half the thickness, in 3.6 turns.
Result spinning(const Settings& s) {
  const double turn = 3.6 * 2 * pi;                                 // w t
  const double rate = 3 * 3 * kinematic / (4 * thin * thin * turn); // of 4 w² h0² t/(3 ν) = 3
  State state = film(make_disk(radius, mesh_options(s, radius)), thin);
  Model m = layer(s, Vector3::Zero());
  m.inertia = true;
  for (std::size_t v = 0; v < state.positions.size(); ++v)
    state.velocities[v] = rate * Vector3::UnitZ().cross(state.positions[v]);
  m.walls.push_back(floor_under(state));
  m.walls.back().motion = [=](double from, double to) {
    return RigidMotion{Eigen::AngleAxisd(rate * (to - from), Vector3::UnitZ()).toRotationMatrix(), Vector3::Zero()};
  };
  m.walls.back().velocity = [=](double, const Vector3& x) { return Vector3(rate * Vector3::UnitZ().cross(x)); };
  Run run(std::move(state), m, s, radius);
  run.advance(turn / rate, s.steps);
  return run.result(thickness_of(run.state()) / (thin / 2));
}

// At rest: h = sqrt(2 γ (1 - cos θ)/(ρ g)).
Result puddle(const Settings& s) {
  const double angle = pi / 3, height = 1.5 * thin;
  Channel c = channel(s, radius, thin);
  Model m = layer(s, {0, 0, -gravity});
  hold_channel(c, axis_bit(0), m);
  m.liquid.surface_tension = density * gravity * height * height / (2 * (1 - std::cos(angle)));
  m.walls.push_back(floor_under(c.state));
  m.walls.back().wetting = 1 - std::cos(angle);
  Run run(std::move(c.state), m, s, radius);
  run.advance(300 * 3 * kinematic * radius * radius / (gravity * thin * thin * thin), s.steps);
  return run.result(thickness_of(run.state()) / height);
}

} // namespace

Result v24(const Settings& s) {
  switch (s.set) {
  case 1:
    return down_an_incline(s, 0);
  case 2:
    return down_an_incline(s, 0.3 * thin);
  case 3:
    return stopping(s);
  case 4:
    return free_slip_spreading(s);
  case 5:
    return on_a_cylinder(s);
  case 6:
    return spinning(s);
  case 7:
    return puddle(s);
  case 8:
    return floating(s);
  default:
    return floating_disk(s);
  }
}

Result v31(const Settings& s) {
  switch (s.set) {
  case 1:
    return herschel_bulkley_down_an_incline(s, 0.4, 0.5, 0);
  case 2:
    return herschel_bulkley_down_an_incline(s, 0.4, 0.5, 0.3 * thin);
  case 3:
    return power_law_down_an_incline(s, 1.0 / 3);
  case 6:
    return slumping_thickly(s);
  default:
    return slumping(s, s.set == 5);
  }
}

} // namespace sheet::validation
