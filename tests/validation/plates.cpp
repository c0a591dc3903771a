// SPDX-License-Identifier: GPL-3.0-or-later
// V11 and V12: start velocities of creeping plates under their weight q = ρ g h. D = μ h³/3, the modulus in plane
// strain, takes the place of the elastic one [Timoshenko, Woinowsky-Krieger 1959, sections 16 and 35], ν = 1/2.
#include <Eigen/Dense>

#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double mu = 100, plate_thickness = 0.02, rho = 1000, standard_gravity = 9.81;
const double flexural = mu * plate_thickness * plate_thickness * plate_thickness / 3,
             load_q = rho * standard_gravity * plate_thickness;
constexpr double wanted_move = 1e-5; // how far the step moves what is measured, in lengths

Model plate(const Settings& s) {
  Model m = viscous(mu, s);
  m.liquid.density = rho;
  m.gravity = {0, 0, -standard_gravity};
  return m;
}

// Deflection of the sheet under the point x, from the vertices around it (their mean where x is no vertex).
double height_at(const State& s, const std::vector<Vector3>& start, const Vector3& x, double radius) {
  double sum = 0, weights = 0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    const double d = (start[v] - x).norm() / radius, w = d < 1 ? (1 - d) * (1 - d) : 0;
    sum += w * (s.positions[v].z() - start[v].z());
    weights += w;
  }
  return sum / weights;
}

// The same mean of the exact deflection, so that averaging costs no accuracy.
template <class F> double exact_at(const std::vector<Vector3>& start, const Vector3& x, double radius, F&& f) {
  double sum = 0, weights = 0;
  for (const Vector3& y : start) {
    const double d = (y - x).norm() / radius, w = d < 1 ? (1 - d) * (1 - d) : 0;
    sum += w * f(y);
    weights += w;
  }
  return sum / weights;
}

// A beam of unit length that is a quarter circle (radius 2/π) hanging from a clamp at φ = 0 where it is horizontal, or
// clamped at both ends: inextensional up to N/(4 μ h). Linear in the unknown force and moment at the end φ = π/2, which
// the end conditions fix. Returns velocities at n + 1 points along it.
std::vector<Eigen::Vector2d> arch(bool both_ends) {
  constexpr int n = 20000;
  const double r = 2 / pi;
  using V = Eigen::Vector2d;
  const auto point = [&](double phi) { return V(r * std::sin(phi), r * (1 - std::cos(phi))); };
  struct Motion {
    std::vector<V> velocity;
    double turn;
  };
  // load: weight on or off; end force f and moment m on the last cross-section.
  const auto motion = [&](double load, const V& f, double m) {
    std::vector<V> velocity(n + 1, V::Zero());
    double turn = 0, ds = 1.0 / n;
    // Midpoint rule along the arc.
    for (int k = 0; k < n; ++k) {
      const double phi = (k + 0.5) * ds / r;
      const V x = point(phi), t(std::cos(phi), std::sin(phi)), arm = point(pi / 2) - x;
      // Weight beyond φ: q ∫ (x(ψ) - x(φ)) r dψ = q r² (cosφ - (π/2 - φ) sinφ).
      const double rest = pi / 2 - phi;
      const double moment =
          m + arm[0] * f[1] - arm[1] * f[0] - load * load_q * r * r * (std::cos(phi) - rest * std::sin(phi));
      const V force = f + V(0, -load * load_q * r * rest);
      const double bend = moment / flexural, stretch = force.dot(t) / (4 * mu * plate_thickness);
      const double middle = turn + 0.5 * ds * bend;
      velocity[static_cast<std::size_t>(k) + 1] =
          velocity[static_cast<std::size_t>(k)] + ds * (middle * V(-t[1], t[0]) + stretch * t);
      turn += ds * bend;
    }
    return Motion{velocity, turn};
  };
  if (!both_ends)
    return motion(1, V::Zero(), 0).velocity;
  const Motion base = motion(1, V::Zero(), 0);
  const Motion unit[3] = {motion(0, V(1, 0), 0), motion(0, V(0, 1), 0), motion(0, V::Zero(), 1)};
  Eigen::Matrix3d a;
  for (int k = 0; k < 3; ++k)
    a.col(k) << unit[k].velocity.back(), unit[k].turn;
  const Eigen::Vector3d x =
      a.fullPivLu().solve(-Eigen::Vector3d(base.velocity.back()[0], base.velocity.back()[1], base.turn));
  return motion(1, V(x[0], x[1]), x[2]).velocity;
}

} // namespace

// Sets: 1 clamped, w = q (R² - r²)²/(64 D); 2 simply supported, w = q (R² - r²)((5+ν)/(1+ν) R² - r²)/(64 D).
Result v11(const Settings& s) {
  State start = film(make_disk(1, mesh_options(s, 1)), plate_thickness);
  const Where rim = [](const Vector3& x) { return x.head<2>().norm() > 1 - 1e-9; };
  Model m = plate(s);
  const std::vector<Vector3> disk = start.positions;
  m.holds.push_back(s.set == 1 ? clamp(start, s, rim) : hold(start, rim, all_axes, false));
  const double ratio = s.set == 1 ? 1 : 5.5 / 1.5, centre = load_q * ratio / (64 * flexural), dt = wanted_move / centre;
  Run run(std::move(start), m, s, 1);
  run.advance(dt, 1);
  const double radius = 2 * s.edge;
  const double moved = height_at(run.state(), disk, Vector3::Zero(), radius);
  const double exact = exact_at(disk, Vector3::Zero(), radius, [&](const Vector3& x) {
    const double r2 = x.squaredNorm();
    return -dt * load_q / (64 * flexural) * (1 - r2) * (ratio - r2);
  });
  Result r = run.result(moved / exact);
  r.more = {{"centre_speed", centre}};
  return r;
}

// Strips of span 1, a quarter as wide, in plane strain: sides held across, their normals too (directors). Sets:
// 1 clamped at both ends, 2 simply supported, 3 cantilever (tip), 4 quarter-cylinder cantilever (tip), 5
// quarter-cylinder arch clamped at both ends (middle); 4 and 5 are 1 along the arc.
Result v12(const Settings& s) {
  const double width = 0.25;
  TriangleMesh mesh = strip_mesh(s, 1, width);
  const std::vector<Vector3> flat = mesh.positions;
  const bool curved = s.set >= 4, both = s.set == 1 || s.set == 2 || s.set == 5;
  if (curved)
    for (Vector3& x : mesh.positions) {
      const double r = 2 / pi, phi = x.x() / r;
      x = {r * std::sin(phi), x.y(), r * (1 - std::cos(phi))};
    }
  // Volumes of the flat sheet: thickness h along the arc.
  State start = film(mesh, plate_thickness);
  if (curved) {
    TriangleMesh unrolled = mesh;
    unrolled.positions = flat;
    start.volumes = film(unrolled, plate_thickness).volumes;
  }
  Model m = plate(s);
  const auto near = [&](double a, double b) { return std::abs(a - b) < 1e-9; };
  const Vector3 last = curved ? Vector3(2 / pi, 0, 2 / pi) : Vector3(1, 0, 0);
  const Where ends = [&](const Vector3& x) {
    return (near(x.x(), 0) && near(x.z(), 0)) || (both && near(x.x(), last.x()) && near(x.z(), last.z()));
  };
  const Where sides = [&](const Vector3& x) { return near(x.y(), 0) || near(x.y(), width); };
  // A side's edge lies along a side; the short ends' edges must not be taken for it.
  Hold side = hold(start, sides, axis_bit(1), false);
  for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e) {
    const Vector3 &a = start.positions[start.mesh->edges[e][0]], &b = start.positions[start.mesh->edges[e][1]];
    if (start.mesh->on_rim(e) && sides(a) && near(a.y(), b.y()))
      side.clamped_edges.push_back(e);
  }
  m.holds.push_back(side);
  m.holds.push_back(s.set == 2 ? hold(start, ends, all_axes, false) : clamp(start, s, ends));

  const std::vector<Eigen::Vector2d> beam = curved ? arch(both) : std::vector<Eigen::Vector2d>{};
  const auto speed = [&](double x) { // vertical, at the arc length x
    if (curved)
      return beam[static_cast<std::size_t>(std::lround(x * static_cast<double>(beam.size() - 1)))][1];
    const double y = 1 - x;
    return -load_q / (24 * flexural) *
           (s.set == 1   ? x * x * y * y
            : s.set == 2 ? x * (1 - 2 * x * x + x * x * x)
                         : x * x * (6 - 4 * x + x * x));
  };
  const double where = both ? 0.5 : 1, dt = wanted_move / std::abs(speed(where));
  Run run(std::move(start), m, s, 1);
  const std::vector<Vector3> before = run.state().positions;
  run.advance(dt, 1);
  double moved = 0, exact = 0;
  for (std::size_t v = 0; v < flat.size(); ++v)
    if (std::abs(flat[v].x() - where) < 1.5 * s.edge) {
      moved += run.state().positions[v].z() - before[v].z();
      exact += dt * speed(flat[v].x());
    }
  Result r = run.result(moved / exact);
  r.more = {{"speed", speed(where)}};
  return r;
}

} // namespace sheet::validation
