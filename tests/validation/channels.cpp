// SPDX-License-Identifier: GPL-3.0-or-later
// V29: liquid between two walls, a hundredth as wide as the layer is long.
#include <cmath>

#include "libsheet/energy/channels.h"
#include "libsheet/geometry/area.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double thin = 1e-2, viscosity = 1, length = 1; // the gap; units

Model between(const Settings& s) {
  Model m = viscous(viscosity, s);
  m.bending = Bending::none;
  return m;
}

// The plane z = 0, under all of the sheet.
Wall lower_wall(const State& s) {
  Wall wall;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [](double, const Vector3& x) { return WallPoint{x.z(), Vector3::UnitZ()}; };
  return wall;
}

// A plane over it, at the height `at` over the origin, which rises along x.
Wall upper_wall(const std::function<double(double t)>& at, double slope) {
  Wall wall;
  const Vector3 normal = Vector3(slope, 0, -1).normalized();
  wall.nearest = [=](double t, const Vector3& x) { return WallPoint{normal.dot(x - Vector3(0, 0, at(t))), normal}; };
  return wall;
}

void slide(Wall& wall, double speed) {
  wall.motion = [=](double from, double to) {
    return RigidMotion{Matrix3::Identity(), speed * (to - from) * Vector3::UnitX()};
  };
  wall.velocity = [=](double, const Vector3&) { return Vector3(speed * Vector3::UnitX()); };
}

// Fills the gap whose width goes from `left` to `right` of the mean over the length.
State layer(TriangleMesh mesh, double left, double right) {
  State s = film(mesh, thin);
  const auto width = [=](double x) { return thin * (left + (right - left) * x / length); };
  for (Vector3& x : s.positions)
    x.z() = width(x.x()) / 2;
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const auto& [a, b, c] = s.mesh->triangles[t];
    const auto& x = s.positions;
    s.volumes[t] = width((x[a].x() + x[b].x() + x[c].x()) / 3) * TriangleArea(x[a], x[b], x[c]).area;
  }
  return s;
}

void hold_sides(const State& s, double width, Model& m) {
  m.holds.push_back(hold(
      s, [&](const Vector3& x) { return x.y() < 1e-9 || x.y() > width - 1e-9; }, axis_bit(1), false));
}

// Its mean moves at U (g/2 + b)/(g + b), b the slip length of the wall at rest, half the gap.
Result sliding(const Settings& s) {
  constexpr double speed = 1, slip = thin / 2;
  const double width = 3 * s.edge * length;
  State state = layer(strip_mesh(s, length, width), 1, 1);
  Model m = between(s);
  hold_sides(state, width, m);
  m.walls = {lower_wall(state), upper_wall([](double) { return thin; }, 0)};
  m.walls[0].slip_length = slip;
  slide(m.walls[1], speed);
  const Vector3 start = state.positions.front();
  Run run(std::move(state), m, s, length);
  run.advance(2 * length / speed, s.steps);
  return run.result((run.state().positions.front() - start).x() / (2 * length * (thin / 2 + slip) / (thin + slip)));
}

// To half the gap: the radius is sqrt(2) times what it was.
Result closing(const Settings& s) {
  State state = layer(make_disk(length, mesh_options(s, length)), 1, 1);
  Model m = between(s);
  const auto gap = [](double t) { return thin * (1 - t / 2); };
  m.walls = {lower_wall(state), upper_wall(gap, 0)};
  Run run(std::move(state), m, s, length);
  const double area = sheet_area(run.state());
  run.advance(1, s.steps);
  return run.result(std::sqrt(sheet_area(run.state()) / (2 * area)));
}

// The lower wall slides under a tilted pad that is as long as the layer: the flux U/2 ∫ g^-2 dx/∫ g^-3 dx [Reynolds
// 1886].
Result bearing(const Settings& s) {
  constexpr double speed = 1, left = 1.5, right = 0.5, until = 2e-3 * length / speed;
  const double width = length / 2, slope = thin * (right - left) / length;
  State state = layer(strip_mesh(s, length, width), left, right);
  Model m = between(s);
  hold_sides(state, width, m);
  m.walls = {lower_wall(state), upper_wall([](double) { return thin * left; }, slope)};
  slide(m.walls[0], speed);
  const State start = state;
  Run run(std::move(state), m, s, length);
  run.advance(until, s.steps);
  const auto integral = [&](int power) { // of g^-power dx
    const double p = 1 - power;
    return (std::pow(right, p) - std::pow(left, p)) / (p * (right - left)) * std::pow(thin, -power) * length;
  };
  const double flux = speed / 2 * integral(2) / integral(3);
  double sum = 0;
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    const double x0 = start.positions[v].x(), x1 = run.state().positions[v].x();
    sum += (x1 - x0) / until * thin * (left + (right - left) * (x0 + x1) / (2 * length));
  }
  return run.result(sum / static_cast<double>(start.positions.size()) / flux);
}

} // namespace

Result v29(const Settings& s) { return s.set == 1 ? sliding(s) : s.set == 2 ? closing(s) : bearing(s); }

} // namespace sheet::validation
