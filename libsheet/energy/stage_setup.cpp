// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/stage_setup.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "libsheet/base/each.h"
#include "libsheet/geometry/angles.h"
#include "libsheet/geometry/mean_normals.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/material/shifted_liquid.h"

namespace sheet {

namespace {

// Principal stretches (squared) of an extrapolated metric, over the start's.
constexpr double least_ratio = 0.25, greatest_ratio = 4;
// Of a director with the mean of the normals [rad]: where a sheet is folded flat that mean turns over, and no director
// follows it.
constexpr double greatest_turn = 1;

// The principal values of a change of the metric a.
struct Principal {
  double least, greatest;
  Principal(const RaisedMetric& a, const Vector3& change) {
    const double half = 0.5 * a.trace.dot(change);
    const double root = std::sqrt(std::max(0.0, half * half - form_determinant(change) / a.determinant));
    least = half - root;
    greatest = half + root;
  }
};

// a0 + change, but no principal stretch outside the bounds: beyond that the change is scaled down.
RaisedMetric predicted_metric(const Vector3& start, const Vector3& change) {
  const RaisedMetric a(start);
  const Principal p(a, change);
  double part = 1;
  if (p.least < least_ratio - 1)
    part = std::min(part, (least_ratio - 1) / p.least);
  if (p.greatest > greatest_ratio - 1)
    part = std::min(part, (greatest_ratio - 1) / p.greatest);
  return std::isfinite(part) ? RaisedMetric(start + part * change) : a;
}

std::vector<EdgeFrame> mean_normal_frames_of(const Stage& stage, const Unknowns& u) {
  std::vector<Vector3> positions(stage.vertices());
  each_in_parallel(positions.size(),
                   [&](std::size_t v) { positions[v] = stage.position(u, static_cast<std::uint32_t>(v)); });
  return mean_normal_frames(*stage.start->mesh, positions);
}

// Of a triangle whose squared edge lengths change so during the stage [Pa s].
double lagged_viscosity(const Stage& stage, std::size_t t, const Vector3& change) {
  return ShiftedCurve{stage.liquid_of(t).lagged, stage.shift_of(t)}.viscosity(
      strain_rate(stage.raised[t], change, stage.duration));
}

// T0 + τ dT/dt, by no more than a tenth of T0: what cools or warms so fast that this counts is not known better.
std::vector<double> predicted_temperatures(const State& state, double duration) {
  constexpr double most = 0.1;
  std::vector<double> predicted = state.temperatures;
  for (std::size_t t = 0; t < state.temperature_rates.size(); ++t)
    predicted[t] += std::clamp(duration * state.temperature_rates[t], -most * predicted[t], most * predicted[t]);
  return predicted;
}

std::vector<double> predicted_modes(const State& state, double duration) {
  std::vector<double> predicted = state.temperature_modes;
  for (std::size_t i = 0; i < predicted.size() && predicted.size() == state.temperature_mode_rates.size(); ++i)
    predicted[i] += duration * state.temperature_mode_rates[i];
  return predicted;
}

} // namespace

void set_temperatures(std::vector<double> temperatures, std::span<const double> modes, const heat::Profile& profile,
                      Stage& stage) {
  stage.temperatures = std::move(temperatures);
  const std::size_t count = stage.temperatures.size(), beyond = static_cast<std::size_t>(profile.modes()) - 1;
  const auto constant = [](const StageLiquid& of) { return of.liquid.temperature_law.constant(); };
  if (count == 0 || std::ranges::all_of(stage.liquids, constant))
    return;
  std::vector<ViscosityShift> shifts;
  for (const StageLiquid& of : stage.liquids)
    shifts.emplace_back(of.liquid.temperature_law);
  const auto shift_of = [&](std::size_t t) -> const ViscosityShift& {
    return shifts[shifts.size() == 1 ? 0 : stage.start->liquids[t]];
  };
  stage.shift.resize(count);
  if (beyond == 0 || modes.size() != beyond * count) {
    each_in_parallel(count, [&](std::size_t t) { stage.shift[t] = shift_of(t).factor(stage.temperatures[t]); });
    return;
  }
  const heat::ThicknessRule rule(profile);
  stage.crusts.resize(count);
  stage.wall_shifts.resize(count);
  each_in_parallel(count, [&](std::size_t t) {
    const double mean = stage.temperatures[t], least = 0.1 * mean; // whatever the modes, it is above 0
    const auto factor = [&](double temperature) { return shift_of(t).factor(std::max(least, temperature)); };
    const auto [zeroth, first, second] = rule.moments(mean, modes.subspan(beyond * t, beyond), factor);
    stage.shift[t] = zeroth;
    stage.crusts[t] = 12 * (second - first * first / zeroth) / zeroth;
    const auto fluid =
        rule.moments(mean, modes.subspan(beyond * t, beyond), [&](double there) { return 1 / factor(there); });
    for (const heat::Face face : {heat::upper, heat::lower}) {
      const double side = face == heat::upper ? 1 : -1, third = fluid.second + side * fluid.first + fluid.zeroth / 4;
      stage.wall_shifts[t][face] = 1 / (3 * third * zeroth);
    }
  });
}

namespace {

// Of each vertex, of one of its triangles.
std::vector<std::uint32_t> numbers_at_vertices(const State& state) {
  std::vector<std::uint32_t> numbers(state.positions.size(), 0);
  for (std::size_t t = 0; t < state.liquids.size(); ++t)
    for (const std::uint32_t v : state.mesh->triangles[t])
      numbers[v] = state.liquids[t];
  return numbers;
}

} // namespace

Stage first_stage(const State& state, std::span<const Liquid> liquids, double duration, double end_time, bool angles,
                  const heat::Profile& profile) {
  Stage stage;
  const Connectivity& mesh = *state.mesh;
  const std::size_t n = state.positions.size();
  stage.start = &state;
  stage.liquids.clear();
  for (const Liquid& liquid : liquids)
    stage.liquids.push_back({liquid, FlowCurve(liquid), soft_curve(liquid)});
  if (liquids.size() > 1)
    stage.vertex_liquids = numbers_at_vertices(state);
  stage.duration = duration;
  stage.inertial_time = duration;
  stage.end_time = end_time;
  stage.begin = Unknowns::Zero(static_cast<Eigen::Index>(3 * n + (angles ? mesh.edges.size() : 0)));
  stage.predicted.resize(n);
  each_in_parallel(n, [&](std::size_t v) {
    stage.begin.segment<3>(static_cast<Eigen::Index>(3 * v)) = state.positions[v];
    stage.predicted[v] = state.positions[v] + duration * state.velocities[v];
  });
  stage.inertial = stage.predicted;
  stage.vertex_volumes = vertex_shares(n, mesh.triangles, [&](std::uint32_t t) { return state.volumes[t]; });
  if (angles)
    stage.frames = director_frames(mesh, state.positions, state.director_angles);
  set_temperatures(predicted_temperatures(state, duration), predicted_modes(state, duration), profile, stage);
  stage.raised.resize(mesh.triangles.size());
  stage.viscosity.resize(mesh.triangles.size());
  const auto& x = state.positions;
  const auto& v = state.velocities;
  each_in_parallel(mesh.triangles.size(), [&](std::size_t t) {
    const Corners& c = mesh.triangles[t];
    Vector3 change;
    for (int k = 0; k < 3; ++k) {
      const auto a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      change[k] = 2 * duration * (x[b] - x[a]).dot(v[b] - v[a]);
    }
    stage.raised[t] = predicted_metric(squared_lengths(x[c[0]], x[c[1]], x[c[2]]), change);
    stage.viscosity[t] = lagged_viscosity(stage, t, change);
  });
  return stage;
}

double second_stage(Stage& stage, const Unknowns& first, double gamma, double dt) {
  const State& state = *stage.start;
  stage.previous = &first;
  stage.ratio = (1 - gamma) / gamma;
  stage.left_over = 0;
  stage.end_time = state.time + dt;
  each_in_parallel(state.positions.size(), [&](std::size_t v) {
    const Vector3& x0 = state.positions[v];
    const Vector3 moved = first.segment<3>(static_cast<Eigen::Index>(3 * v)) - x0;
    const Vector3 acceleration = (moved / stage.duration - state.velocities[v]) / stage.duration;
    const Vector3 velocity = state.velocities[v] + (1 - gamma) * dt * acceleration;
    stage.inertial[v] = x0 + stage.ratio * moved + stage.duration * velocity;
    stage.predicted[v] = x0 + moved / gamma;
  });
  std::atomic<double> room = std::numeric_limits<double>::infinity();
  each_in_parallel(state.mesh->triangles.size(), [&](std::size_t t) {
    const Corners& c = state.mesh->triangles[t];
    const auto& x = state.positions;
    const Vector3 start = squared_lengths(x[c[0]], x[c[1]], x[c[2]]);
    const Vector3 end =
        squared_lengths(stage.position(first, c[0]), stage.position(first, c[1]), stage.position(first, c[2]));
    stage.raised[t] = predicted_metric(start, (end - start) / gamma);
    stage.viscosity[t] = lagged_viscosity(stage, t, end - start);
    const double least = Principal(RaisedMetric(start), stage.ratio * (end - start)).least;
    const double own = least >= 0  ? std::numeric_limits<double>::infinity()
                       : least < 0 ? (least_ratio - 1) / least
                                   : 0; // not a number
    for (double other = room.load(std::memory_order_relaxed);
         own < other && !room.compare_exchange_weak(other, own, std::memory_order_relaxed);)
      ;
  });
  return room;
}

void turn_with_normals(const Stage& stage, Unknowns& u) {
  if (stage.frames.empty())
    return;
  const std::vector<EdgeFrame> means = mean_normal_frames_of(stage, u);
  const std::span<double> turns{u.data() + 3 * stage.vertices(), means.size()};
  std::vector<double> along(means.size()), sine(means.size(), 0), cosine(means.size(), 1);
  if (!stage.start->director_angles.empty())
    sines_and_cosines(stage.start->director_angles, sine, cosine);
  each_in_parallel(means.size(), [&](std::size_t e) {
    const Vector3 &t = means[e].tangent, wanted = cosine[e] * means[e].director + sine[e] * means[e].binormal;
    const Vector3 brought = stage.frames[e].carried(t);
    turns[e] = brought.cross(wanted).dot(t);
    along[e] = brought.dot(wanted);
  });
  angles_of(along, turns);
  for (double& turn : turns)
    if (std::abs(turn) > greatest_turn)
      turn = 0;
}

std::vector<double> director_angles(const Stage& stage, const Unknowns& u) {
  std::vector<double> angles(stage.frames.size());
  if (stage.frames.empty())
    return angles;
  const std::vector<EdgeFrame> means = mean_normal_frames_of(stage, u);
  std::vector<double> along(means.size()), sine(means.size()), cosine(means.size());
  sines_and_cosines({u.data() + 3 * stage.vertices(), means.size()}, sine, cosine);
  each_in_parallel(means.size(), [&](std::size_t e) {
    const Vector3 n = stage.frames[e].carried(sine[e], cosine[e], means[e].tangent);
    angles[e] = n.dot(means[e].binormal);
    along[e] = n.dot(means[e].director);
  });
  angles_of(along, angles);
  return angles;
}

void raise_as_started(Stage& stage) {
  const State& state = *stage.start;
  const auto& x = state.positions;
  for (std::size_t t = 0; t < stage.raised.size(); ++t) {
    const Corners& c = state.mesh->triangles[t];
    stage.raised[t] = RaisedMetric(squared_lengths(x[c[0]], x[c[1]], x[c[2]]));
  }
}

Eigen::VectorXd step_scale(const State& state, Eigen::Index unknowns) {
  const std::size_t n = state.positions.size();
  const std::vector<Edge>& edges = state.mesh->edges;
  std::vector<double> lengths(edges.size()), sum(n, 0), count(n, 0);
  each_in_parallel(edges.size(), [&](std::size_t e) {
    lengths[e] = (state.positions[edges[e][1]] - state.positions[edges[e][0]]).norm();
  });
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const auto v : edges[e])
      sum[v] += lengths[e], count[v] += 1;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(unknowns);
  for (std::size_t v = 0; v < n; ++v)
    if (count[v] > 0)
      scale.segment<3>(static_cast<Eigen::Index>(3 * v)).setConstant(sum[v] / count[v]);
  return scale;
}

} // namespace sheet
