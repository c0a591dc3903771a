// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed rigid motions of holds and solids.
#pragma once
#include <memory>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "libsheet/scene/keyframes.h"

namespace sheet::scene {

// A quantity that is piecewise linear in time; constant before the first and after the last entry, zero without
// entries.
template <class T> struct Timed {
  struct Entry {
    double time; // [s]
    T value;
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries; // times strictly increasing
  bool operator==(const Timed&) const = default;
};

struct Fixed {
  bool operator==(const Fixed&) const = default;
};

struct Translating {
  Timed<Eigen::Vector3d> velocity; // [m/s]
  bool operator==(const Translating&) const = default;
};

struct Rotating {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  // any length but zero; right-handed
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); // a point of the axis at time 0 [m]
  Timed<double> rate;                               // [rad/s]
  Timed<Eigen::Vector3d> velocity = {};             // of the axis, as of a wheel that rolls [m/s]
  bool operator==(const Rotating&) const = default;
};

// As the frame moves that stands at the keyframes: only how it moves counts, not where it is.
struct Keyframed {
  std::shared_ptr<const Keyframes> frames; // never null
  bool operator==(const Keyframed& other) const { return *frames == *other.frames; }
};

using Motion = std::variant<Fixed, Translating, Rotating, Keyframed>;

// The value at time t.
[[nodiscard]] double value_at(const Timed<double>& timed, double t);
[[nodiscard]] Eigen::Vector3d value_at(const Timed<Eigen::Vector3d>& timed, double t);

// The exact integral from t0 to t1 (negative if t1 < t0).
[[nodiscard]] double integral(const Timed<double>& timed, double t0, double t1);
[[nodiscard]] Eigen::Vector3d integral(const Timed<Eigen::Vector3d>& timed, double t0, double t1);

// The rigid motion that takes every point from its place at t0 to its place at t1.
[[nodiscard]] Eigen::Isometry3d motion_between(const Motion& motion, double t0, double t1);

// What its turning adds to gravity for what turns with it at x, omega² r away from the axis [m/s²]; nothing of rows
// that turn.
[[nodiscard]] Eigen::Vector3d outward_pull(const Motion& motion, double t, const Eigen::Vector3d& x);

// Velocity at time t of the material point that is at x [m/s].
[[nodiscard]] Eigen::Vector3d velocity_at(const Motion& motion, double t, const Eigen::Vector3d& x);

// What a motion does at most between two times. All points within `reach` of `center` [m] at the time `from` have at
// most the speed speed + turning * reach.
struct MotionBounds {
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); // about which it turns, at the time `from` [m]
  double speed = 0, acceleration = 0;               // of the center [m/s, m/s²]
  double turning = 0, turning_change = 0;           // [rad/s, rad/s²]
};
[[nodiscard]] MotionBounds bounds(const Motion& motion, double from, double to);

// Whether the motion turns things, at any time.
[[nodiscard]] bool turns(const Motion& motion);
// Whether it leaves things where they are: at rest, or turning about an axis that is.
[[nodiscard]] bool stays_in_place(const Motion& motion);

// The times at which the velocity is not smooth, or the place jumps [s], increasing: sheet-step ends steps there.
[[nodiscard]] std::vector<double> events(const Motion& motion);

} // namespace sheet::scene
