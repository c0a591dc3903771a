// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/damped_newton.h"

#include <algorithm>
#include <cmath>

namespace sheet {

namespace {
constexpr double first_damping = 1e-3, least_damping = 1e-12; // damping, of a matrix with a unit diagonal
constexpr int most_tries = 30;                                // of dampings, an iteration
constexpr double damping_factor = 8;
constexpr double good_gain = 0.75, poor_gain = 0.25, accepted_gain = 1e-3; // gain over the predicted one
} // namespace

NewtonReport minimize_damped(LinearSystem& system, const Terms& terms, const Eigen::VectorXd& scale,
                             const NewtonOptions& options, Unknowns& u) {
  NewtonReport report;
  const double floor = system.floor();
  Eigen::VectorXd gradient;
  double damping = first_damping, start = 0, previous_step = 0;
  while (report.iterations < options.iterations) {
    const EnergySum energy = system.hessian(terms, u, gradient);
    if (!std::isfinite(energy.value) || !gradient.allFinite())
      return report;
    if (report.iterations == 0)
      start = energy.value;
    const double noise = energy.noise();
    ++report.iterations;
    double used = 0;
    bool moved = false;
    for (int tries = 0; tries < most_tries && !moved; ++tries) {
      used = std::max(floor, damping);
      ++report.factorizations;
      report.shifted += used > floor;
      if (!system.factorize(used, Precision::full)) {
        damping = std::max(least_damping, damping_factor * damping);
        continue;
      }
      const Eigen::VectorXd rows = -system.solve(system.to_rows(gradient));
      const Eigen::VectorXd step = system.to_unknowns(rows);
      report.last_step = step.cwiseQuotient(scale).cwiseAbs().maxCoeff();
      if (!std::isfinite(report.last_step))
        return report;
      // (H + λ/r²) s = -g, so the model gains -(g·s + s·H s/2) = -(g·s - λ |s/r|²)/2.
      const double predicted = -0.5 * (gradient.dot(step) - used * rows.squaredNorm());
      const double gain = energy.value - system.value(terms, u + step).value;
      report.gained = start - energy.value;
      report.promised = predicted;
      const double ratio = predicted <= noise ? 1 : gain / predicted;
      if (!(ratio > accepted_gain)) { // also where the gain is no number
        damping = std::max(least_damping, damping_factor * damping);
        ++report.halvings;
        continue;
      }
      u += step;
      moved = true;
      if (ratio > good_gain)
        damping = damping > least_damping ? damping / damping_factor : 0;
      else if (ratio < poor_gain)
        damping *= damping_factor;
    }
    if (!moved)
      return report;
    const double rate = previous_step > 0 ? report.last_step / previous_step : 1;
    if (used <= std::max(floor, least_damping) && rate < 0.5 &&
        report.last_step * rate / (1 - rate) <= options.tolerance) {
      report.converged = true;
      return report;
    }
    previous_step = report.last_step;
  }
  return report;
}

} // namespace sheet
