// SPDX-License-Identifier: GPL-3.0-or-later
// V18: a falling curtain, through the stages sheet-step and sheet-emit; set 2 also through sheet-remesh.
#include <algorithm>
#include <chrono>

#include <fmt/core.h>

#include "libsheet/flow/emit.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double mu = 70, rho = 1000, g = 9.81, inflow = 0.5, h0 = 1e-3;
constexpr double duration = 1.4, from = 0.05, to = 1; // the window has become steady [s], [m]

// Steady fall: 4 μ (h u')' + ρ g h = ρ h u u', h u = q; y downwards. With w = ln u, s = w', ν = 4 μ/ρ: w' = s,
// s' = (eʷ s - g e⁻ʷ)/ν. Upwards this is stable: from free fall far below, u u' = g, whose speed is sought so that
// u = `inflow` at the top.
class SteadyCurtain {
public:
  SteadyCurtain() {
    double slow = inflow, fast = 10 * std::sqrt(inflow * inflow + 2 * g * depth);
    for (int k = 0; k < 60; ++k) {
      const double middle = (slow + fast) / 2;
      (climb(middle) < std::log(inflow) ? slow : fast) = middle;
    }
    climb(fast);
  }
  [[nodiscard]] double speed(double y) const {
    const double at = y / (depth / steps);
    const auto i = std::min(static_cast<std::size_t>(at), std::size_t{steps - 1});
    const double part = at - static_cast<double>(i);
    return std::exp((1 - part) * log_speed_[i] + part * log_speed_[i + 1]);
  }

private:
  static constexpr double depth = 6;
  static constexpr int steps = 6000;

  // ln u at the top.
  double climb(double speed_below) {
    log_speed_.assign(steps + 1, 0);
    Eigen::Vector2d y(std::log(speed_below), g / (speed_below * speed_below));
    log_speed_[steps] = y[0];
    for (int i = steps - 1; i >= 0; --i) {
      y = runge_kutta(y, 0, -depth / steps, 1, [](double, const Eigen::Vector2d& v) {
        const double u = std::exp(v[0]);
        return Eigen::Vector2d(v[1], (u * v[1] - g / u) / (4 * mu / rho));
      });
      if (!(y[0] > std::log(inflow) - 3)) // too slow to have come from there
        return y[0];
      log_speed_[static_cast<std::size_t>(i)] = y[0];
    }
    return y[0];
  }

  std::vector<double> log_speed_;
};

Scene curtain(double row) {
  return parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [{}, {}]\nsegments = [2, 2]\n"
                  "pattern = \"structured\"\nthickness = {}\ncenter = [0, {}, 0]\nvelocity = [0, {}, 0]\n"
                  "[material]\nviscosity = {}\ndensity = {}\n[environment]\ngravity = [0, {}, 0]\n"
                  "[inflow]\nregion = \"y_max\"\nvelocity = [0, {}, 0]\n"
                  "[[hold]]\nregion = \"x_min\"\naxes = \"x\"\n[[hold]]\nregion = \"x_max\"\naxes = "
                  "\"x\"\n",
                  2 * row, 2 * row, h0, -row, -inflow, mu, rho, -g, -inflow),
      "V18");
}

double larger(double a, double b) { return std::abs(a) > std::abs(b) ? a : b; }

} // namespace

// The sides are guides, so that the flow is planar. More: the greatest error of single triangles' thickness, and the
// relative defect of the volume.
Result v18(const Settings& s) {
  const double row = s.edge;
  const Scene scene = curtain(row);
  formats::Frame frame = build_frame(scene);
  const double volume = 2 * row * 2 * row * h0;
  StepStageOptions options;
  options.dt = duration / s.steps;
  options.scheme = s.scheme;
  options.failed = "";
  StepStage stage(options);
  remesh::Options remeshing;
  remeshing.size.edge_length = row;
  remeshing.smooth = true;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < s.steps; ++k) {
    stage.step(frame);
    if (s.set == 2)
      static_cast<void>(remesh::remesh(frame, &scene, remeshing));
    flow::emit(frame, scene);
  }
  Result result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const SteadyCurtain steady;
  const auto x = positions(static_cast<const formats::Frame&>(frame));
  const auto v = velocities(static_cast<const formats::Frame&>(frame));
  double error = 0, thickness_error = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double y = -x[i].y();
    if (y < from || y > to)
      continue;
    error = larger(error, -v[i].y() / steady.speed(y) - 1);
  }
  const auto c = triangles(static_cast<const formats::Frame&>(frame));
  const auto volumes = sheet::volumes(static_cast<const formats::Frame&>(frame));
  double sum = 0;
  for (std::size_t t = 0; t < c.size(); ++t) {
    sum += volumes[t];
    const double a = -x[c[t][0]].y(), b = -x[c[t][1]].y(), d = -x[c[t][2]].y();
    const double y = (std::min({a, b, d}) + std::max({a, b, d})) / 2;
    const double area = 0.5 * (x[c[t][1]] - x[c[t][0]]).cross(x[c[t][2]] - x[c[t][0]]).norm();
    if (y > from && y < to)
      thickness_error = larger(thickness_error, volumes[t] / area * steady.speed(y) / (h0 * inflow) - 1);
  }
  const double entered = h0 * 2 * row * inflow * frame.time;
  result.value = 1 + error;
  result.error = error;
  result.vertices = frame.vertices;
  result.edge = row;
  result.steps = s.steps;
  result.more = {{"thickness", thickness_error}, {"volume", sum / (volume + entered) - 1}};
  return result;
}

} // namespace sheet::validation
