// SPDX-License-Identifier: GPL-3.0-or-later
// V44: water bells [Boussinesq 1869; Taylor 1959], through the stages sheet-step, sheet-remesh and sheet-emit.
#include <algorithm>
#include <chrono>
#include <vector>

#include <fmt/core.h>

#include "libsheet/flow/emit.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/write.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double water = 1000, tension = 0.073, flux = 20e-6;                // [kg/m³], [N/m], [m³/s]
constexpr double inlet_speed = 2, inlet_radius = 5e-3, inlet_angle = pi / 3; // from the axis [m/s], [m]
constexpr double edge_of_inlet = 0.7; // of what remeshing wants: what enters lengthens

constexpr double outflow = 45e-3; // how far below the inlet the bell is cut off [m]
constexpr double coarse = 0.6;    // edges while it grows, over the inlet's radius
constexpr double growth = 0.1;    // how long that takes [s]
constexpr int steps_of_growth = 333;

// The steady meridian, r and the angle φ from the axis over the depth z: (ρ h u² - 2γ) φ' = -2γ cos(φ)/r - ρ g h sin φ
// along it, u² = u0² + 2 g z, h = Q/(2π r u).
class Meridian {
public:
  explicit Meridian(double gravity) {
    Eigen::Vector3d at(inlet_radius, 0, inlet_angle); // r, z, φ
    while (at[1] < outflow && at[1] >= 0 && at[0] > 0) {
      points_.push_back(at);
      at = runge_kutta(at, 0, arc, 1, [&](double, const Eigen::Vector3d& y) {
        const double u = std::sqrt(inlet_speed * inlet_speed + 2 * gravity * y[1]);
        const double h = flux / (2 * pi * y[0] * u), sine = std::sin(y[2]), cosine = std::cos(y[2]);
        const double bends =
            (-2 * tension * cosine / y[0] - water * gravity * h * sine) / (water * h * u * u - 2 * tension);
        return Eigen::Vector3d(sine, cosine, bends);
      });
    }
  }
  [[nodiscard]] double radius(double z) const {
    const auto after = std::ranges::lower_bound(points_, z, {}, [](const auto& p) { return p[1]; });
    if (after == points_.begin() || after == points_.end())
      return after == points_.end() ? points_.back()[0] : points_.front()[0];
    const Eigen::Vector3d &a = *(after - 1), &b = *after;
    return std::lerp(a[0], b[0], (z - a[1]) / (b[1] - a[1]));
  }
  [[nodiscard]] Eigen::Vector3d widest() const {
    return *std::ranges::max_element(points_, {}, [](const auto& p) { return p[0]; });
  }

private:
  static constexpr double arc = 1e-5; // [m]
  std::vector<Eigen::Vector3d> points_;
};

// A strip of a sphere that begins with the inlet's angle; the inlet's polygon lets in the whole flux.
Scene bell(double edge, double gravity) {
  const double sphere = inlet_radius / std::cos(inlet_angle), opening = pi / 2 - inlet_angle;
  const double around = std::round(2 * pi * inlet_radius / (edge_of_inlet * edge)), half = pi / around;
  const double u = inlet_speed * std::cos(inlet_angle), w = inlet_speed * std::sin(inlet_angle);
  const double swept = 2 * around * inlet_radius * std::sin(half) * std::hypot(w * std::cos(half), u);
  return parse_scene(
      fmt::format(
          "[sheet]\nshape = \"cap\"\nradius = {}\nopening = {}\nangle = {}\nsegments = [{}, 1]\n"
          "pattern = \"structured\"\nthickness = {}\ncenter = [0, {}, 0]\nvelocity = [0, {}, 0]\nradial_velocity = {}\n"
          "[material]\nviscosity = 1e-3\ndensity = {}\nsurface_tension = {}\n"
          "[model]\nbending = false\n[environment]\ngravity = [0, {}, 0]\n"
          "[inflow]\nregion = \"inner_rim\"\nvelocity = [0, {}, 0]\nradial_velocity = {}\n"
          "[[outflow]]\npoint = [0, {}, 0]\nnormal = [0, -1, 0]\n"
          "[[hold]]\nregion = \"outer_rim\"\naxes = \"y\"\nmotion = {{kind = \"translating\", velocity = [[0, 0, -1, "
          "0], "
          "[0.006, 0, -1.4, 0], [0.012, 0, -1.9, 0], [0.015, 0, -2.1, 0]]}}\n",
          sphere, opening, opening + edge_of_inlet * edge / sphere, around, flux / swept, -sphere * std::cos(opening),
          -u, w, water, tension, -gravity, -u, w, -outflow),
      "V44");
}

// Step by step as the ring `sheet-remesh --smooth | sheet-emit | sheet-step` does; gives the time it takes [s].
double run_bell(formats::Frame& frame, double edge, double duration, int steps, Scheme scheme) {
  StepStageOptions options;
  options.dt = duration / steps;
  options.scheme = scheme;
  options.failed = "";
  StepStage stage(options);
  flow::EmitStage emit;
  const Scene scene = parse_scene(std::string(frame.find("scene")->text()), "V44");
  remesh::Options remeshing;
  remeshing.size.edge_length = edge;
  remeshing.smooth = true;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) {
    static_cast<void>(remesh::remesh(frame, &scene, remeshing));
    emit.emit(frame);
    stage.step(frame);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

// The bell grows out of its inlet with gravity and coarse edges, its first rim led down, and is cut off at a plane.
// What flows in then with the set's gravity and edges has replaced it after a quarter of another 0.1 s, at whose end
// the radius, mean around, is that of the closed form: no wave of it runs up a bell. Value: the greatest radius. More:
// the radius 10, 20, 30 and 40 mm below the inlet.
Result v44(const Settings& s) {
  constexpr double weight = 9.81, duration = 0.1, band = 1e-3; // [m/s²], [s], half of what is averaged over [m]
  const double edge = s.edge * inlet_radius, gravity = s.set == 1 ? 0 : weight;
  formats::Frame frame = build_frame(bell(edge, weight));
  static_cast<void>(run_bell(frame, coarse * inlet_radius, growth, steps_of_growth, s.scheme));
  frame.put_text("scene", scene::to_toml(bell(edge, gravity)));
  Result result;
  result.seconds = run_bell(frame, edge, duration, s.steps, s.scheme);
  result.vertices = frame.vertices;
  result.edge = s.edge;
  result.steps = s.steps;
  const Meridian exact(gravity);
  const double widest = exact.widest()[0];
  const auto x = positions(static_cast<const formats::Frame&>(frame));
  const auto off = [&](double z) {
    double sum = 0, count = 0;
    for (const Vector3& p : x)
      if (std::abs(-p.y() - z) < band)
        sum += std::hypot(p.x(), p.z()) - exact.radius(-p.y()), ++count;
    return sum / count;
  };
  result.error = off(exact.widest()[1]) / widest;
  result.value = 1 + result.error;
  for (const int depth : {10, 20, 30, 40})
    result.more.push_back({fmt::format("at_{}_mm", depth), off(1e-3 * depth) / exact.radius(1e-3 * depth)});
  return result;
}

} // namespace sheet::validation
