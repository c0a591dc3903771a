// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/stage_setup.h"

#include <algorithm>
#include <cmath>

#include "libsheet/geometry/area.h"

namespace sheet {

namespace {

// Principal stretches (squared) of an extrapolated metric, over the start's.
constexpr double kLeast = 0.25, kGreatest = 4;

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
  if (p.least < kLeast - 1)
    part = std::min(part, (kLeast - 1) / p.least);
  if (p.greatest > kGreatest - 1)
    part = std::min(part, (kGreatest - 1) / p.greatest);
  return std::isfinite(part) ? RaisedMetric(start + part * change) : a;
}

constexpr double kCancelled = 1e-8; // length of a sum of two unit vectors

// position: of a vertex, by its index.
template <class Position> std::vector<Vector3> face_normals(const Connectivity& mesh, Position position) {
  std::vector<Vector3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    normals[t] = TriangleArea(position(v[0]), position(v[1]), position(v[2])).normal;
  }
  return normals;
}

// The sum of the normals at an edge along t, without its part along t.
Vector3 sum_at_edge(const Connectivity& mesh, std::size_t edge, const std::vector<Vector3>& normals, const Vector3& t) {
  Vector3 n = Vector3::Zero();
  for (const auto side : mesh.edge_triangles[edge])
    if (side != kNone)
      n += normals[side];
  return n - n.dot(t) * t;
}

// The mean of the face normals; where they cancel (a sheet folded flat) the direction away from the faces.
std::vector<EdgeFrame> edge_frames(const State& state) {
  const Connectivity& mesh = *state.mesh;
  const auto& x = state.positions;
  const std::vector<Vector3> normals = face_normals(mesh, [&](std::uint32_t v) { return x[v]; });
  std::vector<EdgeFrame> frames(mesh.edges.size());
  for (std::size_t e = 0; e < frames.size(); ++e) {
    const Vector3 t = (x[mesh.edges[e][1]] - x[mesh.edges[e][0]]).normalized();
    Vector3 n = sum_at_edge(mesh, e, normals, t);
    if (n.norm() < kCancelled) {
      const auto side = mesh.edge_triangles[e][0] != kNone ? mesh.edge_triangles[e][0] : mesh.edge_triangles[e][1];
      n = normals[side].cross(t);
    }
    n -= n.dot(t) * t;
    n.normalize();
    frames[e] = {t, n, t.cross(n)};
  }
  return frames;
}

} // namespace

Stage first_stage(const State& state, double duration, double end_time, bool angles) {
  Stage stage;
  const Connectivity& mesh = *state.mesh;
  const std::size_t n = state.positions.size();
  stage.start = &state;
  stage.duration = duration;
  stage.end_time = end_time;
  stage.begin = Unknowns::Zero(static_cast<Eigen::Index>(3 * n + (angles ? mesh.edges.size() : 0)));
  stage.predicted.resize(n);
  for (std::size_t v = 0; v < n; ++v) {
    stage.begin.segment<3>(static_cast<Eigen::Index>(3 * v)) = state.positions[v];
    stage.predicted[v] = state.positions[v] + duration * state.velocities[v];
  }
  stage.inertial = stage.predicted;
  if (angles)
    stage.frames = edge_frames(state);
  stage.raised.resize(mesh.triangles.size());
  const auto& x = state.positions;
  const auto& v = state.velocities;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    Vector3 change;
    for (int k = 0; k < 3; ++k) {
      const auto a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      change[k] = 2 * duration * (x[b] - x[a]).dot(v[b] - v[a]);
    }
    stage.raised[t] = predicted_metric(squared_lengths(x[c[0]], x[c[1]], x[c[2]]), change);
  }
  return stage;
}

bool second_stage(Stage& stage, const Unknowns& first, double gamma, double dt) {
  const State& state = *stage.start;
  stage.previous = &first;
  stage.ratio = (1 - gamma) / gamma;
  stage.end_time = state.time + dt;
  for (std::size_t v = 0; v < state.positions.size(); ++v) {
    const Vector3& x0 = state.positions[v];
    const Vector3 moved = first.segment<3>(static_cast<Eigen::Index>(3 * v)) - x0;
    const Vector3 acceleration = (moved / stage.duration - state.velocities[v]) / stage.duration;
    const Vector3 velocity = state.velocities[v] + (1 - gamma) * dt * acceleration;
    stage.inertial[v] = x0 + stage.ratio * moved + stage.duration * velocity;
    stage.predicted[v] = x0 + moved / gamma;
  }
  bool possible = true;
  for (std::size_t t = 0; t < state.mesh->triangles.size(); ++t) {
    const Triangle& c = state.mesh->triangles[t];
    const auto& x = state.positions;
    const Vector3 start = squared_lengths(x[c[0]], x[c[1]], x[c[2]]);
    const Vector3 end =
        squared_lengths(stage.position(first, c[0]), stage.position(first, c[1]), stage.position(first, c[2]));
    stage.raised[t] = predicted_metric(start, (end - start) / gamma);
    possible = possible && Principal(RaisedMetric(start), stage.ratio * (end - start)).least >= kLeast - 1;
  }
  return possible;
}

void turn_to_normals(const Stage& stage, Unknowns& u) {
  if (stage.frames.empty())
    return;
  const Connectivity& mesh = *stage.start->mesh;
  const std::vector<Vector3> normals = face_normals(mesh, [&](std::uint32_t v) { return stage.position(u, v); });
  for (std::size_t e = 0; e < stage.frames.size(); ++e) {
    const Vector3 t = (stage.position(u, mesh.edges[e][1]) - stage.position(u, mesh.edges[e][0])).normalized();
    const Vector3 wanted = sum_at_edge(mesh, e, normals, t), brought = stage.frames[e].carried(0, t);
    if (wanted.norm() >= kCancelled)
      u[static_cast<Eigen::Index>(3 * stage.vertices() + e)] =
          std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
  }
}

void raise_as_started(Stage& stage) {
  const State& state = *stage.start;
  const auto& x = state.positions;
  for (std::size_t t = 0; t < stage.raised.size(); ++t) {
    const Triangle& c = state.mesh->triangles[t];
    stage.raised[t] = RaisedMetric(squared_lengths(x[c[0]], x[c[1]], x[c[2]]));
  }
}

Eigen::VectorXd step_scale(const State& state, Eigen::Index unknowns) {
  const std::size_t n = state.positions.size();
  std::vector<double> sum(n, 0), count(n, 0);
  for (const Edge& e : state.mesh->edges) {
    const double length = (state.positions[e[1]] - state.positions[e[0]]).norm();
    for (const auto v : e)
      sum[v] += length, count[v] += 1;
  }
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(unknowns);
  for (std::size_t v = 0; v < n; ++v)
    if (count[v] > 0)
      scale.segment<3>(static_cast<Eigen::Index>(3 * v)).setConstant(sum[v] / count[v]);
  return scale;
}

} // namespace sheet
