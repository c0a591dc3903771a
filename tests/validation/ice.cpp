// SPDX-License-Identifier: GPL-3.0-or-later
// V37: ice that floats on the sea, by Glen's law, n = 3, of hardness B = 1.9e8 Pa s^(1/3): τ = B 2^(-1/3) γ̇^(1/3).
// Where its width is held, the rate u' = C h³, C = (ρ g (1 - ρ/ρ_w)/(4 B))³, whatever lies beyond [van der Veen 1983].
#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/core.h>

#include "libsheet/flow/emit.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double ice = 910, sea = 1028, gravity = 9.81, hardness = 1.9e8, year = 3.15569259747e7; // as in PISM's test V
constexpr double thickness = 600, inflow = 300 / year, rate_unit = 1e-10;
const double driving = ice * gravity * (1 - ice / sea);         // over the thickness, of ρ g (1 - ρ/ρ_w) h [Pa/m]
const double spreading = std::pow(driving / (4 * hardness), 3); // C
const double viscosity = hardness * std::pow(2, -1.0 / 3) * std::pow(rate_unit, -2.0 / 3); // at the unit of the rate

Model shelf(const Settings& s) {
  Model m = viscous(viscosity, s);
  m.bending = Bending::none;
  m.liquid.density = ice;
  m.liquid.law = {.kind = FlowLawKind::power, .flow_index = 1.0 / 3, .reference_rate = rate_unit};
  m.gravity = {0, 0, -gravity};
  m.bath = BathLiquid{.density = sea, .spreads = true};
  return m;
}

State afloat(const TriangleMesh& mesh, const std::function<double(const Vector3&)>& thick) {
  State s = film(mesh, 1);
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Corners& c = s.mesh->triangles[t];
    s.volumes[t] *= thick((s.positions[c[0]] + s.positions[c[1]] + s.positions[c[2]]) / 3);
  }
  for (Vector3& x : s.positions)
    x.z() = -ice / sea * thick(x);
  return s;
}

// Its end x = 0 and its width.
void hold_channel(const State& s, double width, Model& m) {
  m.holds = {hold(
                 s, [](const Vector3& x) { return x.x() < 1e-6; }, axis_bit(0), false),
             hold(
                 s, [=](const Vector3& x) { return x.y() < 1e-6 || x.y() > width - 1e-6; }, axis_bit(1), false)};
}

// Held at x = 0, its width held: h^-3 = h0^-3 + 3 C t; to half the thickness.
Result slab(const Settings& s) {
  constexpr double length = 1e5;
  const double width = 3 * s.edge * length;
  State start = afloat(strip_mesh(s, length, width), [](const Vector3&) { return thickness; });
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v].x() = spreading * std::pow(thickness, 3) * start.positions[v].x();
  Model m = shelf(s);
  hold_channel(start, width, m);
  Run run(std::move(start), m, s, length);
  run.advance(7 * std::pow(thickness, -3) / (3 * spreading), s.steps);
  double volume = 0;
  for (const double v : run.state().volumes)
    volume += v;
  return run.result(volume / sheet_area(run.state()) / (thickness / 2));
}

// Free all round: its radius grows by A (ρ g (1 - ρ/ρ_w) h)³/72 = ((ρ g (1 - ρ/ρ_w) h/B)³)/72 of itself in a second.
Result disk(const Settings& s) {
  constexpr double radius = 1e5;
  const State start = afloat(make_disk(radius, mesh_options(s, radius)), [](const Vector3&) { return thickness; });
  Model m = shelf(s);
  std::uint32_t middle = 0; // what holds it: this, and that it does not turn one more
  for (std::uint32_t v = 0; v < start.positions.size(); ++v)
    if (start.positions[v].norm() < start.positions[middle].norm())
      middle = v;
  const Vector3 centre = start.positions[middle];
  std::uint32_t beside = middle == 0 ? 1 : 0;
  const auto off_axis = [&](std::uint32_t v) { return std::abs((start.positions[v] - centre).y()); };
  for (std::uint32_t v = 0; v < start.positions.size(); ++v)
    if (v != middle && off_axis(v) < off_axis(beside))
      beside = v;
  const auto pin = [&](std::uint32_t v, Axes axes) {
    Hold& h = m.holds.emplace_back();
    h.vertices = {v};
    h.axes = axes;
  };
  pin(middle, axis_bit(0) | axis_bit(1));
  pin(beside, axis_bit(1));
  const double rate = std::pow(driving * thickness / hardness, 3) / 72, dt = 1e-5 / rate;
  const double area = sheet_area(start);
  Run run(start, m, s, radius);
  run.tolerance = 1e-10;
  run.advance(dt, 1);
  return run.result((std::sqrt(sheet_area(run.state()) / area) - 1) / (rate * dt));
}

// As thick as 500 m at x = 0 and 100 m at its front, its width held: there it is as fast as L (P0⁴ - P1⁴)/(4 (P0 -
// P1)), P = ρ g (1 - ρ/ρ_w) h/(4B), faster than at x = 0 [as icepack's verification].
Result wedge(const Settings& s) {
  constexpr double length = 1e5, thick = 500, thin = 100;
  const double width = 3 * s.edge * length;
  const State start =
      afloat(strip_mesh(s, length, width), [](const Vector3& x) { return thick + (thin - thick) * x.x() / length; });
  Model m = shelf(s);
  hold_channel(start, width, m);
  const double unit = driving / (4 * hardness),
               speed = length * std::pow(unit, 3) * (std::pow(thick, 4) - std::pow(thin, 4)) / (4 * (thick - thin));
  const double dt = 1e-4 * length / speed;
  Run run(start, m, s, length);
  run.tolerance = 1e-10;
  run.advance(dt, 1);
  double front = 0;
  for (const Vector3& x : run.state().positions)
    front = std::max(front, x.x());
  return run.result((front - length) / (speed * dt));
}

// The shelf that enters at x = 0, 600 m thick, at 300 m a year, into open water: h = (4 C x/Q + h0^-4)^(-1/4), its
// front at x = Q/(4C) ((3 C t + h0^-3)^(4/3) - h0^-4), Q = u0 h0 [PISM, test V].
class InflowingShelf {
public:
  [[nodiscard]] double thickness_at(double x) const {
    return std::pow(4 * spreading * x / flux_ + std::pow(thickness, -4), -0.25);
  }
  [[nodiscard]] double front(double t) const {
    return flux_ / (4 * spreading) *
           (std::pow(3 * spreading * t + std::pow(thickness, -3), 4.0 / 3) - std::pow(thickness, -4));
  }

private:
  double flux_ = inflow * thickness;
};

// Begins when a row has entered. More: the front at earlier times.
Result entering(const Settings& s) {
  constexpr double years = 300, length = 1e5;
  constexpr std::array<double, 3> earlier = {50, 100, 200};
  const InflowingShelf exact;
  const double edge = s.edge * length, first = edge / inflow, before = exact.front(first), width = 3 * edge;
  const Scene scene = parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [{}, {}]\ncenter = [{}, 0, {}]\nedge_length = {}\n"
                  "thickness = {}\nseed = {}\n[material]\nlaw = \"power\"\nflow_index = {}\nreference_rate = {}\n"
                  "viscosity = {}\ndensity = {}\n[environment]\ngravity = [0, 0, {}]\nbath = {{density = {}, level = "
                  "0, spreads = true}}\n[model]\ninertia = false\n"
                  "bending = false\n[inflow]\nregion = \"x_min\"\n"
                  "velocity = [{}, 0, 0]\n[[hold]]\nregion = \"y_min\"\naxes = \"y\"\n[[hold]]\nregion = \"y_max\"\n"
                  "axes = \"y\"\n",
                  before, width, before / 2, -ice / sea * thickness, edge, thickness, s.seed, 1.0 / 3, rate_unit,
                  viscosity, ice, -gravity, sea, inflow),
      "V37");
  formats::Frame frame = build_frame(scene);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    double x = 0;
    for (const auto v : c)
      x += positions(frame)[v].x() / 3;
    volumes(frame)[t] *= exact.thickness_at(x) / thickness;
  }
  for (Vector3& x : positions(frame))
    x.z() = -ice / sea * exact.thickness_at(x.x());
  const auto front = [&] {
    double most = 0;
    for (const Vector3& x : positions(frame))
      most = std::max(most, x.x());
    return most;
  };
  StepStageOptions options;
  options.dt = (years * year - first) / s.steps;
  options.scheme = s.scheme;
  options.failed = "";
  StepStage stage(options);
  flow::EmitStage flow;
  Result result;
  const auto start = std::chrono::steady_clock::now();
  double last_time = first, last_front = before;
  for (int k = 0; k < s.steps; ++k) {
    flow.emit(frame);
    stage.step(frame);
    const double now = first + frame.time, at = front();
    for (const double t : earlier)
      if (last_time < t * year && now >= t * year) {
        const double part = (t * year - last_time) / (now - last_time);
        result.more.emplace_back(fmt::format("front_{}", t),
                                 ((1 - part) * last_front + part * at) / exact.front(t * year) - 1);
      }
    last_time = now, last_front = at;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.value = last_front / exact.front(years * year);
  result.error = result.value - 1;
  result.vertices = frame.vertices;
  result.edge = s.edge;
  result.steps = s.steps;
  return result;
}

} // namespace

Result v37(const Settings& s) {
  switch (s.set) {
  case 1:
    return slab(s);
  case 2:
    return disk(s);
  case 3:
    return wedge(s);
  default:
    return entering(s);
  }
}

} // namespace sheet::validation
