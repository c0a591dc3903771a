// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed rigid motions of holds and solids.
#pragma once
#include <variant>
#include <vector>

#include <Eigen/Geometry>

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
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); // a point of the axis [m]
  Timed<double> rate;                               // [rad/s]
  bool operator==(const Rotating&) const = default;
};

using Motion = std::variant<Fixed, Translating, Rotating>;

// The value at time t.
[[nodiscard]] double value_at(const Timed<double>& timed, double t);
[[nodiscard]] Eigen::Vector3d value_at(const Timed<Eigen::Vector3d>& timed, double t);

// The exact integral from t0 to t1 (negative if t1 < t0).
[[nodiscard]] double integral(const Timed<double>& timed, double t0, double t1);
[[nodiscard]] Eigen::Vector3d integral(const Timed<Eigen::Vector3d>& timed, double t0, double t1);

// The rigid motion that takes every point from its place at t0 to its place at t1.
[[nodiscard]] Eigen::Isometry3d motion_between(const Motion& motion, double t0, double t1);

// Velocity at time t of the material point that is at x [m/s].
[[nodiscard]] Eigen::Vector3d velocity_at(const Motion& motion, double t, const Eigen::Vector3d& x);

// Largest speed that the motion reaches at any time: translation [m/s], rotation [rad/s].
[[nodiscard]] double largest_rate(const Motion& motion);

} // namespace sheet::scene
