// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/heat/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "libsheet/base/each.h"
#include "libsheet/base/error.h"
#include "libsheet/geometry/metric.h"
#include "libsheet/heat/conduction.h"
#include "libsheet/heat/local_heat.h"

namespace sheet::heat {

namespace {

constexpr int most_iterations = 50;
constexpr double close_enough = 1e-6; // of the temperature: what the next iteration would change at most
constexpr double fast_enough = 0.1;   // a change or its rate below which the factor there is serves again [Kelley 1995]

void check(const Problem& problem, std::size_t triangles) {
  const std::size_t beyond = static_cast<std::size_t>(problem.profile.modes()) - 1;
  const auto has = [&](std::size_t size, std::size_t each, bool may_be_empty) {
    return size == triangles * each || (may_be_empty && size == 0);
  };
  const bool right = has(problem.squared_lengths.size(), 1, false) && has(problem.volumes.size(), 1, false) &&
                     has(problem.temperatures.size(), 1, false) && has(problem.modes.size(), beyond, true) &&
                     has(problem.sources.size(), 1, true) && has(problem.exposed[upper].size(), 1, true) &&
                     has(problem.exposed[lower].size(), 1, true) &&
                     has(problem.local_surroundings[upper].size(), 1, true) &&
                     has(problem.local_surroundings[lower].size(), 1, true);
  if (!right)
    throw std::logic_error("heat: an array has the wrong size");
  std::uint32_t last = 0;
  for (const WallContact& contact : problem.contacts) {
    if (contact.triangle < last || contact.triangle >= triangles || contact.wall >= problem.walls)
      throw std::logic_error("heat: contacts must ascend by triangle and be of walls that are counted");
    last = contact.triangle;
  }
}

bool radiates(const Problem& problem) {
  const auto any = [](std::span<const Surroundings> list) {
    return std::ranges::any_of(list, [](const Surroundings& s) { return s.emissivity > 0; });
  };
  return std::ranges::any_of(std::array{upper, lower}, [&](Face face) {
    const std::span<const Surroundings> local = problem.local_surroundings[face];
    return any(local.empty() ? std::span(&problem.surroundings[face], 1) : local);
  });
}

} // namespace

std::vector<Vector3> squared_lengths_of(const Connectivity& mesh, std::span<const Vector3> positions) {
  std::vector<Vector3> all(mesh.triangles.size());
  each_in_parallel(all.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    all[t] = squared_lengths(positions[a], positions[b], positions[c]);
  });
  return all;
}

struct Solver::Impl {
  std::shared_ptr<const Connectivity> mesh;
  std::optional<EdgeSystem> edges; // made when something conducts

  explicit Impl(std::shared_ptr<const Connectivity> of) : mesh(std::move(of)) {}

  [[nodiscard]] Result stage(const Problem& problem);
  template <int Count> [[nodiscard]] Result solve(const Problem& problem);
};

namespace {

// The state of a solution: what Newton's method works on. Count: of the modes (LocalHeat).
template <int Count> struct Work {
  using Local = LocalHeat<Count>;

  const Problem& problem;
  const Connectivity& mesh;
  Local local;
  std::vector<Conductances> conductances;    // of each triangle; empty where nothing conducts
  std::vector<double> edge_temperatures;     // λ
  std::vector<double> exchanged;             // E, of each triangle
  std::vector<typename Local::State> states; // of each triangle
  std::vector<typename Local::Step> steps;   // likewise, of the last iteration

  Work(const Problem& of, const Connectivity& on);
  [[nodiscard]] bool conducts() const { return !conductances.empty(); }
  [[nodiscard]] Vector3 around(std::size_t t) const {
    const auto& e = mesh.triangle_edges[t];
    return {edge_temperatures[e[0]], edge_temperatures[e[1]], edge_temperatures[e[2]]};
  }
  double improve(std::optional<EdgeSystem>& system, bool factorize);
  [[nodiscard]] std::vector<double> edge_fluxes() const;
  [[nodiscard]] Result result() const;
};

template <int Count>
Work<Count>::Work(const Problem& of, const Connectivity& on)
    : problem(of), mesh(on), local(of), exchanged(on.triangles.size()), states(on.triangles.size()),
      steps(on.triangles.size()) {
  each_in_parallel(states.size(), [&](std::size_t t) { states[t] = local.start(t); });
  if (problem.conductivity <= 0)
    return;
  conductances.resize(states.size());
  each_in_parallel(states.size(), [&](std::size_t t) {
    conductances[t] = Conductances(problem.squared_lengths[t], problem.volumes[t], problem.conductivity);
  });
  edge_temperatures.resize(mesh.edges.size());
  each_in_parallel(mesh.edges.size(), [&](std::size_t e) {
    const auto& [a, b] = mesh.edge_triangles[e];
    const double first = problem.temperatures[a != no_index ? a : b];
    edge_temperatures[e] = 0.5 * (first + problem.temperatures[b != no_index ? b : a]);
  });
}

// One iteration of Newton's method, with a new matrix or the one there is (all of it: what edges give and take must be
// the same); the greatest change of a temperature, as a part of the greatest temperature.
template <int Count> double Work<Count>::improve(std::optional<EdgeSystem>& system, bool factorize) {
  std::vector<double> weights(conductances.size());
  std::vector<Vector3> loads(conductances.size());
  each_in_parallel(states.size(), [&](std::size_t t) {
    const double g = conducts() ? conductances[t].exchange : 0;
    steps[t] = local.step(t, states[t], g, factorize);
    if (!conducts())
      return;
    const Vector3 edges = around(t);
    weights[t] = g / 9 * steps[t].part;
    loads[t] = conductances[t].fluxes(steps[t].exchanged(g, edges.mean()), edges);
  });
  if (conducts()) {
    if (factorize)
      system->factorize(conductances, weights);
    const std::vector<double> changes = system->solve(loads);
    for (std::size_t e = 0; e < edge_temperatures.size(); ++e)
      edge_temperatures[e] += changes[e];
  }
  std::vector<double> changes(states.size()), sizes(states.size());
  each_in_parallel(states.size(), [&](std::size_t t) {
    exchanged[t] = conducts() ? steps[t].exchanged(conductances[t].exchange, around(t).mean()) : 0;
    changes[t] = local.advance(t, steps[t], exchanged[t], states[t]);
    sizes[t] = std::abs(states[t].modes[0]);
  });
  const double greatest = changes.empty() ? 0 : *std::ranges::max_element(changes);
  return greatest > 0 ? greatest / *std::ranges::max_element(sizes) : 0;
}

// The flux through each edge from its first triangle to its second, the mean of what both have: 0 at a rim.
template <int Count> std::vector<double> Work<Count>::edge_fluxes() const {
  std::vector<double> fluxes(mesh.edges.size());
  if (!conducts())
    return fluxes;
  std::vector<Vector3> leaving(states.size());
  each_in_parallel(states.size(), [&](std::size_t t) { leaving[t] = conductances[t].fluxes(exchanged[t], around(t)); });
  const auto through = [&](std::uint32_t t, std::size_t e) {
    const auto& edges = mesh.triangle_edges[t];
    return leaving[t][std::ranges::find(edges, e) - edges.begin()];
  };
  each_in_parallel(fluxes.size(), [&](std::size_t e) {
    if (!mesh.on_rim(e))
      fluxes[e] = 0.5 * (through(mesh.edge_triangles[e][0], e) - through(mesh.edge_triangles[e][1], e));
  });
  return fluxes;
}

template <int Count> Result Work<Count>::result() const {
  const std::size_t triangles = states.size(), beyond = static_cast<std::size_t>(problem.profile.modes()) - 1;
  const std::vector<double> fluxes = edge_fluxes();
  Result result;
  result.temperatures.resize(triangles);
  result.modes.resize(triangles * beyond);
  each_in_parallel(triangles, [&](std::size_t t) {
    double gain = problem.sources.empty() ? 0 : problem.sources[t];
    for (const std::uint32_t e : mesh.triangle_edges[t])
      gain -= mesh.edge_triangles[e][0] == t ? fluxes[e] : -fluxes[e];
    gain -= local.lost(t, states[t]);
    result.temperatures[t] =
        problem.temperatures[t] + problem.duration * gain / (problem.capacity(t) * problem.volumes[t]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(local.modes()) - 1; ++k)
      result.modes[t * beyond + k] = states[t].modes[static_cast<Eigen::Index>(k + 1)];
  });
  Account& account = result.account;
  account.walls.resize(problem.walls);
  for (std::size_t t = 0; t < triangles; ++t) {
    account.stored += problem.capacity(t) * problem.volumes[t] * (result.temperatures[t] - problem.temperatures[t]);
    account.generated += problem.sources.empty() ? 0 : problem.duration * problem.sources[t];
    for (const Face face : {upper, lower})
      account.faces[face] += problem.duration * states[t].surroundings[face];
  }
  if (!std::isfinite(account.stored))
    fail(ExitCode::not_converged, "heat: temperatures are not finite; are all volumes and positions?");
  for (const WallContact& contact : problem.contacts) {
    const double there = local.face_temperature(states[contact.triangle], contact.face);
    account.walls[contact.wall] += problem.duration * contact.conductance * (there - contact.temperature);
  }
  return result;
}

} // namespace

template <int Count> Result Solver::Impl::solve(const Problem& problem) {
  Work<Count> work(problem, *mesh);
  if (work.conducts() && !edges)
    edges.emplace(*mesh);
  bool factorize = true;
  double before = 0;
  for (int i = 1; i <= most_iterations; ++i) {
    const double change = work.improve(edges, factorize), rate = i == 1 ? 1 : change / before;
    if (!radiates(problem) || change * rate <= close_enough) {
      Result result = work.result();
      result.iterations = i;
      return result;
    }
    factorize = std::min(change, rate) > fast_enough;
    before = change;
  }
  fail(ExitCode::not_converged, "heat: temperatures do not converge in {} iterations: {}", most_iterations,
       problem.profile.modes() > 1 && problem.profile.follows
           ? "the parabola across the thickness may not follow its faces; profile = 3 in [heat] gives it modes of its "
             "own. Or take shorter steps: sheet-run --quality fine, sheet-step --tolerance"
           : "take shorter steps: sheet-run --quality fine, sheet-step --tolerance");
}

Result Solver::Impl::stage(const Problem& problem) {
  check(problem, mesh->triangles.size());
  if (problem.conductivity <= 0 || problem.profile.modes() == 1)
    return solve<1>(problem);
  return problem.profile.modes() == 3 ? solve<3>(problem) : solve<Eigen::Dynamic>(problem);
}

Solver::Solver(std::shared_ptr<const Connectivity> mesh) : impl_(std::make_unique<Impl>(std::move(mesh))) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

Result Solver::stage(const Problem& problem) { return impl_->stage(problem); }

} // namespace sheet::heat
