// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid motion through given poses at given times.
#pragma once
#include <vector>

#include <Eigen/Geometry>

namespace sheet::scene {

// How the pose gets from a keyframe to the next one: on a smooth path that stays between the two, straight with
// constant velocity, or not until the time of the next one, when it jumps.
enum class Interpolation { smooth, linear, step };

// Smooth: between two keyframes the place and the vector of the rotation since the first of them are cubics of time.
// Places: the velocities at keyframes are those of the C2 spline whose third derivative is continuous at the second
// keyframe and at the last but one, too ("not a knot", de Boor 1978), so of fourth order up to the ends, and exact for
// parabolas. Rotations: the angular velocity at a keyframe is that of the polynomial of degree 4 at most, through the
// rotation vectors to the keyframes around it, so of fourth order, and exact for a steady turn. Where the cubics would
// leave the range between two keyframes, in a coordinate or in the turn on the way from one to the other, these
// velocities are made smaller until they do not [Fritsch and Carlson 1980; de Boor and Swartz 1977]: 0 where a
// coordinate or a turn comes to rest or turns back. There the order is the second, and the acceleration jumps.
// Linear: the place moves straight, the rotation turns steadily. Before the first keyframe and from the last one on the
// pose is theirs, at rest.
class Keyframes {
public:
  // times [s]: two at least, strictly increasing, finite. places [m]: of a point that moves along; rotations: unit
  // quaternions within rounding, neighbours less than half a turn apart; each as many as times, or none, then all are
  // `center`, or none turns. The signs of quaternions are made continuous.
  Keyframes(std::vector<double> times, std::vector<Eigen::Vector3d> places, std::vector<Eigen::Quaterniond> rotations,
            const Eigen::Vector3d& center = Eigen::Vector3d::Zero(),
            Interpolation interpolation = Interpolation::smooth);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& places() const { return places_; }
  [[nodiscard]] const std::vector<Eigen::Quaterniond>& rotations() const { return rotations_; }
  [[nodiscard]] const Eigen::Vector3d& center() const { return center_; }
  [[nodiscard]] Interpolation interpolation() const { return interpolation_; }

  // From the moving point's frame, whose axes are the world's where the rotation is 1, to the world.
  [[nodiscard]] Eigen::Isometry3d pose(double t) const;

  // Derivatives of the pose at time t, exact, the later ones where they jump: of the place [m/s], and the angular
  // velocity in the world [rad/s]. A jump of the pose has none.
  struct Rates {
    Eigen::Vector3d velocity, turning;
  };
  [[nodiscard]] Rates rates(double t) const;

  // Bounds between two times: of the place's derivatives [m/s, m/s²] and of the turning's [rad/s, rad/s²], jumps apart.
  struct Bounds {
    double speed = 0, acceleration = 0, turning = 0, turning_change = 0;
  };
  [[nodiscard]] Bounds bounds(double from, double to) const;

  bool operator==(const Keyframes& other) const;

private:
  // Cubic over the time h: from 0 with the derivative `first` by `way` to the derivative `last`.
  struct Piece {
    double h;
    Eigen::Vector3d way, first, last;
    [[nodiscard]] Eigen::Vector3d value(double s) const; // s: part of the time
    [[nodiscard]] Eigen::Vector3d derivative(double s) const;
    [[nodiscard]] double largest_derivative() const; // a bound
    [[nodiscard]] double largest_second() const;
  };
  struct Moment {
    std::size_t piece;
    double s;
    bool rests;
  };
  [[nodiscard]] Moment at(double t) const;
  [[nodiscard]] Piece place_piece(std::size_t i) const;
  [[nodiscard]] Piece turn_piece(std::size_t i) const;
  void find_velocities();
  void find_turnings();
  void limit_velocities();
  void limit_turnings();

  std::vector<double> times_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<Eigen::Quaterniond> rotations_;
  Eigen::Vector3d center_;
  Interpolation interpolation_;
  std::vector<Eigen::Vector3d> velocities_; // of the place at keyframes, if smooth
  std::vector<Eigen::Vector3d> turnings_;   // angular velocity at keyframes, in the moving frame, if smooth
};

// The rotation vector of a unit quaternion, of half a turn at most [rad].
[[nodiscard]] Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation);

} // namespace sheet::scene
