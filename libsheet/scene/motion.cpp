// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "libsheet/base/overloaded.h"

namespace sheet::scene {
namespace {

double magnitude(double value) { return std::abs(value); }
double magnitude(const Eigen::Vector3d& value) { return value.norm(); }

template <class T> T interpolate(const Timed<T>& timed, double t, T zero) {
  const auto& entries = timed.entries;
  if (entries.empty())
    return zero;
  const auto after = std::upper_bound(entries.begin(), entries.end(), t,
                                      [](double time, const auto& entry) { return time < entry.time; });
  if (after == entries.begin())
    return entries.front().value;
  if (after == entries.end())
    return entries.back().value;
  const auto before = after - 1;
  const double weight = (t - before->time) / (after->time - before->time);
  return (1 - weight) * before->value + weight * after->value;
}

// Trapezes between the bends of the line are exact.
template <class T> T integrate(const Timed<T>& timed, double t0, double t1, T zero) {
  if (t1 < t0)
    return -integrate(timed, t1, t0, zero);
  T sum = zero;
  double left = t0;
  T left_value = interpolate(timed, t0, zero);
  const auto advance = [&](double right) {
    const T right_value = interpolate(timed, right, zero);
    sum += (right - left) * (0.5 * left_value + 0.5 * right_value);
    left = right;
    left_value = right_value;
  };
  for (const auto& entry : timed.entries)
    if (entry.time > t0 && entry.time < t1)
      advance(entry.time);
  advance(t1);
  return sum;
}

// The largest slope between two times.
template <class T> double steepest(const Timed<T>& timed, double from, double to) {
  double result = 0;
  for (std::size_t i = 1; i < timed.entries.size(); ++i) {
    const auto &a = timed.entries[i - 1], &b = timed.entries[i];
    if (a.time < to && b.time > from)
      result = std::max(result, magnitude(T(b.value - a.value)) / (b.time - a.time));
  }
  return result;
}

// The largest magnitude between two times: at one of them or at a bend.
template <class T> double largest(const Timed<T>& timed, double from, double to) {
  double result = std::max(magnitude(value_at(timed, from)), magnitude(value_at(timed, to)));
  for (const auto& entry : timed.entries)
    if (entry.time > from && entry.time < to)
      result = std::max(result, magnitude(entry.value));
  return result;
}

template <class T> std::vector<double> times_of(const Timed<T>& timed) {
  std::vector<double> times;
  for (const auto& entry : timed.entries)
    times.push_back(entry.time);
  return times;
}

const Eigen::Vector3d origin = Eigen::Vector3d::Zero();

Eigen::Vector3d center_at(const Rotating& turning, double t) {
  return turning.velocity.entries.empty() ? turning.center : turning.center + integral(turning.velocity, 0, t);
}

} // namespace

double value_at(const Timed<double>& timed, double t) { return interpolate(timed, t, 0.0); }
Eigen::Vector3d value_at(const Timed<Eigen::Vector3d>& timed, double t) { return interpolate(timed, t, origin); }

double integral(const Timed<double>& timed, double t0, double t1) { return integrate(timed, t0, t1, 0.0); }
Eigen::Vector3d integral(const Timed<Eigen::Vector3d>& timed, double t0, double t1) {
  return integrate(timed, t0, t1, origin);
}

Eigen::Isometry3d motion_between(const Motion& motion, double t0, double t1) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  std::visit(
      Overloaded{[](const Fixed&) {},
                 [&](const Translating& moving) { result.translation() = integral(moving.velocity, t0, t1); },
                 [&](const Rotating& turning) {
                   const double angle = integral(turning.rate, t0, t1);
                   const Eigen::AngleAxisd turn(angle, turning.axis.stableNormalized());
                   result.linear() = turn.toRotationMatrix();
                   result.translation() = center_at(turning, t1) - result.linear() * center_at(turning, t0);
                 },
                 [&](const Keyframed& keyed) { result = keyed.frames->pose(t1) * keyed.frames->pose(t0).inverse(); }},
      motion);
  return result;
}

Eigen::Vector3d outward_pull(const Motion& motion, double t, const Eigen::Vector3d& x) {
  const auto* turning = std::get_if<Rotating>(&motion);
  if (turning == nullptr || turning->rate.entries.empty())
    return Eigen::Vector3d::Zero();
  const Eigen::Vector3d axis = turning->axis.normalized();
  const Eigen::Vector3d out = x - turning->center - integral(turning->velocity, 0, t);
  const double rate = value_at(turning->rate, t);
  return rate * rate * (out - out.dot(axis) * axis);
}

Eigen::Vector3d velocity_at(const Motion& motion, double t, const Eigen::Vector3d& x) {
  return std::visit(
      Overloaded{[](const Fixed&) -> Eigen::Vector3d { return origin; },
                 [&](const Translating& moving) -> Eigen::Vector3d { return value_at(moving.velocity, t); },
                 [&](const Rotating& turning) -> Eigen::Vector3d {
                   const Eigen::Vector3d about = turning.axis.stableNormalized().cross(x - center_at(turning, t));
                   return value_at(turning.velocity, t) + value_at(turning.rate, t) * about;
                 },
                 [&](const Keyframed& keyed) -> Eigen::Vector3d {
                   const auto [velocity, turning] = keyed.frames->rates(t);
                   return velocity + turning.cross(x - keyed.frames->pose(t).translation());
                 }},
      motion);
}

MotionBounds bounds(const Motion& motion, double from, double to) {
  return std::visit(
      Overloaded{[](const Fixed&) { return MotionBounds{}; },
                 [&](const Translating& m) {
                   return MotionBounds{origin, largest(m.velocity, from, to), steepest(m.velocity, from, to), 0, 0};
                 },
                 [&](const Rotating& m) {
                   return MotionBounds{center_at(m, from), largest(m.velocity, from, to),
                                       steepest(m.velocity, from, to), largest(m.rate, from, to),
                                       steepest(m.rate, from, to)};
                 },
                 [&](const Keyframed& m) {
                   const auto [speed, acceleration, turning, change] = m.frames->bounds(from, to);
                   return MotionBounds{m.frames->pose(from).translation(), speed, acceleration, turning, change};
                 }},
      motion);
}

bool stays_in_place(const Motion& motion) {
  const auto* turning = std::get_if<Rotating>(&motion);
  return std::holds_alternative<Fixed>(motion) || (turning != nullptr && turning->velocity.entries.empty());
}

bool turns(const Motion& motion) {
  const auto* keyed = std::get_if<Keyframed>(&motion);
  return std::holds_alternative<Rotating>(motion) || (keyed != nullptr && !keyed->frames->rotations().empty());
}

std::vector<double> events(const Motion& motion) {
  return std::visit(Overloaded{[](const Fixed&) { return std::vector<double>(); },
                               [](const Translating& m) { return times_of(m.velocity); },
                               [](const Rotating& m) {
                                 std::vector<double> times = times_of(m.rate);
                                 std::ranges::copy(times_of(m.velocity), std::back_inserter(times));
                                 std::ranges::sort(times);
                                 times.erase(std::unique(times.begin(), times.end()), times.end());
                                 return times;
                               },
                               [](const Keyframed& m) {
                                 const auto& times = m.frames->times();
                                 return m.frames->interpolation() == Interpolation::smooth
                                            ? std::vector{times.front(), times.back()}
                                            : times;
                               }},
                    motion);
}

} // namespace sheet::scene
