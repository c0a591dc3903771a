// SPDX-License-Identifier: GPL-3.0-or-later
// What the cases share: meshes, holds, stepping with a clock, one-dimensional references.
#pragma once
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "formats/cpp/stream_frame.h"
#include "libsheet/solve/step_stage.h"
#include "tests/validation/case.h"

namespace sheet::validation {

using std::numbers::pi;

[[nodiscard]] TriangleMesh strip_mesh(const Settings& s, double length, double width); // corner at the origin
[[nodiscard]] MeshOptions mesh_options(const Settings& s, double length);              // length: the case's
[[nodiscard]] State film(const TriangleMesh& mesh, double thickness);                  // at rest
[[nodiscard]] Model viscous(double viscosity, const Settings& s);                      // creeping, bends by s.bending

using Where = std::function<bool(const Vector3&)>;
// Vertices where `at` holds; with clamped, also rim edges whose two ends do.
[[nodiscard]] Hold hold(const State& s, const Where& at, Axes axes, bool clamped);
// A clamp for hinges, which have no director: a held triangle beyond each rim edge whose two ends are `at`, the mirror
// image of the edge's own triangle. Its volume is the mirrored one's.
[[nodiscard]] Hold clamp_by_ears(State& s, const Where& at);
// Clamped by whichever of the two fits the bending model.
[[nodiscard]] Hold clamp(State& s, const Settings& settings, const Where& at);

// Advances a state and counts what it costs.
class Run {
public:
  Run(State start, Model model, const Settings& settings, double length);
  // `each` sees the state after every step; its time is not counted.
  void advance(double duration, int steps, const std::function<void(const State&)>& each = {});
  [[nodiscard]] const State& state() const { return state_; }
  // value and error = value - 1, cost and size.
  [[nodiscard]] Result result(double value) const;
  double tolerance = 1e-9; // of Newton, in edge lengths

private:
  State state_;
  Model model_;
  Settings settings_;
  double length_;
  int steps_ = 0, iterations_ = 0, failed_ = 0;
  double seconds_ = 0;
};

[[nodiscard]] double volume_of_all(const formats::Frame& frame);                // of triangles and drops [m³]
[[nodiscard]] StepStageOptions equal_steps(const Settings& s, double duration); // of s.steps steps
[[nodiscard]] double since(std::chrono::steady_clock::time_point start);        // [s]

[[nodiscard]] double mean_radius(const State& s);  // about the origin, weighted by mass
[[nodiscard]] double radial_speed(const State& s); // mean of v·x/|x|, likewise
[[nodiscard]] double sheet_area(const State& s);
[[nodiscard]] double mean_edge(const State& s);

// y' = f(t, y) by the classical Runge-Kutta method in `steps` steps.
template <class Y, class F> Y runge_kutta(Y y, double t, double duration, int steps, F&& f) {
  const double d = duration / steps;
  for (int k = 0; k < steps; ++k, t += d) {
    const Y k1 = f(t, y), k2 = f(t + d / 2, Y(y + d / 2 * k1)), k3 = f(t + d / 2, Y(y + d / 2 * k2)),
            k4 = f(t + d, Y(y + d * k3));
    y = y + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return y;
}

// The cases, one function each.
Result v1(const Settings&), v2(const Settings&), v3(const Settings&), v4(const Settings&), v5(const Settings&),
    v6(const Settings&), v7(const Settings&), v8(const Settings&), v9(const Settings&), v9_remeshed(const Settings&),
    v10(const Settings&), v11(const Settings&), v12(const Settings&), v13(const Settings&), v14(const Settings&),
    v15(const Settings&), v16(const Settings&), v17(const Settings&), v18(const Settings&), v19(const Settings&),
    v20(const Settings&), v22(const Settings&), v23(const Settings&), v24(const Settings&), v25(const Settings&),
    v26(const Settings&), v27(const Settings&), v28(const Settings&), v29(const Settings&), v30(const Settings&),
    v31(const Settings&), v32(const Settings&), v33(const Settings&), v34(const Settings&), v35(const Settings&),
    v36(const Settings&), v37(const Settings&), v38(const Settings&), v39(const Settings&), v40(const Settings&),
    v41(const Settings&), v42(const Settings&), v43(const Settings&), v44(const Settings&), v45(const Settings&),
    v46(const Settings&), v47(const Settings&);

} // namespace sheet::validation
