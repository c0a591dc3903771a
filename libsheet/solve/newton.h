// SPDX-License-Identifier: GPL-3.0-or-later
// Minimises the incremental potential of one stage: Newton with exact gradients, line search on the potential, and a
// stopping rule without units: what remains, estimated from the last two steps, is below `tolerance` of the length of
// the edges at every vertex, and below `tolerance` radians at every edge. Matrices are scaled to a unit diagonal before
// they are factorised, so that the shift which mends an indefinite one has no unit either.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/assembly.h"
#include "libsheet/solve/cholesky.h"

namespace sheet {

enum class HessianChoice {
  exact_first, // exact; where that cannot be factorised the positive form, then mixtures with less and less of it
  positive     // always the positive form
};

struct NewtonOptions {
  double tolerance = 1e-5; // of the error that remains, estimated from the last two steps
  int iterations = 50;
  HessianChoice hessian = HessianChoice::exact_first;
};

struct NewtonReport {
  bool converged = false;
  bool monotone = true; // the potential never rose by more than round-off
  int iterations = 0;   // Newton steps
  int factorizations = 0;
  int positive = 0;                // of them with some of the positive form
  int shifted = 0;                 // of them with a shift
  int halvings = 0;                // of the line search
  double last_step = 0;            // in the units of the stopping rule
  double gained = 0, promised = 0; // fall of the potential up to the last step, and what that one promised to add [J]
  double seconds_assembly = 0, seconds_factor = 0, seconds_solve = 0, seconds_search = 0;
};

// What is kept from one solve to the next while the connectivity stays.
struct LinearSystem {
  Assembly assembly;
  Cholesky cholesky;
  SparseLower matrix;
  double seconds_analysis = 0;

  LinearSystem(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles);
};

// Scales the matrix symmetrically to a diagonal of ones (of mean one over the three coordinates of a vertex) and
// returns the factors, one a row. Held rows keep theirs.
Eigen::VectorXd scale_to_unit_diagonal(SparseLower& matrix, const std::vector<std::uint32_t>& permutation,
                                       std::span<const char> held, std::size_t vertices);

// Moves u by one linearised step that takes the held unknowns to their target, so that the others make way: a starting
// point for motions of more than an edge. False if the matrix cannot be factorised.
[[nodiscard]] bool spread_held_motion(LinearSystem& system, const Terms& terms, std::span<const char> held,
                                      const Unknowns& target, Unknowns& u);

// scale: for each unknown the length [m] (or angle, 1) that its step is measured in. floor: the least shift of the
// scaled matrix; positive where the potential does not determine a rigid motion. u: start, and result.
[[nodiscard]] NewtonReport minimize(LinearSystem& system, const Terms& terms, std::span<const char> held,
                                    const Eigen::VectorXd& scale, double floor, const NewtonOptions& options,
                                    Unknowns& u);

} // namespace sheet
