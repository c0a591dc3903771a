// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/holds.h"

#include <cmath>

namespace sheet {

std::vector<char> held_unknowns(const std::vector<Hold>& holds, const Stage& stage) {
  if (holds.empty())
    return {};
  std::vector<char> held(static_cast<std::size_t>(stage.begin.size()), 0);
  for (const Hold& hold : holds) {
    for (const auto v : hold.vertices)
      for (std::size_t a = 0; a < 3; ++a)
        if (hold.axes[a])
          held[3 * v + a] = 1;
    if (!stage.frames.empty())
      for (const auto e : hold.clamped_edges)
        held[3 * stage.vertices() + e] = 1;
  }
  return held;
}

void place_held(const std::vector<Hold>& holds, const Stage& stage, double to, Unknowns& u) {
  const double from = stage.start->time;
  for (const Hold& hold : holds) {
    const RigidMotion motion = hold.moved(from, to);
    for (const auto v : hold.vertices) {
      const Vector3 x = motion(stage.start->positions[v]);
      for (int a = 0; a < 3; ++a)
        if (hold.axes[static_cast<std::size_t>(a)])
          u[3 * v + a] = x[a];
    }
    if (stage.frames.empty())
      continue;
    for (const auto e : hold.clamped_edges) {
      // The angle between the director that the smallest rotation brings and the one that the motion brings.
      const EdgeFrame& frame = stage.frames[e];
      const Vector3 t = motion.rotation * frame.tangent, wanted = motion.rotation * frame.director;
      const Vector3 brought = frame.carried(0, t);
      u[static_cast<Eigen::Index>(3 * stage.vertices() + e)] =
          std::atan2(brought.cross(wanted).dot(t), brought.dot(wanted));
    }
  }
}

std::size_t fully_held(const std::vector<Hold>& holds) {
  std::size_t count = 0;
  for (const Hold& hold : holds)
    if (hold.axes[0] && hold.axes[1] && hold.axes[2])
      count += hold.vertices.size();
  return count;
}

void set_held_velocities(const std::vector<Hold>& holds, double t, double duration, State& state) {
  const double d = 1e-3 * duration;
  for (const Hold& hold : holds) {
    const RigidMotion after = hold.moved(t, t + d), before = hold.moved(t, t - d);
    for (const auto v : hold.vertices) {
      const Vector3 x = state.positions[v];
      const Vector3 velocity = (after(x) - before(x)) / (2 * d);
      for (int a = 0; a < 3; ++a)
        if (hold.axes[static_cast<std::size_t>(a)])
          state.velocities[v][a] = velocity[a];
    }
  }
}

} // namespace sheet
