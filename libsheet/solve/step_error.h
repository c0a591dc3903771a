// SPDX-License-Identifier: GPL-3.0-or-later
// What the error of a step is, of the errors at its vertices.
#pragma once
#include <cstddef>
#include <span>

namespace sheet {

struct StepError {
  double value = 0;
  std::size_t vertex = 0; // that has the greatest error
};

// What the errors of 99 % of the liquid stay below, but half of the greatest at least. What has just landed, and a fold
// that turns over, is a few vertices: they may err by twice as much, with which a pile of folds takes three quarters of
// the steps, for errors that stay below those of other scenes (docs/speed-error.md). Errors and volumes of the
// vertices, in any unit; none: 0.
[[nodiscard]] StepError step_error(std::span<const double> errors, std::span<const double> volumes);

} // namespace sheet
