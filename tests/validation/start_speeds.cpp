// SPDX-License-Identifier: GPL-3.0-or-later
// V35, V36: speeds at one instant of films of a power law in their plane, K = h = 1.
#include <algorithm>
#include <array>

#include "tests/support/holds.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double instant = 1e-5;

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

Model power_law(const Settings& s, double n) {
  Model m = viscous(1, s);
  m.bending = Bending::none;
  if (n != 1)
    m.liquid.law = {.kind = FlowLawKind::power, .flow_index = n};
  return m;
}

// Holds each vertex for itself where `velocity` says how fast it moves along `axes`.
struct Prescribed {
  Axes axes = 0;
  Vector3 velocity = Vector3::Zero();
};
void prescribe(const State& s, const std::function<Prescribed(const Vector3&)>& at, Model& m) {
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (const Prescribed p = at(s.positions[v]); p.axes != 0) {
      Hold h;
      h.vertices = {v};
      h.axes = p.axes;
      test::move_steadily(h, Vector3::Zero(), p.velocity);
      m.holds.push_back(h);
    }
}

Run started(const Settings& s, const State& start, Model m, double length) {
  m.holds.insert(m.holds.begin(), hold(
                                      start, [](const Vector3&) { return true; }, axis_bit(2), false));
  Run run(start, std::move(m), s, length);
  run.tolerance = 1e-10;
  run.advance(instant, s.steps);
  return run;
}

// Speeds along y, by the depth y, of what lies on x = 0.
class Profile {
public:
  Profile(const State& start, const State& end) {
    for (std::size_t v = 0; v < start.positions.size(); ++v)
      if (const Vector3& x = start.positions[v]; near(x.x(), 0))
        rows_.push_back({x.y(), (end.positions[v] - x).y() / instant});
    std::sort(rows_.begin(), rows_.end());
  }
  [[nodiscard]] double speed(double depth) const { return between(depth, 0, 1); }
  [[nodiscard]] double depth(double speed) const { return between(speed, 1, 0); }

private:
  // The column `to` where the column `from`, rising or falling, is `value`.
  [[nodiscard]] double between(double value, std::size_t from, std::size_t to) const {
    for (std::size_t k = 1; k < rows_.size(); ++k)
      if (const auto& a = rows_[k - 1], &b = rows_[k]; (a[from] - value) * (b[from] - value) <= 0)
        return a[to] + (value - a[from]) / (b[from] - a[from]) * (b[to] - a[to]);
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<std::array<double, 2>> rows_;
};

// On y = 0 v = cos x and u = 0, on the sides u = 0, far below nothing: Newtonian v = cos x (1 + 3y/5) e^-y, half of it
// at y = 1.2542, a tenth at 3.4180.
Result half_plane(const Settings& s, double n, double half, double tenth) {
  constexpr double depth = 8;
  const State start = film(strip_mesh(s, pi, depth), 1); // edges of a part of its width π
  Model m = power_law(s, n);
  prescribe(
      start,
      [&](const Vector3& x) -> Prescribed {
        if (near(x.y(), 0) || near(x.y(), depth))
          return {axis_bit(0) | axis_bit(1), {0, near(x.y(), 0) ? std::cos(x.x()) : 0, 0}};
        return {near(x.x(), 0) || near(x.x(), pi) ? axis_bit(0) : Axes(0), Vector3::Zero()};
      },
      m);
  const Run run = started(s, start, m, pi);
  const Profile profile(start, run.state());
  Result r = run.result(profile.depth(0.5) / half);
  r.more = {{"tenth", profile.depth(0.1) / tenth - 1}};
  return r;
}

// The unit square, symmetric about x = 0: on y = 0 v = 1 up to x = 1/4, from there cos² to 0 at 1/2; other sides fixed
// [Houseman and England 1986, without buoyancy]. Speeds at (0, 0.1), (0, 0.25), (0, 0.5).
Result indenter(const Settings& s, double n, const std::array<double, 3>& speeds) {
  const State start = film(strip_mesh(s, 1, 1), 1);
  Model m = power_law(s, n);
  prescribe(
      start,
      [&](const Vector3& x) -> Prescribed {
        if (near(x.y(), 0) || near(x.y(), 1) || near(x.x(), 1)) {
          const double taper = std::cos(2 * pi * std::clamp(x.x() - 0.25, 0.0, 0.25));
          return {axis_bit(0) | axis_bit(1), {0, near(x.y(), 0) ? taper * taper : 0, 0}};
        }
        return {near(x.x(), 0) ? axis_bit(0) : Axes(0), Vector3::Zero()};
      },
      m);
  const Run run = started(s, start, m, 1);
  const Profile profile(start, run.state());
  Result r = run.result(profile.speed(0.25) / speeds[1]);
  r.more = {{"at_0.1", profile.speed(0.1) / speeds[0] - 1}, {"at_0.5", profile.speed(0.5) / speeds[2] - 1}};
  return r;
}

} // namespace

// A hole of radius 1 in an endless film: u = U r^-s, s = (n+1)/(2n), U = (n γ)^(1/n) (2 sqrt(s² - s + 1))^((1-n)/n).
Result v35(const Settings& s) {
  constexpr std::array<double, 5> indices = {1.0 / 3, 0.5, 0.7, 1, 1.5};
  constexpr double outer = 3;
  const double n = indices[static_cast<std::size_t>(s.set - 1)], power = (n + 1) / (2 * n);
  const double speed = std::pow(n, 1 / n) * std::pow(2 * std::sqrt(power * power - power + 1), (1 - n) / n);
  const State start = film(make_annulus(1, outer, mesh_options(s, 1)), 1);
  Model m = power_law(s, n);
  m.liquid.surface_tension = 1;
  prescribe(
      start,
      [&](const Vector3& x) -> Prescribed {
        if (x.norm() < outer - 1e-9)
          return {};
        return {axis_bit(0) | axis_bit(1), speed * std::pow(x.norm(), -power) * x.normalized()};
      },
      m);
  const Run run = started(s, start, m, 1);
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    if (const Vector3& x = start.positions[v]; x.norm() < 1 + 1e-9)
      sum += (run.state().positions[v] - x).dot(x) / instant, count += 1;
  Result r = run.result(sum / count / speed);
  r.more = {{"speed", speed}};
  return r;
}

// Depths and speeds that are no closed forms are those of finite elements of second order in the edge, to their digits.
Result v36(const Settings& s) {
  switch (s.set) {
  case 1:
    return half_plane(s, 1, 1.2542, 3.4180);
  case 2:
    return half_plane(s, 1.0 / 3, 0.8395, 2.0331);
  case 3:
    return half_plane(s, 0.1, 0.5773, 1.2687);
  case 4:
    return indenter(s, 1, {0.89370, 0.71076, 0.41171});
  case 5:
    return indenter(s, 1.0 / 3, {0.82667, 0.56937, 0.24962});
  default:
    return indenter(s, 0.1, {0.64926, 0.26770, 0.03979});
  }
}

} // namespace sheet::validation
