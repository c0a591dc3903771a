// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit stage solved with the library's own terms and Newton method, for what a Stepper does not show: the
// potential and the reactions of held unknowns. For rates at one instant let dt be small.
#pragma once
#include "tests/validation/setup.h"

namespace sheet::validation {

struct Instant {
  Unknowns begin, end;
  State next;               // the end as a state: positions and directors
  Eigen::VectorXd reaction; // gradient of the potential [N, N m] at the end, zero where nothing is held
  double potential = 0;     // [J]; in a purely viscous stage dt/2 times the dissipated power
  double seconds = 0;
  int iterations = 0;
};

using Place = std::function<void(const Stage&, Unknowns&)>;

// model.holds say what is held and, together with `place`, where. `frames` may change the directors at the start.
[[nodiscard]] Instant solve_instant(const State& s, const Model& model, double dt, const Place& place = {},
                                    const std::function<void(Stage&)>& frames = {});

} // namespace sheet::validation
