// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method with a line search.
#include "libsheet/solve/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/solve/with_rank_ones.h"

namespace sheet {

namespace {

constexpr double kLeastShift = 1e-14; // the first one tried when a factorisation fails, times 100 each
constexpr double kGreatestShift = 1e2;
constexpr double kSufficient = 1e-4;   // of the predicted decrease [Armijo]
constexpr double kRoundOff = 1e-14;    // of the sum of the magnitudes of the elements' energies
constexpr double kSpreadShift = 1e-10; // for a starting point only
constexpr int kHalvings = 40;
constexpr int kBeforeSlope = 3;          // halvings before the slope is asked
constexpr double kSlopeKept = 0.5;       // of the slope that may remain after a step accepted for its slope
constexpr double kSmall = 1e-3;          // steps below this are done if the potential has no more to gain
constexpr double kNothing = 1e-13;       // of an edge: a step that is lost in the rounding of positions
constexpr double kLeastBlend = 1.0 / 16; // least part of the positive Hessian in a mixture
constexpr double kBlendFactor = 4;

class Clock {
public:
  double lap() {
    const auto t = std::chrono::steady_clock::now();
    const double s = std::chrono::duration<double>(t - last_).count();
    last_ = t;
    return s;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace

LinearSystem::LinearSystem(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles)
    : assembly(mesh, terms, angles) {
  Clock clock;
  assembly.set_order(nested_dissection(mesh->vertices, assembly.vertex_graph()));
  matrix = assembly.pattern().structure();
  cholesky.analyze(matrix);
  seconds_analysis = clock.lap();
}

Eigen::VectorXd scale_to_unit_diagonal(SparseLower& a, const std::vector<std::uint32_t>& permutation,
                                       std::span<const char> held, std::size_t vertices) {
  Eigen::VectorXd scale(a.size);
  for (int k = 0; k < a.size;) {
    const int width = permutation[static_cast<std::size_t>(k)] < 3 * vertices ? 3 : 1;
    double sum = 0;
    int count = 0;
    const auto fixed = [&](int row) { return !held.empty() && held[permutation[static_cast<std::size_t>(row)]]; };
    for (int row = k; row < k + width; ++row)
      if (!fixed(row)) {
        sum += std::abs(a.values[static_cast<std::size_t>(a.starts[static_cast<std::size_t>(row)])]);
        ++count;
      }
    for (int row = k; row < k + width; ++row)
      scale[row] = fixed(row) || sum == 0 ? 1 : std::sqrt(count / sum);
    k += width;
  }
  tbb::parallel_for(tbb::blocked_range<int>(0, a.size, 1024), [&](const auto& range) {
    for (int c = range.begin(); c < range.end(); ++c)
      for (int p = a.starts[static_cast<std::size_t>(c)]; p < a.starts[static_cast<std::size_t>(c) + 1]; ++p)
        a.values[static_cast<std::size_t>(p)] *= scale[c] * scale[a.rows[static_cast<std::size_t>(p)]];
  });
  return scale;
}

bool spread_held_motion(LinearSystem& system, const Terms& terms, std::span<const char> held, const Unknowns& target,
                        Unknowns& u) {
  const auto& permutation = system.assembly.pattern().permutation();
  Eigen::VectorXd gradient;
  system.assembly.derivatives(terms, u, true, {}, gradient, system.matrix);
  SparseLower& a = system.matrix;
  Eigen::VectorXd rhs(u.size()), move(u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const auto unknown = permutation[static_cast<std::size_t>(k)];
    move[k] = held[unknown] ? target[unknown] - u[unknown] : 0;
    rhs[k] = -gradient[unknown];
  }
  for (int c = 0; c < a.size; ++c) {
    const bool fixed = held[permutation[static_cast<std::size_t>(c)]];
    for (auto p = static_cast<std::size_t>(a.starts[static_cast<std::size_t>(c)]);
         p < static_cast<std::size_t>(a.starts[static_cast<std::size_t>(c) + 1]); ++p) {
      const int r = a.rows[p];
      rhs[r] -= a.values[p] * move[c];
      if (r != c)
        rhs[c] -= a.values[p] * move[r];
      if (fixed || held[permutation[static_cast<std::size_t>(r)]])
        a.values[p] = r == c ? 1 : 0;
    }
  }
  for (Eigen::Index k = 0; k < u.size(); ++k)
    if (held[permutation[static_cast<std::size_t>(k)]])
      rhs[k] = move[k];
  const Eigen::VectorXd scale = scale_to_unit_diagonal(a, permutation, held, system.assembly.vertices());
  if (!system.cholesky.factorize(a, kSpreadShift))
    return false;
  const Eigen::VectorXd step = system.cholesky.solve(rhs.cwiseProduct(scale));
  for (Eigen::Index k = 0; k < u.size(); ++k)
    if (!held[permutation[static_cast<std::size_t>(k)]])
      u[permutation[static_cast<std::size_t>(k)]] += scale[k] * step[k];
    else
      u[permutation[static_cast<std::size_t>(k)]] += move[k];
  return u.allFinite();
}

namespace {

// Keeps the exact Hessian aside and leaves the positive one in system.matrix.
void add_positive(LinearSystem& system, const Terms& terms, std::span<const char> held, const Unknowns& u,
                  std::vector<double>& exact, std::vector<double>& definite) {
  exact = system.matrix.values;
  Eigen::VectorXd ignored;
  system.assembly.derivatives(terms, u, true, held, ignored, system.matrix);
  definite = system.matrix.values;
}

void mix(const std::vector<double>& exact, const std::vector<double>& definite, double part, SparseLower& matrix) {
  for (std::size_t k = 0; k < exact.size(); ++k)
    matrix.values[k] = exact[k] + part * (definite[k] - exact[k]);
}

// The length of the step that would come next, from the rate at which the last two shrank: if both used the exact
// Hessian the rate squares, as Newton's method converges quadratically; otherwise it stays, and the sum of the
// geometric series counts.
double remaining(double step, double previous, bool exact) {
  const double rate = previous > 0 ? step / previous : 1;
  if (rate >= 0.5)
    return step;
  return exact ? step * rate * rate : step * rate / (1 - rate);
}

} // namespace

NewtonReport minimize(LinearSystem& system, const Terms& terms, std::span<const char> held,
                      const Eigen::VectorXd& scale, double floor, const NewtonOptions& options, Unknowns& u) {
  NewtonReport report;
  Clock clock;
  const auto& permutation = system.assembly.pattern().permutation();
  Eigen::VectorXd gradient, step;
  const bool always_positive = options.hessian == HessianChoice::positive;
  double blend = always_positive ? 1 : 0; // part of the positive form in the Hessian
  double shift = floor;
  std::vector<double> exact, definite;
  double previous_step = 0;    // 0: none, or not a full one
  int exact_steps = 0;         // full ones in a row, with the exact Hessian
  std::optional<double> start; // of the potential
  for (;;) {
    clock.lap();
    const EnergySum energy = system.assembly.derivatives(terms, u, always_positive, held, gradient, system.matrix);
    if (!std::isfinite(energy.value) || !gradient.allFinite())
      return report;
    start = start.value_or(energy.value);
    if (blend > 0 && !always_positive)
      add_positive(system, terms, held, u, exact, definite);
    report.seconds_assembly += clock.lap();

    // The direction: the exact Hessian, else a mixture with the positive one, else that with a growing shift.
    Eigen::VectorXd row_scale;
    for (;;) {
      if (blend > 0 && !always_positive)
        mix(exact, definite, blend, system.matrix);
      row_scale = scale_to_unit_diagonal(system.matrix, permutation, held, system.assembly.vertices());
      report.seconds_assembly += clock.lap();
      bool good = false;
      for (double s = shift; s <= kGreatestShift; s = std::max(kLeastShift, 100 * s)) {
        ++report.factorizations;
        report.positive += blend > 0;
        report.shifted += s > floor;
        good = system.cholesky.factorize(system.matrix, s);
        if (good) {
          shift = s;
          break;
        }
        if (blend < 1)
          break;
      }
      report.seconds_factor += clock.lap();
      if (good)
        break;
      if (blend >= 1)
        return report;
      if (blend == 0) {
        add_positive(system, terms, held, u, exact, definite);
        report.seconds_assembly += clock.lap();
      }
      // A mixture that is barely definite makes steps far beyond where it is true: the whole positive form comes first.
      blend = blend == 0 ? 1 : std::min(1.0, kBlendFactor * blend);
    }
    const WithRankOnes solver(system, terms, held, u, row_scale);
    step = -solver.solve(gradient);
    report.seconds_solve += clock.lap();
    ++report.iterations;
    const double slope = gradient.dot(step);
    report.last_step = step.cwiseQuotient(scale).cwiseAbs().maxCoeff();
    if (!std::isfinite(report.last_step))
      return report;

    if (report.last_step <= kNothing) {
      report.converged = true;
      return report;
    }

    // Below round-off of the potential a full Newton step is the best there is.
    const double noise = kRoundOff * energy.magnitude;
    report.gained = *start - energy.value;
    report.promised = -slope;
    double length = 1;
    if (-slope > noise) {
      int halvings = 0;
      for (;; ++halvings, length *= 0.5) {
        const EnergySum trial = system.assembly.value(terms, u + length * step);
        if (std::isfinite(trial.value) && trial.value <= energy.value + kSufficient * length * slope + noise) {
          report.monotone = report.monotone && trial.value <= energy.value + noise;
          break;
        }
        // A small step may gain less than the potential's own round-off, which strains that nearly cancel make large;
        // then the slope decides [as in Hager and Zhang 2005].
        if (halvings == kBeforeSlope && report.last_step <= kSmall) {
          Eigen::VectorXd there;
          system.assembly.derivatives(terms, u + step, true, held, there, system.matrix);
          if (std::abs(there.dot(step)) <= kSlopeKept * std::abs(slope)) {
            length = 1;
            break;
          }
        }
        if (halvings == kHalvings) {
          report.halvings += halvings;
          report.seconds_search += clock.lap();
          return report;
        }
      }
      report.halvings += halvings;
    }
    u += length * step;
    exact_steps = blend == 0 && !always_positive && length == 1 ? exact_steps + 1 : 0;
    report.seconds_search += clock.lap();
    const bool nothing_to_gain = -slope <= noise && report.last_step <= kSmall;
    if (length == 1 &&
        (remaining(report.last_step, previous_step, exact_steps >= 2) <= options.tolerance || nothing_to_gain)) {
      report.converged = true;
      return report;
    }
    previous_step = length == 1 ? report.last_step : 0;
    if (!always_positive) {
      if (length == 1)
        blend = blend > kLeastBlend ? blend / kBlendFactor : 0;
      else if (length < 0.5)
        blend = std::min(1.0, std::max(kLeastBlend, kBlendFactor * blend));
    }
    if (report.iterations >= options.iterations)
      return report;
  }
}

} // namespace sheet
