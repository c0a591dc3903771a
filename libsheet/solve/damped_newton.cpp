// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/damped_newton.h"

#include <algorithm>
#include <cmath>

#include "libsheet/solve/with_rank_ones.h"

namespace sheet {

namespace {
constexpr double kFirst = 1e-3, kLeast = 1e-12; // damping, of a matrix with a unit diagonal
constexpr int kTries = 30;                      // of dampings, an iteration
constexpr double kFactor = 8;
constexpr double kGood = 0.75, kPoor = 0.25, kAccepted = 1e-3; // gain over the predicted one
constexpr double kRoundOff = 1e-14;                            // of the sum of the magnitudes of the energies
} // namespace

NewtonReport minimize_damped(LinearSystem& system, const Terms& terms, std::span<const char> held,
                             const Eigen::VectorXd& scale, double floor, const NewtonOptions& options, Unknowns& u) {
  NewtonReport report;
  const auto& permutation = system.assembly.pattern().permutation();
  Eigen::VectorXd gradient;
  double damping = kFirst, start = 0, previous_step = 0;
  while (report.iterations < options.iterations) {
    const EnergySum energy = system.assembly.derivatives(terms, u, false, held, gradient, system.matrix);
    if (!std::isfinite(energy.value) || !gradient.allFinite())
      return report;
    if (report.iterations == 0)
      start = energy.value;
    const double noise = kRoundOff * energy.magnitude;
    const Eigen::VectorXd row_scale =
        scale_to_unit_diagonal(system.matrix, permutation, held, system.assembly.vertices());
    ++report.iterations;
    double used = 0;
    bool moved = false;
    for (int tries = 0; tries < kTries && !moved; ++tries) {
      used = std::max(floor, damping);
      ++report.factorizations;
      report.shifted += used > floor;
      if (!system.cholesky.factorize(system.matrix, used)) {
        damping = std::max(kLeast, kFactor * damping);
        continue;
      }
      const Eigen::VectorXd step = -WithRankOnes(system, terms, held, u, row_scale).solve(gradient);
      report.last_step = step.cwiseQuotient(scale).cwiseAbs().maxCoeff();
      if (!std::isfinite(report.last_step))
        return report;
      // (H + λ/r²) s = -g, so the model gains -(g·s + s·H s/2) = -(g·s - λ |s/r|²)/2.
      double damped = 0;
      for (Eigen::Index k = 0; k < step.size(); ++k) {
        const double s = step[permutation[static_cast<std::size_t>(k)]] / row_scale[k];
        damped += s * s;
      }
      const double slope = gradient.dot(step), predicted = -0.5 * (slope - used * damped);
      const double gain = energy.value - system.assembly.value(terms, u + step).value;
      report.gained = start - energy.value;
      report.promised = predicted;
      const double ratio = predicted <= noise ? 1 : gain / predicted;
      if (!(ratio > kAccepted)) { // also where the gain is no number
        damping = std::max(kLeast, kFactor * damping);
        ++report.halvings;
        continue;
      }
      u += step;
      moved = true;
      if (ratio > kGood)
        damping = damping > kLeast ? damping / kFactor : 0;
      else if (ratio < kPoor)
        damping *= kFactor;
    }
    if (!moved)
      return report;
    const double rate = previous_step > 0 ? report.last_step / previous_step : 1;
    if (used <= std::max(floor, kLeast) && rate < 0.5 && report.last_step * rate / (1 - rate) <= options.tolerance) {
      report.converged = true;
      return report;
    }
    previous_step = report.last_step;
  }
  return report;
}

} // namespace sheet
