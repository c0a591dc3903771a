// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of vertices that are moved as rigid bodies, and the momentum of sets of vertices.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/step_path.h"

namespace sheet::collide {

// Vertices joined to disjoint sets.
class Sets {
public:
  explicit Sets(std::size_t vertices);
  void join(std::uint32_t a, std::uint32_t b);
  // The sets with more than one member, members ascending, sets by their first member.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> all() const;

private:
  [[nodiscard]] std::uint32_t root(std::uint32_t v) const;
  std::vector<std::uint32_t> parent_; // the root of a set is its least member
};

// x -> turn x + shift
struct RigidStep {
  Matrix3 turn = Matrix3::Identity();
  Vector3 shift = Vector3::Zero();
  [[nodiscard]] Vector3 operator()(const Vector3& x) const { return turn * x + shift; }
};

// The rigid motion with the linear and angular momentum of masses [kg] that go from `start` to `end` [m]. None where it
// turns by more than a right angle.
[[nodiscard]] std::optional<RigidStep> momentum_motion(std::span<const std::uint32_t> members,
                                                       std::span<const double> mass, std::span<const Vector3> start,
                                                       std::span<const Vector3> end);

// The rigid motion that takes each member from `start` to `end`; none if there is no such motion up to 1e-9 of the
// members' extent [Umeyama 1991].
[[nodiscard]] std::optional<RigidStep> common_motion(std::span<const std::uint32_t> members,
                                                     std::span<const Vector3> start, std::span<const Vector3> end);

// The shift of a group in which some vertices are fixed along some axes: theirs, where they agree up to 1e-9 of the
// longest way, or else none; along the other axes the mean of the ways by mass.
[[nodiscard]] std::optional<RigidStep> common_shift(std::span<const std::uint32_t> members, std::span<const Axes> fixed,
                                                    std::span<const double> mass, std::span<const Vector3> start,
                                                    std::span<const Vector3> end);

// Linear [kg m/s] and angular [kg m²/s] momentum, the latter about `center` [m].
struct Momentum {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
};
[[nodiscard]] Momentum momentum(std::span<const std::uint32_t> members, std::span<const double> mass,
                                std::span<const Vector3> positions, std::span<const Vector3> velocities,
                                const Vector3& center);

// Of a rigid body: at x, shift + turn x (x - center) [m/s].
struct RigidVelocity {
  Vector3 center = Vector3::Zero(), shift = Vector3::Zero(), turn = Vector3::Zero();
  [[nodiscard]] Vector3 operator()(const Vector3& x) const { return shift + turn.cross(x - center); }
};

// That with the given momentum about `center`, without a turn about axes of nearly no inertia.
[[nodiscard]] RigidVelocity rigid_velocity(std::span<const std::uint32_t> members, std::span<const double> mass,
                                           std::span<const Vector3> positions, const Momentum& wanted,
                                           const Vector3& center);

// Adds the rigid velocity that has the given momentum about `center`.
void add_momentum(std::span<const std::uint32_t> members, std::span<const double> mass,
                  std::span<const Vector3> positions, std::span<Vector3> velocities, Momentum wanted,
                  const Vector3& center);

} // namespace sheet::collide
