// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <tbb/parallel_invoke.h>

#include "libsheet/base/each.h"
#include "libsheet/base/error.h"
#include "libsheet/energy/channels.h"
#include "libsheet/energy/films.h"
#include "libsheet/energy/levelling.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/energy/wall_distance.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/solve/free_turning.h"
#include "libsheet/solve/reactions.h"
#include "libsheet/solve/step_error.h"
#include "libsheet/solve/step_heat.h"

namespace sheet {

namespace {

const double sdirk_gamma = 1 - std::sqrt(0.5);

constexpr double smallest_floor = 1e-10; // shift of the scaled matrix where motions are free

// Whether every triangle still has an area beyond round-off.
bool sound(const State& s) {
  std::atomic<bool> result = true;
  each_in_parallel(s.mesh->triangles.size(), [&](std::size_t i) {
    const Corners& t = s.mesh->triangles[i];
    const double longest = squared_lengths(s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]).maxCoeff();
    if (!(TriangleArea(s.positions[t[0]], s.positions[t[1]], s.positions[t[2]]).area > 1e-9 * longest))
      result.store(false, std::memory_order_relaxed);
  });
  return result;
}

// Vertices that have a place along the sheet: by holds, or by the drag of a wall.
std::size_t at_places(const Model& model) {
  std::size_t count = fully_held(model.holds);
  for (const Wall& wall : model.walls)
    if (wall.slip_length != free_slip)
      count += wall.vertices.size();
  return count;
}

// Whether a vertex moves along its wall by more than an edge in the time dt, as fast as it ends.
bool slides_too_far(const Stage& stage, const Unknowns& last, double dt, const Eigen::VectorXd& lengths) {
  return std::ranges::any_of(stage.sites, [&](const WallSite& site) {
    const double allowed = lengths[3 * static_cast<Eigen::Index>(site.vertex)];
    return (stage.position(last, site.vertex) - site.carried).norm() * dt > allowed * stage.duration;
  });
}

// How much each vertex counts: wholly, but less in films, the thinner they are, or as the vertex carries less than
// three hundredths of the mean volume: strands of next to no mass shall rule neither steps nor iterations, either. Of
// these, what is thicker than its edges are long is no sheet whose shape the model knows, unless rims are `round`, and
// counts for nothing.
Eigen::VectorXd vertex_weights(const Stage& stage, const Eigen::VectorXd& lengths, bool round) {
  constexpr double carries_enough = 0.03, least_weight = 1e-6;
  const auto& triangles = stage.start->mesh->triangles;
  const std::vector<double> shares =
      vertex_shares(stage.vertices(), triangles, [&](std::uint32_t t) { return stage.raised[t].area(); });
  const Eigen::Map<const Eigen::VectorXd> area(shares.data(), static_cast<Eigen::Index>(shares.size()));
  Eigen::VectorXd weight(area.size());
  double volume = 0;
  for (const double v : stage.start->volumes)
    volume += v;
  const double thickness = film_thickness * volume / area.sum();
  const double carried = carries_enough * volume / static_cast<double>(area.size());
  for (Eigen::Index v = 0; v < area.size(); ++v) {
    const double own = stage.vertex_volumes[static_cast<std::size_t>(v)];
    weight[v] = std::min({1.0, own / (thickness * area[v]), own / carried});
    if (!round && own < carried)
      weight[v] *= std::clamp(2 - 2 * own / (area[v] * lengths[3 * v]), least_weight, 1.0);
  }
  return weight;
}

// What errors and remainders are measured in: the mean length of a vertex' edges, radians, more where little is
// carried.
Eigen::VectorXd measures(const Stage& stage, const Eigen::VectorXd& lengths, bool round) {
  const Eigen::VectorXd weight = vertex_weights(stage, lengths, round);
  Eigen::VectorXd result = lengths;
  for (Eigen::Index v = 0; v < weight.size(); ++v)
    result.segment<3>(3 * v) /= weight[v];
  if (const auto& edges = stage.start->mesh->edges; result.size() > 3 * weight.size())
    for (std::size_t e = 0; e < edges.size(); ++e)
      result[3 * weight.size() + static_cast<Eigen::Index>(e)] /= std::max(weight[edges[e][0]], weight[edges[e][1]]);
  return result;
}

// The first stage of a step, where it ends by extrapolation, and what its unknowns are measured in.
struct Beginning {
  Stage stage;
  Unknowns guess;
  Eigen::VectorXd lengths, scale; // of the edges; see measures()
};

Beginning begin_step(const Model& model, const State& state, double duration) {
  const heat::Profile profile = model.heat ? model.heat->profile : heat::Profile{};
  Beginning result{
      first_stage(state, model.liquids(), duration, state.time + duration, model.has_angles(), profile), {}, {}, {}};
  Stage& stage = result.stage;
  result.lengths = step_scale(state, stage.begin.size());
  result.scale = measures(stage, result.lengths, model.faces.has_value());
  stage.stiffened = stiffened_films(stage, model.has_inertia());
  set_clamped(model.holds, stage);
  set_wall_sites(model.walls, stage);
  result.guess = stage.begin;
  for (std::size_t v = 0; v < state.positions.size(); ++v)
    result.guess.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
  turn_with_normals(stage, result.guess);
  return result;
}

bool same_mesh(const Connectivity& a, const Connectivity& b) {
  return &a == &b || (a.vertices == b.vertices && a.triangles == b.triangles);
}

} // namespace

// What stays from step to step while the connectivity does.
struct Stepper::Cache {
  std::shared_ptr<const Connectivity> mesh;
  std::vector<std::uint32_t> signature;
  Terms terms;
  LinearSystem system;
  std::optional<heat::Solver> heat; // if the model has some
};

Stepper::Stepper(Model model, StepOptions options) : model_(std::move(model)), options_(options) {}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;

void Stepper::prepare_cache(const State& state, StepReport& report) {
  const bool same = cache_ && same_mesh(*cache_->mesh, *state.mesh);
  if (same && !cache_->terms.empty())
    return;
  Terms terms = make_terms(model_, state.mesh);
  // The elements that the matrix has, beyond those of the mesh.
  std::vector<std::uint32_t> signature;
  for (const auto& term : terms) {
    signature.push_back(static_cast<std::uint32_t>(term->stencil()));
    if (term->stencil() == Stencil::four)
      for (std::size_t i = 0; i < term->size(); ++i)
        for (const auto v : term->nodes(i))
          signature.push_back(v);
  }
  if (same && signature == cache_->signature) {
    cache_->terms = std::move(terms);
    return;
  }
  if (!cache_)
    cache_ = std::make_unique<Cache>(); // memory is kept from one mesh to the next
  if (!same)
    cache_->heat.reset();
  cache_->mesh = state.mesh;
  cache_->signature = std::move(signature);
  cache_->terms = std::move(terms);
  cache_->system.analyze(state.mesh, cache_->terms, model_.has_angles());
  report.seconds_analysis += cache_->system.seconds_analysis();
}

void Stepper::set_model(Model model) {
  model_ = std::move(model);
  if (cache_)
    cache_->terms.clear();
  if (flat_) {
    Model flat = model_;
    flat.arcs = false;
    flat_->set_model(std::move(flat));
  }
}

Stepper::Outcome Stepper::attempt(const State& state, double dt, Scheme scheme, Demand demand, Estimate estimate,
                                  State& end, StepReport& report) {
  return state.to_make_up.empty() ? attempt_from(state, dt, scheme, demand, estimate, end, report)
                                  : attempt_from(put_back(state, dt), dt, scheme, demand, estimate, end, report);
}

Stepper::Outcome Stepper::attempt_from(const State& state, double dt, Scheme scheme, Demand demand, Estimate estimate,
                                       State& end, StepReport& report) {
  const bool two = scheme == Scheme::sdirk2;
  const double gamma = two ? sdirk_gamma : 1;
  report.room = std::numeric_limits<double>::infinity();
  Beginning beginning;
  tbb::parallel_invoke([&] { prepare_cache(state, report); }, // in parts on one thread
                       [&] { beginning = begin_step(model_, state, gamma * dt); });
  Stage& stage = beginning.stage;
  stage.left_over = two ? 1 - gamma / (1 - gamma) : 0;
  const Eigen::VectorXd& scale = beginning.scale;
  // Without inertia a sheet that is not held is free to move rigidly, and a flat membrane to leave its plane.
  const bool determined = model_.has_inertia() || (at_places(model_) >= 3 && model_.bending != Bending::none);
  cache_->system.constrain(constraints_of(model_.holds, stage), determined ? 0 : smallest_floor);
  StageSolve solver(cache_->system, cache_->terms, model_.holds, scale, options_.newton, demand);
  const auto solve = [&](const Unknowns& guess, const Unknowns& safe, Unknowns& u) {
    if (options_.thickness == Thickness::as_started)
      raise_as_started(stage);
    return solver.solve(stage, guess, safe, options_.iterations - report.newton.spent(), report.newton, u);
  };

  std::optional<StepHeat> heat;
  if (model_.heat && !state.temperatures.empty()) {
    if (!cache_->heat)
      cache_->heat.emplace(state.mesh);
    heat.emplace(model_, *cache_->heat, state);
  }

  Unknowns first, last;
  if (!solve(beginning.guess, stage.begin, first))
    return Outcome::not_converged;
  if (heat)
    heat->first_stage(stage, cache_->terms, first);
  if (two) {
    if (heat && !heat->goes_on((1 - gamma) / gamma))
      return Outcome::cools_too_fast;
    if (heat)
      heat->extrapolate(gamma, stage);
    report.room = second_stage(stage, first, gamma, dt);
    if (report.room < 1)
      return Outcome::shrinks_to_nothing;
    set_wall_sites(model_.walls, stage);
    cache_->system.turn_slides(stage);
    if (!solve(stage.begin + (first - stage.begin) / gamma, first, last))
      return Outcome::not_converged;
    if (heat)
      heat->second_stage(stage, cache_->terms, last);
  } else {
    last = first;
  }
  const Outcome outcome =
      finish_step(state, dt, stage, first, last, scale, estimate, heat ? &*heat : nullptr, end, report);
  if (outcome == Outcome::done && slides_too_far(stage, last, dt, beginning.lengths))
    return Outcome::slides_too_far;
  return outcome;
}

// first: the first stage's result; last: that of the last stage, which is the end of the step.
Stepper::Outcome Stepper::finish_step(const State& state, double dt, Stage& stage, const Unknowns& first,
                                      const Unknowns& last, const Eigen::VectorXd& scale, Estimate estimate,
                                      const StepHeat* heat, State& end, StepReport& report) {
  const bool two = stage.previous != nullptr;
  const std::size_t n = state.positions.size();
  end = state;
  end.time = state.time + dt;
  end.overshoot.clear();
  for (std::size_t v = 0; v < n; ++v) {
    const auto at = static_cast<Eigen::Index>(3 * v);
    const Vector3 x = last.segment<3>(at), x0 = state.positions[v];
    const Vector3 x1 = first.segment<3>(at);
    const Vector3 reference = two ? Vector3(x0 + stage.ratio * (x1 - x0)) : x0;
    end.positions[v] = x;
    end.velocities[v] = (x - reference) / stage.duration;
  }
  stop_free_motion(state, stage, end);
  if (turns_about_holds(model_))
    stop_turning_about(model_.holds, end.time, *state.mesh, end.positions, end.velocities);
  estimate_error(state, dt, stage, first, last, end, scale, estimate, report);
  if (heat != nullptr) {
    heat->put(end);
    report.error = std::max(report.error, heat->error(stage));
  }
  end.director_angles = director_angles(stage, last);
  set_prescribed_velocities(stage, end);
  for (const auto& term : cache_->terms)
    term->finish(last, end);
  if (!sound(end))
    return Outcome::shrinks_to_nothing;
  if (model_.reactions == Reactions::of_stage)
    report.reactions = stage_reactions(cache_->system, cache_->terms, model_, state, end, dt, stage, last);
  else if (model_.reactions == Reactions::at_end)
    report.reactions = end_reactions(cache_->system, cache_->terms, model_, state, end, dt, options_.newton);
  if (level_layers(stage, model_.gravity, model_.holds, model_.faces.has_value(), dt, end))
    set_prescribed_velocities(stage, end);
  set_distances_from_walls(model_.walls, model_.holds, model_.contacts, model_.gravity, stage, end);
  return Outcome::done;
}

// Of what floats without inertia.
void Stepper::stop_free_motion(const State& state, const Stage& stage, State& end) const {
  const FreePieces free = free_pieces(model_, *state.mesh);
  if (free.of_vertex.empty())
    return;
  stop_turning(free, end.positions, model_.gravity, end.velocities);
  drift_steadily(free, {state.positions, state.velocities, stage.vertex_volumes}, end.time - state.time, model_.gravity,
                 end.positions, end.velocities);
}

void Stepper::set_prescribed_velocities(const Stage& stage, State& end) const {
  set_velocities_on_walls(model_.walls, stage, end.time, end);
  set_held_velocities(model_.holds, end.time, end);
}

// The difference e to the first-order result, from the slope of the first stage, or of backward Euler to the
// trapezoidal rule. That of SDIRK2 is led through an implicit step of M x'' + D x' + K x = 0, (1 - τJ)⁻¹ e, as such a
// result is worth nothing where forces relax within the step: what an impulse of contact or a new mesh has left in the
// velocities. On a wall it is taken in the wall's frame, as the wall's own motion is exact. [Shampine and Baca 1984;
// Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8].
void Stepper::estimate_error(const State& state, double dt, const Stage& stage, const Unknowns& first,
                             const Unknowns& last, const State& end, const Eigen::VectorXd& scale, Estimate estimate,
                             StepReport& report) const {
  const bool two = stage.previous != nullptr;
  const double tau = stage.duration, gamma = tau / dt;
  Eigen::VectorXd e = Eigen::VectorXd::Zero(last.size()), speeds = e;
  for (std::size_t v = 0; v < state.positions.size(); ++v) {
    const auto at = static_cast<Eigen::Index>(3 * v);
    const Vector3 &x0 = state.positions[v], &v0 = state.velocities[v], x1 = first.segment<3>(at);
    const WallSite* site = site_at(stage, static_cast<std::uint32_t>(v));
    const Vector3 lower = two && site != nullptr ? Vector3(site->stuck + (site->carried - site->stuck) / (1 - gamma))
                          : two                  ? Vector3(x0 + (x1 - x0) / gamma)
                                                 : Vector3(x0 + 0.5 * dt * (v0 + end.velocities[v]));
    e.segment<3>(at) = last.segment<3>(at) - lower;
    if (site != nullptr && channel_of(stage, *site) != nullptr) // its place between two walls is exact
      e.segment<3>(at) -= site->normal.dot(e.segment<3>(at)) * site->normal;
    speeds.segment<3>(at) = end.velocities[v] - (v0 + ((x1 - x0) / tau - v0) / gamma);
  }
  LinearSystem& system = cache_->system;
  const bool filtered = estimate == Estimate::filtered && two && system.has_factor();
  if (filtered && !state.overshoot.empty())
    take_away_overshoot(stage, gamma, last, e, speeds);
  if (filtered)
    e += system.respond(tau * system.multiply(cache_->terms, Kind::inertial, last, speeds) -
                        system.multiply(cache_->terms, Kind::elastic, last, e));
  std::vector<double> errors(state.positions.size());
  for (std::size_t v = 0; v < errors.size(); ++v) {
    const auto at = static_cast<Eigen::Index>(3 * v);
    errors[v] = e.segment<3>(at).norm() / scale[at];
  }
  if (const StepError error = step_error(errors, stage.vertex_volumes); error.value > report.error) {
    report.error = error.value;
    report.worst = error.vertex;
  }
}

// What the sheet makes of its overshoot (energy/overshoot.h) is no error of this step: of what an estimate is made of,
// the linear response of both stages to it is taken away.
void Stepper::take_away_overshoot(const Stage& stage, double gamma, const Unknowns& last, Eigen::VectorXd& e,
                                  Eigen::VectorXd& speeds) const {
  LinearSystem& system = cache_->system;
  const auto force = [&](Kind kind, const Eigen::VectorXd& x) { return system.multiply(cache_->terms, kind, last, x); };
  Eigen::VectorXd held = Eigen::VectorXd::Zero(last.size()); // by which the vertices that overshot are moved
  for (std::size_t v = 0; v < stage.vertices(); ++v)
    held.segment<3>(static_cast<Eigen::Index>(3 * v)) = -stage.start->overshoot[v];
  const Eigen::VectorXd resistance =
      force(Kind::inertial, held) + force(Kind::dissipative, held) + force(Kind::elastic, held);
  const Eigen::VectorXd first = (held + system.respond(-resistance)) / stage.ratio;
  const Eigen::VectorXd second = held + system.respond(force(Kind::inertial, 2 * stage.ratio * first) +
                                                       force(Kind::dissipative, stage.ratio * first) - resistance);
  e -= second - first / gamma;
  speeds -= (second - stage.ratio * first - first / gamma) / stage.duration;
}

Stepper& Stepper::without_arcs() {
  if (!flat_) {
    Model model = model_;
    model.arcs = false;
    flat_ = std::make_unique<Stepper>(std::move(model), options_);
  }
  return *flat_;
}

void Stepper::clear_times() {
  if (cache_)
    cache_->system.clear_seconds();
  if (flat_)
    flat_->clear_times();
}

// Of what was done since clear_times, without arcs as well.
void Stepper::tell_times(StepReport& report) const {
  if (cache_) { // else arcs have rested from the first step on
    const std::vector<double>& seconds = cache_->system.assembly().seconds();
    for (std::size_t t = 0; t < seconds.size(); ++t)
      report.terms.push_back({t < cache_->terms.size() ? cache_->terms[t]->name() : "gathering", seconds[t]});
  }
  if (flat_ && flat_->cache_ && flat_->cache_->system.assembly().seconds().back() > 0)
    flat_->tell_times(report);
}

// flat: whether it was done without arcs, as it did not converge with them.
Stepper::Outcome Stepper::attempt_either(const State& state, double dt, State& end, bool& flat, StepReport& report) {
  flat = arcs_rest_ && has_arcs();
  if (!flat) {
    const Outcome outcome = attempt(state, dt, options_.scheme, Demand::converged, Estimate::filtered, end, report);
    if (outcome != Outcome::not_converged || !has_arcs())
      return outcome;
    ++report.failed;
  }
  flat = true;
  report.error = 0;
  return without_arcs().attempt(state, dt, options_.scheme, Demand::converged, Estimate::filtered, end, report);
}

} // namespace sheet
