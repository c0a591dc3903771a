// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/reactions.h"

#include "libsheet/energy/channels.h"
#include "libsheet/energy/stage_setup.h"

namespace sheet {

namespace {

constexpr double instant_part = 1e-3;      // of a step: an instant, whose end has the shape of its start
constexpr double instant_tolerance = 1e-6; // of an edge a step: what may remain of the velocities at an instant

// Of forces [N, N m], one an unknown, the part that what is prescribed has to balance.
Eigen::VectorXd prescribed_part(const Constraints& constraints, const Eigen::VectorXd& forces) {
  Eigen::VectorXd free = forces;
  constraints.project(free);
  return forces - free;
}

Vector3 at_vertex(const Eigen::VectorXd& unknowns, std::size_t vertex) {
  return unknowns.segment<3>(static_cast<Eigen::Index>(3 * vertex));
}

// What lies between two walls (channels.h).
void add_forces_in_gaps(const Terms& terms, const Model& model, const Stage& stage, const Unknowns& u,
                        std::vector<SolidForce>& more) {
  const std::vector<Vector3> none(stage.vertices(), Vector3::Zero());
  GapForces forces{none, none};
  for (const auto& term : terms)
    term->add_gap_forces(u, forces);
  for (const WallSite& site : stage.sites)
    if (const Channel* channel = channel_of(stage, site)) {
      more.push_back({model.walls[site.wall].solid, forces.own[site.vertex]});
      more.push_back({model.walls[channel->facing].solid, forces.facing[site.vertex]});
    }
}

// What another wall holds beside the own one, as a blade pushes a layer along its floor: of what holds it the part
// along that wall's normal n2 and the own one's n1, f = f1 n1 + f2 n2, is each wall's.
void add_forces_beside(const Model& model, const Stage& stage, const Eigen::VectorXd& holding,
                       std::vector<SolidForce>& more) {
  for (const WallSite& site : stage.sites) {
    if (site.second_wall == no_index)
      continue;
    const Vector3& along = site.across[1];
    const Vector3 push =
        at_vertex(holding, site.vertex).dot(along) / site.second_normal.dot(along) * site.second_normal;
    more.push_back({model.walls[site.second_wall].solid, push});
    more.push_back({model.walls[site.wall].solid, -push});
  }
}

// The potential's gradient in the prescribed directions, and what walls do along themselves, with the stage as it is.
HoldingForces reactions(LinearSystem& system, const Terms& terms, const Model& model, const Stage& stage,
                        const Unknowns& u) {
  const Constraints constraints = system.constraints();
  for (const auto& term : terms)
    term->begin(stage);
  Eigen::VectorXd gradient;
  system.constrain({}, 0);
  (void)system.gradient(terms, u, gradient);
  gradient = prescribed_part(constraints, gradient);
  HoldingForces result;
  result.all.assign(stage.vertices(), Vector3::Zero());
  for (const auto& term : terms)
    term->add_wall_forces(u, result.all);
  for (std::size_t v = 0; v < result.all.size(); ++v)
    result.all[v] += at_vertex(gradient, v);
  if (!stage.channels.empty())
    add_forces_in_gaps(terms, model, stage, u, result.more);
  add_forces_beside(model, stage, gradient, result.more);
  if (model.external_reactions) {
    const Eigen::VectorXd external = prescribed_part(constraints, system.external_gradient(terms, u));
    for (std::size_t v = 0; v < stage.vertices(); ++v)
      result.external.push_back(at_vertex(external, v));
  }
  system.constrain(constraints, system.floor());
  return result;
}

// The acceleration of what is prescribed, at the end of a step of dt [s], from its velocities just before: those at the
// end itself may be another motion's [m/s²]. Free directions have none.
std::vector<Vector3> prescribed_accelerations(const Model& model, const Stage& stage, const State& end, double dt) {
  const double moment = instant_part * dt;
  const auto before = [&](double time) {
    State state = end;
    for (std::size_t v = 0; v < state.positions.size(); ++v)
      state.positions[v] -= time * end.velocities[v];
    set_velocities_on_walls(model.walls, stage, end.time - time, state);
    set_held_velocities(model.holds, end.time - time, state);
    return state.velocities;
  };
  std::vector<Vector3> result = before(moment);
  const std::vector<Vector3> earlier = before(2 * moment);
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = (result[v] - earlier[v]) / moment;
  return result;
}

} // namespace

HoldingForces stage_reactions(LinearSystem& system, const Terms& terms, const Model& model, const State& start,
                              const State& end, double dt, Stage& stage, const Unknowns& u) {
  // What is prescribed does not obey the scheme, whose accelerations are wrong for it: the mean of the step counts.
  Eigen::VectorXd change = Eigen::VectorXd::Zero(u.size());
  for (std::size_t v = 0; v < stage.vertices(); ++v)
    change.segment<3>(static_cast<Eigen::Index>(3 * v)) =
        end.positions[v] - stage.duration * stage.duration / dt * (end.velocities[v] - start.velocities[v]) -
        stage.inertial[v];
  change = prescribed_part(system.constraints(), change);
  for (std::size_t v = 0; v < stage.vertices(); ++v)
    stage.inertial[v] += at_vertex(change, v);
  return reactions(system, terms, model, stage, u);
}

HoldingForces end_reactions(LinearSystem& system, const Terms& terms, const Model& model, const State& start,
                            const State& end, double dt, const NewtonOptions& options) {
  const double duration = instant_part * dt;
  State before = end;
  before.time = end.time - duration; // so that what is prescribed moves as it did until the end
  Stage instant = first_stage(before, model.liquids(), duration, end.time, model.has_angles(),
                              model.heat ? model.heat->profile : heat::Profile{});
  instant.inertial_time = dt;
  for (std::size_t v = 0; v < end.positions.size(); ++v)
    instant.inertial[v] -= duration * (end.velocities[v] - start.velocities[v]);
  set_clamped(model.holds, instant);
  set_wall_sites(model.walls, instant);
  system.constrain(constraints_of(model.holds, instant), system.floor());
  Unknowns guess = instant.begin;
  for (std::size_t v = 0; v < end.positions.size(); ++v)
    guess.segment<3>(static_cast<Eigen::Index>(3 * v)) = instant.predicted[v];
  turn_with_normals(instant, guess);
  const Eigen::VectorXd scale = instant_part * step_scale(end, guess.size());
  const NewtonOptions strict{.tolerance = instant_tolerance, .iterations = options.iterations};
  NewtonReport report;
  Unknowns u;
  StageSolve solver(system, terms, model.holds, scale, strict, Demand::converged);
  (void)solver.solve(instant, guess, instant.begin, options.iterations, report, u);
  const std::vector<Vector3> prescribed = prescribed_accelerations(model, instant, end, dt);
  for (std::size_t v = 0; v < end.positions.size(); ++v)
    instant.inertial[v] = instant.position(u, static_cast<std::uint32_t>(v)) - duration * dt * prescribed[v];
  return reactions(system, terms, model, instant, u);
}

} // namespace sheet
