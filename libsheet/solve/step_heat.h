// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures in a time step. Each stage of the mechanics has the viscosities of temperatures that are extrapolated to
// its end; when its flow is known, an implicit stage of heat (heat/stage.h) finds those that are there, at the geometry
// and with the dissipation of that flow:
//   stage 1: T̂ = T0 + τ dT/dt as it was, then T1 of T̄ = T0;
//   stage 2: T̂ = T0 + (T1 - T0)/γ, then T2 of T̄ = T0 + s (T1 - T0), s = (1 - γ)/γ.
// Of second order with viscous heating, too, which goes with the flow at once: split off, it would be of first.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "libsheet/energy/model.h"
#include "libsheet/energy/stage.h"
#include "libsheet/energy/term.h"
#include "libsheet/heat/stage.h"

namespace sheet {

class StepHeat {
public:
  // What outlives it. The model has heat, the state temperatures; `solver` is one of its mesh.
  StepHeat(const Model& model, heat::Solver& solver, const State& start);

  // The heat of a first stage, whose flow ended at u.
  void first_stage(const Stage& stage, const Terms& terms, const Unknowns& u);
  // Whether T̄ of a second one stays above a quarter of T0.
  [[nodiscard]] bool goes_on(double ratio) const;
  // Sets T̂ of a second one, γ its part of the step.
  void extrapolate(double gamma, Stage& stage) const;
  void second_stage(const Stage& stage, const Terms& terms, const Unknowns& u);
  // Temperatures, their rates, and what moved, into the end of a step.
  void put(State& end) const;
  // Of the viscosity that the last stage had for its end, over 10, or of its temperature, the greatest part by which it
  // was wrong: the step's error of first order. 0.01 is a tenth of the viscosity, a hundredth of the temperature.
  [[nodiscard]] double error(const Stage& last) const;

private:
  struct Temperatures {
    std::vector<double> means, modes; // of triangles; of each the modes beyond the mean, if the profile has some [K]
  };
  void solve(const Stage& stage, const Terms& terms, const Unknowns& u, Temperatures reference);

  const Model& model_;
  heat::Solver& solver_;
  const State& start_;
  Temperatures first_;     // T1
  Temperatures reference_; // T̄ of the last stage
  Temperatures last_;      // its T
  HeatMoved moved_;        // in the last stage, and before [J]
  double duration_ = 0;    // of the last stage [s]
  bool jump_ = false;      // modes that follow at once had none before: they have not grown, but jumped
};

} // namespace sheet
