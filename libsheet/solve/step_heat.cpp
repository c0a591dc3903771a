// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step_heat.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/each.h"
#include "libsheet/energy/stage_setup.h"

namespace sheet {

namespace {

// What touches: of each face the part that sees its surroundings, and the heat that walls may take.
struct Touching {
  std::array<std::vector<double>, 2> exposed;
  std::vector<heat::WallContact> contacts; // by triangle
};

// Something that lies on the sheet at a vertex, on the side that its normal points away from.
struct Touch {
  std::uint32_t wall; // or no_index: another layer of the sheet
  Vector3 normal;
};

// Of each vertex; empty where nothing touches.
std::vector<std::vector<Touch>> touches_of(const Model& model, std::span<const Vector3> x, double time) {
  const std::vector<WarmWall>& walls = model.heat->walls;
  std::vector<std::vector<Touch>> touches;
  if (model.contacts.empty() && std::ranges::all_of(walls, [](const WarmWall& wall) { return wall.vertices.empty(); }))
    return touches;
  touches.resize(x.size());
  for (std::uint32_t w = 0; w < walls.size(); ++w)
    for (const std::uint32_t v : walls[w].vertices)
      touches[v].push_back({w, walls[w].normal(time, x[v])});
  for (const ContactSpring& spring : model.contacts)
    for (std::size_t i = 0; i < 4; ++i)
      if (spring.weights[i] != 0)
        touches[spring.vertices[i]].push_back(
            {no_index, spring.weights[i] > 0 ? spring.normal : Vector3(-spring.normal)});
  return touches;
}

Touching touching_of(const Model& model, const State& start, std::span<const Vector3> x, double time) {
  Touching touching;
  const std::vector<std::vector<Touch>> touches = touches_of(model, x, time);
  if (touches.empty())
    return touching;
  const std::vector<Corners>& triangles = start.mesh->triangles;
  for (std::vector<double>& exposed : touching.exposed)
    exposed.assign(triangles.size(), 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[t];
    const Vector3 twice = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
    std::array<int, 2> covered{};
    for (const std::uint32_t v : c) {
      std::array<bool, 2> here{};
      for (const Touch& touch : touches[v]) {
        const heat::Face face = touch.normal.dot(twice) > 0 ? heat::lower : heat::upper;
        here[face] = true;
        if (touch.wall == no_index || !model.heat->walls[touch.wall].temperature)
          continue;
        const WarmWall& wall = model.heat->walls[touch.wall];
        touching.contacts.push_back({t, face, touch.wall, wall.conductance * twice.norm() / 6, wall.temperature(time)});
      }
      covered[heat::upper] += here[heat::upper];
      covered[heat::lower] += here[heat::lower];
    }
    for (const heat::Face face : {heat::upper, heat::lower})
      touching.exposed[face][t] = 1 - covered[face] / 3.0;
  }
  return touching;
}

// Of a face of each triangle; none where they are the same everywhere.
std::vector<heat::Surroundings> surroundings_of(const HeatModel& model, heat::Face face, const State& start,
                                                std::span<const Vector3> x, double time) {
  const auto& local = model.local_surroundings[face];
  std::vector<heat::Surroundings> all(local ? start.mesh->triangles.size() : 0);
  each_in_parallel(all.size(), [&](std::size_t t) {
    const auto& [a, b, c] = start.mesh->triangles[t];
    all[t] = local(time, (x[a] + x[b] + x[c]) / 3);
  });
  return all;
}

} // namespace

StepHeat::StepHeat(const Model& model, heat::Solver& solver, const State& start)
    : model_(model), solver_(solver), start_(start) {}

void StepHeat::solve(const Stage& stage, const Terms& terms, const Unknowns& u, Temperatures reference) {
  const HeatModel& of_heat = *model_.heat;
  reference_ = std::move(reference);
  duration_ = stage.duration;
  std::vector<Vector3> x(stage.vertices());
  for (std::uint32_t v = 0; v < x.size(); ++v)
    x[v] = Stage::position(u, v);
  const std::vector<Vector3> lengths = heat::squared_lengths_of(*start_.mesh, x);
  const Touching touching = touching_of(model_, start_, x, stage.end_time);
  std::vector<double> sources;
  if (of_heat.viscous) {
    sources.assign(start_.volumes.size(), 0);
    for (const auto& term : terms)
      term->add_dissipated(u, sources);
    for (double& source : sources)
      source /= stage.duration;
  }
  heat::Problem problem;
  problem.heat_capacity = of_heat.capacity;
  problem.heat_capacities = of_heat.capacities;
  problem.conductivity = of_heat.conductivity;
  problem.duration = stage.duration;
  problem.profile = of_heat.profile;
  problem.squared_lengths = lengths;
  problem.volumes = start_.volumes;
  problem.temperatures = reference_.means;
  if (!of_heat.profile.follows)
    problem.modes = reference_.modes;
  problem.sources = sources;
  problem.surroundings = of_heat.surroundings;
  const std::array local = {surroundings_of(of_heat, heat::upper, start_, x, stage.end_time),
                            surroundings_of(of_heat, heat::lower, start_, x, stage.end_time)};
  for (std::size_t face = 0; face < 2; ++face)
    problem.local_surroundings[face] = local[face];
  for (std::size_t face = 0; face < 2; ++face)
    problem.exposed[face] = touching.exposed[face];
  problem.contacts = touching.contacts;
  problem.walls = of_heat.walls.size();
  heat::Result result = solver_.stage(problem);
  last_ = {std::move(result.temperatures), std::move(result.modes)};
  moved_.generated += result.account.generated;
  moved_.upper += result.account.faces[heat::upper];
  moved_.lower += result.account.faces[heat::lower];
  for (const double wall : result.account.walls)
    moved_.solids += wall;
}

void StepHeat::first_stage(const Stage& stage, const Terms& terms, const Unknowns& u) {
  moved_ = {};
  const std::size_t beyond = static_cast<std::size_t>(model_.heat->profile.modes()) - 1;
  Temperatures start{start_.temperatures, start_.temperature_modes};
  const bool known = start.modes.size() == beyond * start.means.size();
  if (!known) // the first step
    start.modes.assign(beyond * start.means.size(), 0);
  jump_ = !known && model_.heat->profile.follows;
  solve(stage, terms, u, std::move(start));
  first_ = last_;
}

bool StepHeat::goes_on(double ratio) const {
  for (std::size_t t = 0; t < first_.means.size(); ++t)
    if (const double start = start_.temperatures[t]; !(start + ratio * (first_.means[t] - start) > 0.25 * start))
      return false;
  return true;
}

void StepHeat::extrapolate(double gamma, Stage& stage) const {
  constexpr double least = 0.25; // of T0: what falls further has no viscosity that could be foretold
  std::vector<double> means = reference_.means, modes = reference_.modes; // those of the start
  for (std::size_t t = 0; t < means.size(); ++t)
    means[t] = std::max(least * means[t], means[t] + (first_.means[t] - means[t]) / gamma);
  for (std::size_t i = 0; i < modes.size(); ++i)
    modes[i] += (first_.modes[i] - modes[i]) / (jump_ ? 1 : gamma);
  set_temperatures(std::move(means), modes, model_.heat->profile, stage);
}

void StepHeat::second_stage(const Stage& stage, const Terms& terms, const Unknowns& u) {
  Temperatures reference = reference_; // those of the start
  for (std::size_t t = 0; t < reference.means.size(); ++t)
    reference.means[t] += stage.ratio * (first_.means[t] - reference.means[t]);
  for (std::size_t i = 0; i < reference.modes.size(); ++i)
    reference.modes[i] += stage.ratio * (first_.modes[i] - reference.modes[i]);
  moved_ = {stage.ratio * moved_.generated, stage.ratio * moved_.upper, stage.ratio * moved_.lower,
            stage.ratio * moved_.solids};
  solve(stage, terms, u, std::move(reference));
}

void StepHeat::put(State& end) const {
  const auto rates = [&](const std::vector<double>& from, const std::vector<double>& to) {
    std::vector<double> result(to.size());
    for (std::size_t i = 0; i < to.size(); ++i)
      result[i] = (to[i] - from[i]) / duration_;
    return result;
  };
  end.temperatures = last_.means;
  end.temperature_rates = rates(reference_.means, last_.means);
  end.temperature_modes = last_.modes;
  end.temperature_mode_rates = rates(reference_.modes, last_.modes);
  if (jump_)
    end.temperature_mode_rates.assign(last_.modes.size(), 0);
  end.heat_moved.generated += moved_.generated;
  end.heat_moved.upper += moved_.upper;
  end.heat_moved.lower += moved_.lower;
  end.heat_moved.solids += moved_.solids;
}

double StepHeat::error(const Stage& last) const {
  constexpr double of_viscosity = 0.1;
  std::vector<ViscosityShift> shifts;
  for (const StageLiquid& of : last.liquids)
    shifts.emplace_back(of.liquid.temperature_law);
  double greatest = 0;
  for (std::size_t t = 0; t < last_.means.size(); ++t) {
    const double change = std::abs(last_.means[t] - last.temperatures[t]);
    const ViscosityShift& shift = shifts[shifts.size() == 1 ? 0 : last.start->liquids[t]];
    const double slope = last.shift.empty() ? 0 : std::abs(shift.at(last_.means[t]).log_slope);
    greatest = std::max(greatest, change * std::max(1 / last_.means[t], of_viscosity * slope));
  }
  return greatest;
}

} // namespace sheet
