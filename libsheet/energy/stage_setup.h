// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a time step: what they start from, refer to and predict.
#pragma once
#include <span>

#include "libsheet/energy/stage.h"
#include "libsheet/heat/profile.h"

namespace sheet {

// The first (or only) stage: refers to the start; metrics and viscosities predicted from the velocities. `liquids`: by
// their numbers (State::liquids).
[[nodiscard]] Stage first_stage(const State& state, std::span<const Liquid> liquids, double duration, double end_time,
                                bool angles, const heat::Profile& profile = {});
[[nodiscard]] inline Stage first_stage(const State& state, const Liquid& liquid, double duration, double end_time,
                                       bool angles, const heat::Profile& profile = {}) {
  return first_stage(state, std::span(&liquid, 1), duration, end_time, angles, profile);
}

// Turns a first stage into the second of SDIRK2, given the first one's result (which must outlive it). Returns how many
// times as much every triangle could have shrunk there until its reference metric is none, or nearly none: a principal
// stretch, squared, below 1/4 of the start's. Below 1 there is no second stage. Where the reference is negative
// SDIRK2's stability function is, too (z < -1/(1 - 2γ)), and triangles shrink to points.
[[nodiscard]] double second_stage(Stage& stage, const Unknowns& first, double gamma, double dt);

// How warm the triangles are taken to be at the stage's end, with the shift of their flow curves: the mean of a_T
// across the thickness, by which they stretch. Crusts: the bending stiffness about the layer that is not strained, over
// that of the mean. Wall shifts: a layer that flows along a wall by a force along it is sheared by it most at the wall,
// as s, the part of the layer beyond, and moves with the mean velocity τ_w (h/μ_r) ∫ s²/a_T dζ; so it is dragged as by
// a_T = 1/(3 ∫ s²/a_T dζ). `modes`: of the profile beyond the mean, or none.
void set_temperatures(std::vector<double> temperatures, std::span<const double> modes, const heat::Profile& profile,
                      Stage& stage);

// Sets the angles of u so that each director stands to the mean of the normals at its edge as it did at the start: a
// guess for positions that were extrapolated.
void turn_with_normals(const Stage& stage, Unknowns& u);

// The angles [rad] of the directors of u from the mean of the normals at their edges; none without directors.
[[nodiscard]] std::vector<double> director_angles(const Stage& stage, const Unknowns& u);

// Raises indices with the start-of-step metric.
void raise_as_started(Stage& stage);

// For each unknown the mean length of the edges at its vertex [m], or 1 for an angle.
[[nodiscard]] Eigen::VectorXd step_scale(const State& state, Eigen::Index unknowns);

} // namespace sheet
