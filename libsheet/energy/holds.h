// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices and edges whose motion is prescribed: pinned (positions), clamped (positions and the angle of edges), or
// held along some axes only. They stay in the list of unknowns; the assembly turns their rows into those of the unit
// matrix.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/energy/stage.h"
#include "libsheet/geometry/axes.h"

namespace sheet {

struct RigidMotion {
  Matrix3 rotation = Matrix3::Identity();
  Vector3 shift = Vector3::Zero();
  [[nodiscard]] Vector3 operator()(const Vector3& x) const { return rotation * x + shift; }
};

struct Hold {
  std::vector<std::uint32_t> vertices;
  Axes axes = all_axes;
  std::vector<std::uint32_t> clamped_edges; // their directors turn with the motion; ignored without angle unknowns
  // Where what is at x at the time `from` [s] is at the time `to`, and the velocity at time t of what is at x [m/s].
  // Both or neither: at rest.
  std::function<RigidMotion(double from, double to)> motion;
  std::function<Vector3(double t, const Vector3& x)> velocity;
  bool of_wall = false; // by a wall along which liquid flows, which is free to rise and sink on it between steps

  [[nodiscard]] RigidMotion moved(double from, double to) const { return motion ? motion(from, to) : RigidMotion{}; }
  [[nodiscard]] Vector3 velocity_at(double t, const Vector3& x) const {
    return velocity ? velocity(t, x) : Vector3(Vector3::Zero());
  }
};

// One flag for each unknown.
[[nodiscard]] std::vector<char> held_unknowns(const std::vector<Hold>& holds, const Stage& stage);

// Tells the stage whose directors are held.
void set_clamped(const std::vector<Hold>& holds, Stage& stage);

// Puts held unknowns where they are at the time `to`.
void place_held(const std::vector<Hold>& holds, const Stage& stage, double to, Unknowns& u);

// The unknowns of the whole sheet moved rigidly with what is held, the best fit [Kabsch 1976]; a starting point that
// costs nothing if all holds move alike. False if fewer than three vertices are held.
[[nodiscard]] bool move_with_held(const std::vector<Hold>& holds, const Stage& stage, double to, Unknowns& u);

// Number of vertices held along all axes.
[[nodiscard]] std::size_t fully_held(const std::vector<Hold>& holds);

// Sets the velocities of held vertices at the time t [s].
void set_held_velocities(const std::vector<Hold>& holds, double t, State& state);

} // namespace sheet
