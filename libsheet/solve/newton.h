// SPDX-License-Identifier: GPL-3.0-or-later
// Minimises the incremental potential of one stage: Newton's method whose directions come from a few conjugate
// gradients on the exact Hessian [Steihaug 1983, Eisenstat and Walker 1996], with one factor of the Hessian as
// preconditioner, which serves as long as it is good: as a rule for both stages of a step. Of liquids that are not
// Newtonian each direction has a factor of its own. Line search on the potential.
// It ends when what remains, the gradient times the preconditioner, is small: below `tolerance` of the length of the
// edges at every vertex and below `tolerance` radians at every edge; or, where that suffices, below a part of the error
// that the step has anyhow (of_step_error).
#pragma once
#include <functional>

#include "libsheet/solve/linear_system.h"

namespace sheet {

struct NewtonOptions {
  double tolerance = 1e-5; // of the edges' length, what may remain
  // If positive, it also ends when what remains is below this part of the way from the extrapolated state, in the norm
  // of the potential and at every vertex: the error of a step of order two is a part of that way. At the vertices that
  // part of the error that the step may have, `step_error` [of an edge], is enough.
  double of_step_error = 0, step_error = 0;
  // If positive, it does not end before the greatest force at a vertex is below this part of what it was at the start.
  // By the step's error a greater part will do.
  double force_left = 0, force_left_by_error = 0;
  // Viscosity depends on the rate of strain, so the Hessian is another one in each iteration: a factor that no longer
  // serves alone is made anew at once, which costs as much as three or four products.
  bool renews = false;
  int iterations = 50; // with the Hessian; those by the factor alone end by themselves
};

struct NewtonReport {
  bool converged = false;
  bool monotone = true; // the potential never rose by more than round-off
  int iterations = 0;   // Newton steps, each with the Hessian where it starts
  int followed = 0;     // steps by the factor alone
  int products = 0;     // of the Hessian with a direction
  int factorizations = 0;
  int positive = 0;                // of them of the positive form
  int shifted = 0;                 // of them with a shift
  int halvings = 0;                // of the line search
  double last_step = 0;            // in the units of the stopping rule
  double gained = 0, promised = 0; // fall of the potential up to the last step, and what that one promised to add [J]
  double seconds_assembly = 0, seconds_factor = 0, seconds_solve = 0, seconds_search = 0;

  [[nodiscard]] int spent() const { return iterations + followed; } // of what a step may take
  // With what was done after it: counts and times add up; how it ended is the later one's.
  NewtonReport& operator+=(const NewtonReport& later);
};

// The potential at a start, so that no one evaluates it twice.
struct FirstEvaluation {
  EnergySum energy;
  Eigen::VectorXd gradient;
  bool linearized = false; // the system has the exact Hessian there
};

// The Hessian is evaluated as well if there is no factor, as it is then needed anyhow.
[[nodiscard]] FirstEvaluation evaluate_first(LinearSystem& system, const Terms& terms, const Unknowns& u);

// Puts into u another start, of a lower potential than `least` [J]; false where it knows none.
using OtherStart = std::function<bool(double least, Unknowns& u)>;

// The potential's Hessian may have a factor from an earlier stage of the same step; system.hold says what is held.
// scale: for each unknown the length [m] (or angle, 1) that what remains is measured in. extrapolated: where the
// stage would end by extrapolation. u: start, and result; first: what is known at the start. other: asked once, if
// the start is not near what is sought.
[[nodiscard]] NewtonReport minimize(LinearSystem& system, const Terms& terms, const Eigen::VectorXd& scale,
                                    const Unknowns& extrapolated, const NewtonOptions& options, FirstEvaluation first,
                                    Unknowns& u, const OtherStart& other = {});

} // namespace sheet
