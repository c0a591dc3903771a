// SPDX-License-Identifier: GPL-3.0-or-later
// V33: the load from which on a Bingham liquid flows. Yield stress, viscosity and size are 1.
#include <algorithm>

#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double thin = 0.02, rest = 1e-7; // thickness, rest rate
constexpr double flows = 1e-5;             // speed, in the unit of a flow that its yield stress drives
constexpr double sqrt3 = std::numbers::sqrt3;

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

// What is loaded, and by what, as a multiple of the closed form.
struct Loaded {
  State start;
  Model model;
  double unit; // of speed: a film 1, a plate, which deflects by its length while its faces strain by h/L, L/h
  std::function<void(Model&, double load)> put = {};
  Axes outwards = 0; // only the mean way outwards along these counts: what encloses a volume finds its round shape
};

Hold everything(const State& s, Axes axes) {
  return hold(
      s, [](const Vector3&) { return true; }, axes, false);
}

Hold at_x(const State& s, double x, Axes axes) {
  return hold(
      s, [=](const Vector3& at) { return near(at.x(), x); }, axes, false);
}

double strip_width(const Settings& s) { return 3 * s.edge; }

TriangleMesh strip(const Settings& s) { return strip_mesh(s, 1, strip_width(s)); }

// The sides of a strip, that their normals keep, too.
Hold across(const State& s, const Settings& settings) {
  const double width = strip_width(settings);
  const auto at_side = [=](const Vector3& x) { return near(x.y(), 0) || near(x.y(), width); };
  Hold side = hold(s, at_side, axis_bit(1), false);
  for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e) {
    const Vector3 &a = s.positions[s.mesh->edges[e][0]], &b = s.positions[s.mesh->edges[e][1]];
    if (s.mesh->on_rim(e) && near(a.y(), b.y()) && at_side(a))
      side.clamped_edges.push_back(e);
  }
  return side;
}

// What is not flat bends: nothing else holds the vertices of a polyhedron that does not yield.
Loaded bingham(const Settings& s, const TriangleMesh& mesh, Bending bending, double unit = 1) {
  Loaded l{film(mesh, thin), viscous(1, s), unit};
  l.model.liquid.law = {.kind = FlowLawKind::bingham, .yield_stress = 1, .rest_rate = rest};
  l.model.bending = bending;
  return l;
}

// 2√3 τ_y h/R, a tube 2 τ_y h/R.
Loaded balloon(const Settings& s) {
  Loaded l = bingham(s, make_sphere(1, mesh_options(s, 1)), Bending::mid_edge);
  l.outwards = all_axes;
  l.put = [](Model& m, double load) {
    m.pressures = {PressureLaw{PressureLaw::Kind::constant, load * 2 * sqrt3 * thin, 1, 1}};
  };
  return l;
}

Loaded tube(const Settings& s) {
  Loaded l = bingham(s, make_tube(1, 2, mesh_options(s, 1)), Bending::mid_edge);
  l.outwards = axis_bit(0) | axis_bit(1);
  l.model.holds = {hold(
      l.start, [](const Vector3& x) { return std::abs(x.z()) > 1 - 1e-9; }, axis_bit(2), false)};
  l.put = [](Model& m, double load) {
    m.pressures = {PressureLaw{PressureLaw::Kind::constant, load * 2 * thin, 1, 1}};
  };
  return l;
}

// Its length is √3 τ_y/(ρ g), with its width held 2 τ_y/(ρ g).
Loaded hanging(const Settings& s, bool wide) {
  Loaded l = bingham(s, strip(s), Bending::none, 0.1); // only its upper end flows
  l.model.holds = {everything(l.start, axis_bit(2)), at_x(l.start, 0, axis_bit(0)),
                   wide ? across(l.start, s)
                        : hold(
                              l.start, [](const Vector3& x) { return x.norm() < 1e-9; }, axis_bit(1), false)};
  l.put = [wide](Model& m, double load) {
    m.liquid.density = 1;
    m.gravity = {load * (wide ? 2 : sqrt3), 0, 0};
  };
  return l;
}

// Its tension is τ_y h of each surface, be the rim straight or a hole's, whose film is so large that nothing reaches
// its outer rim.
void pull_by_tension(Loaded& l) {
  l.put = [](Model& m, double load) { m.liquid.surface_tension = load * thin; };
}

Loaded rim(const Settings& s) {
  Loaded l = bingham(s, strip(s), Bending::none);
  l.model.holds = {everything(l.start, axis_bit(2)), at_x(l.start, 0, axis_bit(0)), across(l.start, s)};
  pull_by_tension(l);
  return l;
}

Loaded hole(const Settings& s) {
  Loaded l = bingham(s, make_annulus(1, 1.4, mesh_options(s, 1)), Bending::none);
  l.model.holds = {everything(l.start, axis_bit(2)),
                   hold(
                       l.start, [](const Vector3& x) { return x.norm() > 1.4 - 1e-9; }, all_axes, false)};
  pull_by_tension(l);
  return l;
}

// τ_y = ρ g h sin a.
Loaded incline(const Settings& s) {
  Loaded l = bingham(s, strip(s), Bending::none);
  l.unit = thin;
  for (Vector3& x : l.start.positions)
    x.z() = thin / 2;
  l.model.holds = {across(l.start, s)};
  Wall wall;
  for (std::uint32_t v = 0; v < l.start.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [](double, const Vector3& x) { return WallPoint{x.z(), Vector3::UnitZ()}; };
  l.model.walls = {wall};
  l.put = [](Model& m, double load) {
    m.liquid.density = 1;
    m.gravity = {load / thin, 0, 0};
  };
  return l;
}

void weigh_down(Loaded& l, double limit) { // of ρ g h L²/(τ_y h²)
  l.put = [limit](Model& m, double load) {
    m.liquid.density = 1;
    m.gravity = {0, 0, -load * limit * thin};
  };
}

// A strip in plane strain, a moment of τ_y h²/2 at its hinges: held at one end ρ g h L² = τ_y h², supported at both 4
// τ_y h², clamped at both 8 τ_y h². The other end may slide, so that nothing pulls.
Loaded span(const Settings& s, bool clamped, bool other_end) {
  Loaded l = bingham(s, strip(s), Bending::mid_edge, 1 / thin);
  l.model.holds = {across(l.start, s)};
  for (const double end : {0.0, 1.0})
    if (end == 0 || other_end)
      l.model.holds.push_back(hold(
          l.start, [=](const Vector3& x) { return near(x.x(), end); }, end == 0 ? all_axes : axis_bit(1) | axis_bit(2),
          clamped));
  weigh_down(l, !other_end ? 1 : clamped ? 8 : 4);
  return l;
}

// Under q = ρ g h, by the yield condition of Mises: q R² = 2.8217 τ_y h² supported, 5.4350 τ_y h² clamped (6.516 and
// 12.552 M0, M0 = √3 τ_y h²/4) [as Hopkins and Wang 1954, by limit analysis with 400 rings].
Loaded round_plate(const Settings& s, bool clamped) {
  Loaded l = bingham(s, make_disk(1, mesh_options(s, 1)), Bending::mid_edge, 1 / thin);
  l.model.holds = {hold(
      l.start, [](const Vector3& x) { return x.head<2>().norm() > 1 - 1e-9; }, all_axes, clamped)};
  weigh_down(l, clamped ? 5.4350 : 2.8217);
  return l;
}

Loaded loaded(const Settings& s) {
  switch (s.set) {
  case 1:
    return balloon(s);
  case 2:
    return tube(s);
  case 3:
  case 4:
    return hanging(s, s.set == 4);
  case 5:
    return rim(s);
  case 6:
    return hole(s);
  case 7:
    return incline(s);
  case 8:
    return span(s, true, false);
  case 9:
    return span(s, false, true);
  case 10:
    return span(s, true, true);
  default:
    return round_plate(s, s.set == 12);
  }
}

// How far it has come from where it was: the mean way outwards, or the greatest way of all.
double way(const Loaded& l, const State& end) {
  double most = 0, sum = 0;
  for (std::size_t v = 0; v < end.positions.size(); ++v) {
    Vector3 outwards = l.start.positions[v];
    for (int k = 0; k < 3; ++k)
      if (!(l.outwards & axis_bit(k)))
        outwards[k] = 0;
    const Vector3 moved = end.positions[v] - l.start.positions[v];
    most = std::max(most, moved.norm());
    sum += l.outwards ? moved.dot(outwards.normalized()) : 0;
  }
  return l.outwards ? sum / static_cast<double>(end.positions.size()) : most;
}

} // namespace

// Value: the load from which on it flows, over the closed form's, by halving its range.
Result v33(const Settings& s) {
  const Loaded l = loaded(s);
  const double dt = 0.01 / l.unit;
  Result sum;
  const auto speed = [&](double load) {
    Model m = l.model;
    l.put(m, load);
    Run run(l.start, m, s, 1);
    run.tolerance = 1e-10;
    run.advance(dt, s.steps);
    const Result r = run.result(1);
    sum.iterations += r.iterations, sum.failed += r.failed, sum.seconds += r.seconds, sum.steps += r.steps;
    return way(l, run.state()) / (l.unit * dt);
  };
  double rests = 0.9, flowing = 1 / rests;
  for (int k = 0; k < 10; ++k) {
    const double middle = std::sqrt(rests * flowing);
    (speed(middle) > flows ? flowing : rests) = middle;
  }
  Result r = Run(l.start, l.model, s, 1).result(std::sqrt(rests * flowing));
  r.iterations = sum.iterations, r.failed = sum.failed, r.seconds = sum.seconds, r.steps = sum.steps;
  return r;
}

} // namespace sheet::validation
