// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step_heat.h"

#include <algorithm>
#include <cmath>

namespace sheet {

namespace {

// What touches: of each face the part that sees its surroundings, and the heat that walls may take.
struct Touching {
  std::array<std::vector<double>, 2> exposed;
  std::vector<heat::WallContact> contacts; // by triangle
};

Touching touching_of(const HeatModel& model, const State& start, std::span<const Vector3> x, double time) {
  Touching touching;
  if (std::ranges::all_of(model.walls, [](const WarmWall& wall) { return wall.vertices.empty(); }))
    return touching;
  const std::vector<Corners>& triangles = start.mesh->triangles;
  struct Touch {
    std::uint32_t wall;
    Vector3 normal;
  };
  std::vector<std::vector<Touch>> touches(x.size());
  for (std::uint32_t w = 0; w < model.walls.size(); ++w)
    for (const std::uint32_t v : model.walls[w].vertices)
      touches[v].push_back({w, model.walls[w].normal(time, x[v])});
  for (std::vector<double>& exposed : touching.exposed)
    exposed.assign(triangles.size(), 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[t];
    const Vector3 twice = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
    for (const std::uint32_t v : c)
      for (const Touch& touch : touches[v]) {
        const WarmWall& wall = model.walls[touch.wall];
        const heat::Face face = touch.normal.dot(twice) > 0 ? heat::lower : heat::upper;
        double& exposed = touching.exposed[face][t];
        exposed = std::max(0.0, exposed - 1.0 / 3);
        if (wall.temperature)
          touching.contacts.push_back(
              {t, face, touch.wall, wall.conductance * twice.norm() / 6, wall.temperature(time)});
      }
  }
  return touching;
}

} // namespace

StepHeat::StepHeat(const HeatModel& model, heat::Solver& solver, const State& start)
    : model_(model), solver_(solver), start_(start) {}

void StepHeat::solve(const Stage& stage, const Terms& terms, const Unknowns& u, std::vector<double> reference) {
  reference_ = std::move(reference);
  duration_ = stage.duration;
  std::vector<Vector3> x(stage.vertices());
  for (std::uint32_t v = 0; v < x.size(); ++v)
    x[v] = Stage::position(u, v);
  const std::vector<Vector3> lengths = heat::squared_lengths_of(*start_.mesh, x);
  const Touching touching = touching_of(model_, start_, x, stage.end_time);
  std::vector<double> sources;
  if (model_.viscous) {
    sources.assign(start_.volumes.size(), 0);
    for (const auto& term : terms)
      term->add_dissipated(u, sources);
    for (double& source : sources)
      source /= stage.duration;
  }
  heat::Problem problem;
  problem.heat_capacity = model_.capacity;
  problem.conductivity = model_.conductivity;
  problem.duration = stage.duration;
  problem.profile = model_.profile;
  problem.squared_lengths = lengths;
  problem.volumes = start_.volumes;
  problem.temperatures = reference_;
  problem.sources = sources;
  problem.surroundings = model_.surroundings;
  for (std::size_t face = 0; face < 2; ++face)
    problem.exposed[face] = touching.exposed[face];
  problem.contacts = touching.contacts;
  problem.walls = model_.walls.size();
  heat::Result result = solver_.stage(problem);
  last_ = std::move(result.temperatures);
  moved_.generated += result.account.generated;
  moved_.upper += result.account.faces[heat::upper];
  moved_.lower += result.account.faces[heat::lower];
  for (const double wall : result.account.walls)
    moved_.solids += wall;
}

void StepHeat::first_stage(const Stage& stage, const Terms& terms, const Unknowns& u) {
  moved_ = {};
  solve(stage, terms, u, start_.temperatures);
  first_ = last_;
}

bool StepHeat::goes_on(double ratio) const {
  for (std::size_t t = 0; t < first_.size(); ++t)
    if (!(start_.temperatures[t] + ratio * (first_[t] - start_.temperatures[t]) > 0.25 * start_.temperatures[t]))
      return false;
  return true;
}

std::vector<double> StepHeat::extrapolated(double gamma) const {
  constexpr double least = 0.25; // of T0: what falls further has no viscosity that could be foretold
  std::vector<double> temperatures = start_.temperatures;
  for (std::size_t t = 0; t < first_.size(); ++t)
    temperatures[t] = std::max(least * temperatures[t], temperatures[t] + (first_[t] - temperatures[t]) / gamma);
  return temperatures;
}

void StepHeat::second_stage(const Stage& stage, const Terms& terms, const Unknowns& u) {
  std::vector<double> reference = start_.temperatures;
  for (std::size_t t = 0; t < reference.size(); ++t)
    reference[t] += stage.ratio * (first_[t] - reference[t]);
  moved_ = {stage.ratio * moved_.generated, stage.ratio * moved_.upper, stage.ratio * moved_.lower,
            stage.ratio * moved_.solids};
  solve(stage, terms, u, std::move(reference));
}

void StepHeat::put(State& end) const {
  end.temperatures = last_;
  end.temperature_rates.resize(last_.size());
  for (std::size_t t = 0; t < last_.size(); ++t)
    end.temperature_rates[t] = (last_[t] - reference_[t]) / duration_;
  end.heat_moved.generated += moved_.generated;
  end.heat_moved.upper += moved_.upper;
  end.heat_moved.lower += moved_.lower;
  end.heat_moved.solids += moved_.solids;
}

double StepHeat::error(const Stage& last) const {
  constexpr double of_viscosity = 0.1;
  const ViscosityShift shift(last.liquid.temperature_law);
  double greatest = 0;
  for (std::size_t t = 0; t < last_.size(); ++t) {
    greatest = std::max(greatest, std::abs(last_[t] - last.temperatures[t]) / last_[t]);
    if (!last.shift.empty())
      greatest = std::max(greatest, of_viscosity * std::abs(std::log(shift.factor(last_[t]) / last.shift[t])));
  }
  return greatest;
}

} // namespace sheet
