// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/holds.h"

#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace sheet {

namespace {

// The angle that a director needs, beyond the smallest rotation of its edge, to turn as a rigid motion says.
double angle_after(const RigidMotion& motion, const EdgeFrame& frame) {
  const Vector3 t = motion.rotation * frame.tangent, wanted = motion.rotation * frame.director;
  const Vector3 brought = frame.carried(t);
  return std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
}

// Where a motion takes a vertex by the end of the stage.
Vector3 place_of(std::uint32_t v, const Stage& stage, const RigidMotion& motion) {
  const State& start = *stage.start;
  if (start.overshoot.empty())
    return motion(start.positions[v]);
  return motion(start.positions[v] - start.overshoot[v]) + stage.left_over * start.overshoot[v];
}

} // namespace

std::vector<char> held_unknowns(const std::vector<Hold>& holds, const Stage& stage) {
  if (holds.empty())
    return {};
  std::vector<char> held(static_cast<std::size_t>(stage.begin.size()), 0);
  for (const Hold& hold : holds) {
    for (const auto v : hold.vertices)
      for (std::size_t a = 0; a < 3; ++a)
        if (has_axis(hold.axes, a))
          held[3 * v + a] = 1;
    if (!stage.frames.empty())
      for (const auto e : hold.clamped_edges)
        held[3 * stage.vertices() + e] = 1;
  }
  return held;
}

void set_clamped(const std::vector<Hold>& holds, Stage& stage) {
  stage.clamped.clear();
  if (stage.frames.empty() || std::ranges::all_of(holds, [](const Hold& hold) { return hold.clamped_edges.empty(); }))
    return;
  stage.clamped.assign(stage.frames.size(), 0);
  for (const Hold& hold : holds)
    for (const std::uint32_t e : hold.clamped_edges)
      stage.clamped[e] = 1;
}

void place_held(const std::vector<Hold>& holds, const Stage& stage, double to, Unknowns& u) {
  const double from = stage.start->time;
  for (const Hold& hold : holds) {
    const RigidMotion motion = hold.moved(from, to);
    for (const auto v : hold.vertices) {
      const Vector3 x = place_of(v, stage, motion);
      for (int a = 0; a < 3; ++a)
        if (has_axis(hold.axes, a))
          u[3 * v + a] = x[a];
    }
    if (stage.frames.empty())
      continue;
    for (const auto e : hold.clamped_edges)
      u[static_cast<Eigen::Index>(3 * stage.vertices() + e)] = angle_after(motion, stage.frames[e]);
  }
}

bool move_with_held(const std::vector<Hold>& holds, const Stage& stage, double to, Unknowns& u) {
  const std::size_t count = fully_held(holds);
  if (count < 3)
    return false;
  const auto& start = stage.start->positions;
  Vector3 from = Vector3::Zero(), into = Vector3::Zero();
  Matrix3 moment = Matrix3::Zero();
  for (const int pass : {0, 1})
    for (const Hold& hold : holds) {
      if (hold.axes != all_axes)
        continue;
      const RigidMotion motion = hold.moved(stage.start->time, to);
      for (const auto v : hold.vertices)
        if (pass == 0) {
          from += start[v] / static_cast<double>(count);
          into += place_of(v, stage, motion) / static_cast<double>(count);
        } else {
          moment += (place_of(v, stage, motion) - into) * (start[v] - from).transpose();
        }
    }
  const Eigen::JacobiSVD<Matrix3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 flip = Matrix3::Identity();
  flip(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  RigidMotion fit;
  fit.rotation = svd.matrixU() * flip * svd.matrixV().transpose();
  fit.shift = into - fit.rotation * from;
  for (std::size_t v = 0; v < start.size(); ++v)
    u.segment<3>(static_cast<Eigen::Index>(3 * v)) = fit(start[v]);
  for (std::size_t e = 0; e < stage.frames.size(); ++e)
    u[static_cast<Eigen::Index>(3 * start.size() + e)] = angle_after(fit, stage.frames[e]);
  return true;
}

std::size_t fully_held(const std::vector<Hold>& holds) {
  std::size_t count = 0;
  for (const Hold& hold : holds)
    if (hold.axes == all_axes)
      count += hold.vertices.size();
  return count;
}

void set_held_velocities(const std::vector<Hold>& holds, double t, State& state) {
  for (const Hold& hold : holds)
    for (const auto v : hold.vertices) {
      const Vector3 velocity = hold.velocity_at(t, state.positions[v]);
      for (int a = 0; a < 3; ++a)
        if (has_axis(hold.axes, a))
          state.velocities[v][a] = velocity[a];
    }
}

} // namespace sheet
