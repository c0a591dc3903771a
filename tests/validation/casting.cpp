// SPDX-License-Identifier: GPL-3.0-or-later
// V26: film casting. A film enters at x = 0 with the speed u0 and the thickness h0 and is drawn by a roll at x = L that
// takes it at Dr u0; its width is held. Steady: u = u0 Dr^(x/L), pulled by 4 μ h0 u0 ln(Dr)/L per width. Disturbances
// grow from a draw ratio of 20.218 on (draw resonance): L/u0 times growth rate and angular frequency from the linear
// eigenvalue problem of the isothermal film of constant width, by collocation and by shooting alike [Yeow 1974]. V34:
// the draw ratio from which on they grow in a power law's film, m = 1 - 1/n: u = u0 (1 + (Dr^m - 1) x/L)^(1/m), pulled
// by 2 K h0 (2 u0 (Dr^m - 1)/(m L))^n. V40: the same of a film that cools, lumped, by a transfer coefficient H: with St
// = 2 H L/(ρ c h0 u0), whatever the speed (T - T_a)/(T0 - T_a) = θ = e^(-St x/L), and of a viscosity μ0 e^(k (1 - θ))
// u = u0 Dr^(I(x)/I(L)), I = ∫ e^(-k (1 - θ)) dx/L = e^-k/St (Ei(k) - Ei(k e^(-St x/L))), pulled by 4 μ0 h0 u0 ln(Dr)/
// (L I(L)).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>

#include <Eigen/Dense>
#include <fmt/core.h>

#include "libsheet/flow/emit.h"
#include "libsheet/measure/forces.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double mu = 1, h0 = 1e-3, ambient = 300, slot = 400; // [Pa s], [m], [K]

struct Casting {
  double draw_ratio, growth, frequency, duration, disturbance;
  double flow_index = 1, settled = 0.3;
  double stanton = 0, stiffening = 0; // St, k

  // T - T_a over that at the slot; ∫ μ0/μ dx.
  [[nodiscard]] double warmth(double x) const { return std::exp(-stanton * x); }
  [[nodiscard]] double fluidity(double x) const {
    return stanton == 0
               ? x
               : std::exp(-stiffening) / stanton * (std::expint(stiffening) - std::expint(stiffening * warmth(x)));
  }

  // Over u0, L from the slot = 1.
  [[nodiscard]] double speed(double x) const {
    const double m = 1 - 1 / flow_index;
    return m == 0 ? std::pow(draw_ratio, fluidity(x) / fluidity(1))
                  : std::pow(1 + (std::pow(draw_ratio, m) - 1) * x, 1 / m);
  }
  // Per width, of a viscosity of 1 at the rate 1.
  [[nodiscard]] double force() const {
    const double m = 1 - 1 / flow_index;
    const double slope =
        m == 0 ? std::log(draw_ratio) / fluidity(1) : (std::pow(draw_ratio, m) - 1) / m; // of the speed at the slot
    return 2 * mu * h0 * std::pow(2 * slope, flow_index);
  }
};
constexpr std::array<Casting, 5> castings = {{{10, -1.44599, 11.8056, 2, 0.1},
                                              {15, -0.62821, 13.0763, 2.5, 0.1},
                                              {20, -0.02319, 13.9771, 2, 0.05},
                                              {25, 0.45955, 14.6761, 1.8, 0.05},
                                              {30, 0.86231, 15.2476, 1.8, 0.03}}};

// From the steady flow, its thickness disturbed by a part of h sin(πx).
formats::Frame start_of(const Scene& scene, const Casting& c) {
  formats::Frame frame = build_frame(scene);
  const auto x = positions(static_cast<const formats::Frame&>(frame));
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& k = triangles(frame)[t];
    const double at = std::min(1.0, (x[k[0]] + x[k[1]] + x[k[2]]).x() / 3);
    if (scene.heat)
      frame.find("temperature")->values<double>()[t] = ambient + (scene.heat->temperature - ambient) * c.warmth(at);
    volumes(frame)[t] *= (1 + c.disturbance * std::sin(pi * at)) / c.speed(at);
  }
  return frame;
}

// Fits F = a + e^(σt) (b cos ωt + c sin ωt), by least squares over a grid of σ and ω, refined from ω `about` there on.
struct Wave {
  double mean = 0, growth = 0, frequency = 0;
};
Wave fit(const std::vector<std::array<double, 2>>& series, double about) {
  Wave best;
  double least = std::numeric_limits<double>::infinity(), width = 4;
  Wave middle{0, 0, about};
  for (int level = 0; level < 4; ++level, width /= 5) {
    for (int i = -20; i <= 20; ++i)
      for (int k = -20; k <= 20; ++k) {
        const double growth = middle.growth + width * i / 20, frequency = middle.frequency + 1.5 * width * k / 20;
        Eigen::MatrixX3d basis(series.size(), 3);
        Eigen::VectorXd force(series.size());
        for (Eigen::Index n = 0; n < force.size(); ++n) {
          const auto [t, f] = series[static_cast<std::size_t>(n)];
          basis.row(n) << 1, std::exp(growth * t) * std::cos(frequency * t),
              std::exp(growth * t) * std::sin(frequency * t);
          force[n] = f;
        }
        const Eigen::Vector3d a = (basis.transpose() * basis).ldlt().solve(basis.transpose() * force);
        if (const double rest = (basis * a - force).squaredNorm(); rest < least) {
          least = rest;
          best = {a[0], growth, frequency};
        }
      }
    middle = best;
  }
  return best;
}

struct Cast {
  Wave wave;
  std::size_t vertices;
  double seconds;
};

Cast cast(const Settings& s, const Casting& c) {
  const double width = 3 * s.edge, length = 1 + 3 * s.edge;
  const Scene scene = parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nplane = \"xz\"\nsize = [{}, {}]\ncenter = [{}, 0, 0]\n"
                  "edge_length = {}\nthickness = {}\nseed = {}\n[material]\nviscosity = {}\ndensity = 1\n{}"
                  "[model]\ninertia = false\nbending = false\n[inflow]\nregion = \"x_min\"\nvelocity = [1, 0, 0]\n"
                  "[[hold]]\nregion = \"z_min\"\naxes = \"z\"\n[[hold]]\nregion = \"z_max\"\naxes = \"z\"\n"
                  "[[hold]]\nregion = {{box = [[-9, -9, -9], [9, 9, 9]]}}\naxes = \"y\"\n"
                  "[[hold]]\nregion = {{box = [[1, -9, -9], [9, 9, 9]]}}\nroll = true\n"
                  "motion = {{kind = \"translating\", velocity = [{}, 0, 0]}}\n"
                  "[[outflow]]\npoint = [{}, 0, 0]\nnormal = [1, 0, 0]\n{}",
                  length, width, length / 2, s.edge, h0, s.seed, mu,
                  c.flow_index != 1 ? fmt::format("law = \"power\"\nflow_index = {}\n", c.flow_index)
                  : c.stanton == 0  ? ""
                                    : fmt::format("viscosity_law = \"exponential\"\nreference_temperature = {}\n"
                                                   "temperature_coefficient = {}\n",
                                                  slot, c.stiffening / (slot - ambient)),
                  c.draw_ratio, 1 + 2.5 * s.edge,
                  c.stanton == 0 ? ""
                                 : fmt::format("[heat]\nspecific_heat = 1\ntemperature = {}\nambient = {}\n"
                                               "transfer = {}\n",
                                               slot, ambient, c.stanton * h0 / 2)),
      "V26");
  formats::Frame frame = start_of(scene, c);
  StepStageOptions options;
  options.dt = c.duration / s.steps;
  options.scheme = s.scheme;
  options.failed = "";
  StepStage stage(options);
  flow::EmitStage flow;
  remesh::Options remeshing;
  remeshing.size.edge_length = s.edge;
  remeshing.smooth = true;
  SceneForces forces;
  std::vector<std::array<double, 2>> series;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < s.steps; ++k) {
    static_cast<void>(remesh::remesh(frame, &scene, remeshing));
    flow.emit(frame);
    stage.step(frame);
    if (frame.time > c.settled)
      series.push_back({frame.time, forces.of(frame).back().force.x()});
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {fit(series, c.flow_index == 1 && c.stanton == 0 ? 13 : c.frequency), frame.vertices, seconds};
}

Result result_of(const Settings& s, double value, std::size_t vertices, double seconds) {
  Result r;
  r.value = value;
  r.error = value - 1;
  r.vertices = vertices;
  r.seconds = seconds;
  r.edge = s.edge;
  r.steps = s.steps;
  return r;
}

} // namespace

// Value: the mean force over the steady one. More: growth rate and angular frequency less those of theory.
Result v26(const Settings& s) {
  const Casting& c = castings[static_cast<std::size_t>(s.set - 1)];
  const auto [wave, vertices, seconds] = cast(s, c);
  Result r = result_of(s, wave.mean / (c.force() * 3 * s.edge), vertices, seconds);
  r.more = {{"growth", wave.growth - c.growth}, {"frequency", wave.frequency / c.frequency - 1}};
  return r;
}

namespace {

// The draw ratio at which nothing grows, between two runs a tenth below and above that of theory (eigenvalues by
// collocation and by shooting alike), over that. More: the same of the angular frequency there, and of the force.
Result critical_ratio(const Settings& s, const Casting& at) {
  std::array<Cast, 2> runs;
  double force = 0;
  for (const std::size_t above : {0, 1}) {
    Casting c = at;
    c.draw_ratio *= above ? 1.1 : 0.9;
    runs[above] = cast(s, c);
    force += runs[above].wave.mean / (c.force() * 3 * s.edge) / 2;
  }
  const double low = runs[0].wave.growth, high = runs[1].wave.growth, part = low / (low - high);
  const double frequency = (1 - part) * runs[0].wave.frequency + part * runs[1].wave.frequency;
  Result r = result_of(s, 0.9 * std::pow(1.1 / 0.9, part), runs[1].vertices, runs[0].seconds + runs[1].seconds);
  r.more = {
      {"growth_below", low}, {"growth_above", high}, {"frequency", frequency / at.frequency - 1}, {"force", force - 1}};
  return r;
}

} // namespace

Result v34(const Settings& s) {
  constexpr std::array<double, 4> indices = {0.5, 0.8, 1, 1.2}, critical = {4.834425, 11.117159, 20.217988, 39.572232},
                                  frequencies = {8.4562, 11.1279, 14.0111, 18.6209};
  constexpr std::array<double, 4> disturbances = {0.03, 0.06, 0.06, 0.1}; // what thins does not stay linear for long
  const auto k = static_cast<std::size_t>(s.set - 1);
  return critical_ratio(s, {critical[k], 0, frequencies[k], 4, disturbances[k], indices[k], 1});
}

Result v40(const Settings& s) {
  constexpr std::array<double, 3> stanton = {0.1, 0.3, 0.1}, stiffening = {1, 1, 3};
  constexpr std::array<double, 3> critical = {22.570928, 27.421167, 29.607983}, frequencies = {14.774, 16.229, 16.658};
  const auto k = static_cast<std::size_t>(s.set - 1);
  return critical_ratio(s, {critical[k], 0, frequencies[k], 4, 0.06, 1, 1, stanton[k], stiffening[k]});
}

} // namespace sheet::validation
