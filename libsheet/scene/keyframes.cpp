// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sheet::scene {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double small_angle = 0.1; // below it, series

Quaterniond turn_by(const Vector3d& vector) {
  const double angle = vector.norm();
  const double part = angle < small_angle
                          ? 0.5 - angle * angle / 48 * (1 - angle * angle / 80 * (1 - angle * angle / 168))
                          : std::sin(angle / 2) / angle;
  Quaterniond turn;
  turn.w() = std::cos(angle / 2);
  turn.vec() = part * vector;
  return turn;
}

// The angular velocity, in the moving frame, of the rotation by `v` whose derivative is `rate`: the right Jacobian of
// the exponential map.
Vector3d turning_of(const Vector3d& v, const Vector3d& rate) {
  const double q = v.squaredNorm(), angle = std::sqrt(q);
  const double half = std::sin(angle / 2);
  const double a = angle < small_angle ? 0.5 - q / 24 * (1 - q / 30 * (1 - q / 56)) : 2 * half * half / q;
  const double b =
      angle < small_angle ? 1. / 6 - q / 120 * (1 - q / 42 * (1 - q / 72)) : (angle - std::sin(angle)) / (q * angle);
  return rate - a * v.cross(rate) + b * v.cross(v.cross(rate));
}

// Its inverse: the rate at which `v` must change.
Vector3d rate_of(const Vector3d& v, const Vector3d& turning) {
  const double q = v.squaredNorm(), angle = std::sqrt(q);
  const double c =
      angle < small_angle ? 1. / 12 + q / 720 * (1 + q / 42 * (1 + q / 40)) : (1 - angle / 2 / std::tan(angle / 2)) / q;
  return turning + 0.5 * v.cross(turning) + c * v.cross(v.cross(turning));
}

// Solves a tridiagonal system in place of its right side [Thomas].
void solve_tridiagonal(const std::vector<double>& below, std::vector<double> diagonal, const std::vector<double>& above,
                       std::vector<Vector3d>& x) {
  const std::size_t n = x.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    x[i] -= factor * x[i - 1];
  }
  x[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    x[i] = (x[i] - above[i] * x[i + 1]) / diagonal[i];
}

// A slope at a row between whose neighbours the mean slopes are `before` and `after`, so that cubics on both sides are
// monotone: of their sign, and three times the smaller one at most [de Boor and Swartz 1977]; 0 where they differ in
// sign.
double monotone(double slope, double before, double after) {
  if (!(before > 0 && after > 0) && !(before < 0 && after < 0))
    return 0;
  const double most = 3 * (before > 0 ? std::min(before, after) : std::max(before, after));
  return std::clamp(slope, std::min(most, 0.0), std::max(most, 0.0));
}

} // namespace

Vector3d rotation_vector(const Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1 : 1, sine = rotation.vec().norm();
  const double angle = 2 * std::atan2(sine, sign * rotation.w());
  return sign * (sine > 0 ? angle / sine : 2) * rotation.vec();
}

Vector3d Keyframes::Piece::value(double s) const {
  const double r = 1 - s;
  return s * s * (3 - 2 * s) * way + h * s * r * (r * first - s * last);
}

Vector3d Keyframes::Piece::derivative(double s) const {
  return 6 * s * (1 - s) / h * way + (1 - s) * (1 - 3 * s) * first + s * (3 * s - 2) * last;
}

// By the Bézier points of the derivative, a parabola that stays within their hull.
double Keyframes::Piece::largest_derivative() const {
  return std::max({first.norm(), (3 / h * way - first - last).norm(), last.norm()});
}

// The second derivative is linear.
double Keyframes::Piece::largest_second() const {
  const Vector3d middle = 3 / h * way - first - last;
  return 2 / h * std::max((middle - first).norm(), (last - middle).norm());
}

Keyframes::Keyframes(std::vector<double> times, std::vector<Vector3d> places, std::vector<Quaterniond> rotations,
                     const Vector3d& center, Interpolation interpolation)
    : times_(std::move(times)), places_(std::move(places)), rotations_(std::move(rotations)), center_(center),
      interpolation_(interpolation) {
  for (std::size_t i = 1; i < rotations_.size(); ++i)
    if (rotations_[i].dot(rotations_[i - 1]) < 0)
      rotations_[i].coeffs() *= -1;
  if (interpolation_ != Interpolation::smooth)
    return;
  if (!places_.empty()) {
    find_velocities();
    limit_velocities();
  }
  if (!rotations_.empty()) {
    find_turnings();
    limit_turnings();
  }
}

void Keyframes::find_velocities() {
  const std::size_t n = times_.size();
  const auto h = [&](std::size_t i) { return times_[i + 1] - times_[i]; };
  const auto slope = [&](std::size_t i) -> Vector3d { return (places_[i + 1] - places_[i]) / h(i); };
  velocities_.assign(n, slope(0));
  if (n == 2)
    return;
  if (n == 3) { // a parabola
    const Vector3d bend = (slope(1) - slope(0)) / (h(0) + h(1));
    velocities_ = {slope(0) - h(0) * bend, slope(0) + h(0) * bend, slope(1) + h(1) * bend};
    return;
  }
  std::vector<double> below(n, 0), diagonal(n, 0), above(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) { // the second derivative is continuous
    below[i] = h(i);
    diagonal[i] = 2 * (h(i - 1) + h(i));
    above[i] = h(i - 1);
    velocities_[i] = 3 * (h(i) * slope(i - 1) + h(i - 1) * slope(i));
  }
  const auto end = [&](double h0, double h1, const Vector3d& s0, const Vector3d& s1) -> Vector3d {
    return ((h0 + 2 * (h0 + h1)) * h1 * s0 + h0 * h0 * s1) / (h0 + h1);
  };
  diagonal[0] = h(1);
  above[0] = h(0) + h(1);
  velocities_[0] = end(h(0), h(1), slope(0), slope(1));
  diagonal[n - 1] = h(n - 3);
  below[n - 1] = h(n - 2) + h(n - 3);
  velocities_[n - 1] = end(h(n - 2), h(n - 3), slope(n - 2), slope(n - 3));
  solve_tridiagonal(below, diagonal, above, velocities_);
}

void Keyframes::find_turnings() {
  const std::size_t n = times_.size();
  turnings_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    // The nearest keyframes, five with this one, as far as the turn on the way to them stays below half a turn, within
    // which rotation vectors are unique.
    std::array<double, 4> time{};
    std::array<Vector3d, 4> vector;
    std::size_t count = 0, low = i, high = i;
    double turned_low = 0, turned_high = 0;
    const auto next_turn = [&](std::size_t j) { return rotations_[j].angularDistance(rotations_[j + 1]); };
    const auto take = [&](std::size_t j) {
      time[count] = times_[j] - times_[i];
      vector[count++] = rotation_vector(rotations_[i].conjugate() * rotations_[j]);
    };
    while (count < time.size()) {
      const bool has_low = low > 0 && (low == i || turned_low + next_turn(low - 1) < std::numbers::pi);
      const bool has_high = high + 1 < n && (high == i || turned_high + next_turn(high) < std::numbers::pi);
      if (!has_low && !has_high)
        break;
      if (has_low && (!has_high || i - low <= high - i)) {
        turned_low += next_turn(--low);
        take(low);
      } else {
        turned_high += next_turn(high++);
        take(high);
      }
    }
    turnings_[i].setZero();
    for (std::size_t k = 0; k < count; ++k) { // derivative of Lagrange's polynomial, which is 0 here, at time 0
      double weight = 1 / time[k];
      for (std::size_t m = 0; m < count; ++m)
        if (m != k)
          weight *= time[m] / (time[m] - time[k]);
      turnings_[i] += weight * vector[k];
    }
  }
}

// By coordinates.
void Keyframes::limit_velocities() {
  const std::size_t last = times_.size() - 1;
  const auto slope = [&](std::size_t i) -> Vector3d {
    return (places_[i + 1] - places_[i]) / (times_[i + 1] - times_[i]);
  };
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector3d before = slope(i == 0 ? 0 : i - 1), after = slope(i == last ? last - 1 : i);
    for (int d = 0; d < 3; ++d)
      velocities_[i][d] = monotone(velocities_[i][d], before[d], after[d]);
  }
}

// By the turn on the way to a neighbour, about one axis: along it the angular velocity at either end is the derivative
// of the rotation vector, whatever goes on across.
void Keyframes::limit_turnings() {
  const std::size_t last = times_.size() - 1;
  std::vector<Vector3d> turns(last); // steady, from row to row; the same in both rows' frames
  for (std::size_t i = 0; i < last; ++i)
    turns[i] = rotation_vector(rotations_[i].conjugate() * rotations_[i + 1]) / (times_[i + 1] - times_[i]);
  for (std::size_t i = 0; i <= last; ++i) {
    Vector3d& turning = turnings_[i];
    const std::array<const Vector3d*, 2> around{&turns[i == 0 ? 0 : i - 1], &turns[i == last ? last - 1 : i]};
    double part = around[0]->dot(*around[1]) > 0 ? 1 : 0;
    for (const Vector3d* turn : around)
      if (const double along = turning.dot(*turn); !(along > 0))
        part = 0;
      else
        part = std::min(part, 3 * turn->squaredNorm() / along);
    turning *= part;
  }
}

Keyframes::Moment Keyframes::at(double t) const {
  if (t < times_.front())
    return {0, 0, true};
  if (t >= times_.back())
    return {times_.size() - 2, 1, true};
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
  if (interpolation_ == Interpolation::step)
    return {i, 0, true};
  return {i, (t - times_[i]) / (times_[i + 1] - times_[i]), false};
}

Keyframes::Piece Keyframes::place_piece(std::size_t i) const {
  const double h = times_[i + 1] - times_[i];
  const Vector3d way = places_[i + 1] - places_[i];
  if (interpolation_ == Interpolation::smooth)
    return {h, way, velocities_[i], velocities_[i + 1]};
  return {h, way, way / h, way / h};
}

Keyframes::Piece Keyframes::turn_piece(std::size_t i) const {
  const Vector3d whole = rotation_vector(rotations_[i].conjugate() * rotations_[i + 1]);
  const double h = times_[i + 1] - times_[i];
  if (interpolation_ == Interpolation::smooth)
    return {h, whole, turnings_[i], rate_of(whole, turnings_[i + 1])};
  return {h, whole, whole / h, whole / h};
}

Eigen::Isometry3d Keyframes::pose(double t) const {
  const auto [i, s, rests] = at(t);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = center_;
  if (!places_.empty())
    result.translation() = s == 1 ? places_[i + 1] : Vector3d(places_[i] + place_piece(i).value(s));
  if (!rotations_.empty())
    result.linear() =
        (s == 1 ? rotations_[i + 1] : rotations_[i] * turn_by(turn_piece(i).value(s))).normalized().toRotationMatrix();
  return result;
}

Keyframes::Rates Keyframes::rates(double t) const {
  Rates result{Vector3d::Zero(), Vector3d::Zero()};
  const auto [i, s, rests] = at(t);
  if (rests)
    return result;
  if (!places_.empty())
    result.velocity = place_piece(i).derivative(s);
  if (!rotations_.empty()) {
    const Piece piece = turn_piece(i);
    const Vector3d turned = piece.value(s);
    result.turning = rotations_[i] * (turn_by(turned) * turning_of(turned, piece.derivative(s)));
  }
  return result;
}

Keyframes::Bounds Keyframes::bounds(double from, double to) const {
  Bounds result;
  if (to <= times_.front() || from >= times_.back() || interpolation_ == Interpolation::step)
    return result;
  for (std::size_t i = at(from).piece; i + 1 < times_.size() && times_[i] < to; ++i) {
    if (!places_.empty()) {
      const Piece piece = place_piece(i);
      result.speed = std::max(result.speed, piece.largest_derivative());
      result.acceleration = std::max(result.acceleration, piece.largest_second());
    }
    if (!rotations_.empty()) { // the Jacobian is 1 at most, its derivative half the rate
      const Piece piece = turn_piece(i);
      const double rate = piece.largest_derivative();
      result.turning = std::max(result.turning, rate);
      result.turning_change = std::max(result.turning_change, piece.largest_second() + rate * rate / 2);
    }
  }
  return result;
}

bool Keyframes::operator==(const Keyframes& other) const {
  const auto same = [](const Quaterniond& a, const Quaterniond& b) { return a.coeffs() == b.coeffs(); };
  return times_ == other.times_ && places_ == other.places_ && center_ == other.center_ &&
         interpolation_ == other.interpolation_ &&
         std::equal(rotations_.begin(), rotations_.end(), other.rotations_.begin(), other.rotations_.end(), same);
}

} // namespace sheet::scene
