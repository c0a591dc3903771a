// SPDX-License-Identifier: GPL-3.0-or-later
// What one time step took, or several.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "libsheet/solve/holding_forces.h"
#include "libsheet/solve/newton.h"

namespace sheet {

struct TermTime {
  std::string name;
  double seconds = 0;
};

struct StepReport {
  int substeps = 0;        // 1 unless the step had to be cut
  int failed = 0;          // attempts that did not converge
  int rejected = 0;        // that were not accurate enough (step_within)
  int euler_fallbacks = 0; // substeps that only backward Euler could do
  int flat_fallbacks = 0;  // steps done with straight edges instead of arcs, as they did not converge with arcs
  int unfinished = 0;      // substeps taken though Newton's iterations had not converged
  int inaccurate = 0; // steps taken though their error is above the tolerance (step_within), beside the unfinished ones
  NewtonReport newton; // sums over all stages; last_step of the last one
  // Filtered difference to the first-order result, in edge lengths, less where next to nothing is carried
  // (docs/model.md, stopping rule), of all vertices as in step_error.h, greatest of the substeps.
  double error = 0;
  std::size_t worst = 0; // the vertex with the greatest difference
  // How many times as long the last attempt might have been until SDIRK2's second stage has no reference
  // (energy/stage_setup.h); below 1: was refused for it.
  double room = std::numeric_limits<double>::infinity();
  HoldingForces reactions; // those that the model wants
  double seconds_analysis = 0;
  // Assembled terms, their element work summed over threads, and gathering; again for what was done without arcs.
  std::vector<TermTime> terms;

  // With what was done after it: counts and times add up, the error is the greater one, the reactions are the later
  // ones.
  StepReport& operator+=(const StepReport& later);
};

} // namespace sheet
