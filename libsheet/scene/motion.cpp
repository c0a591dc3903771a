// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/motion.h"

#include <algorithm>
#include <cmath>

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

template <class T> double largest(const Timed<T>& timed) {
  double result = 0;
  for (const auto& entry : timed.entries)
    result = std::max(result, magnitude(entry.value));
  return result;
}

const Eigen::Vector3d origin = Eigen::Vector3d::Zero();

} // namespace

double value_at(const Timed<double>& timed, double t) { return interpolate(timed, t, 0.0); }
Eigen::Vector3d value_at(const Timed<Eigen::Vector3d>& timed, double t) { return interpolate(timed, t, origin); }

double integral(const Timed<double>& timed, double t0, double t1) { return integrate(timed, t0, t1, 0.0); }
Eigen::Vector3d integral(const Timed<Eigen::Vector3d>& timed, double t0, double t1) {
  return integrate(timed, t0, t1, origin);
}

Eigen::Isometry3d motion_between(const Motion& motion, double t0, double t1) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  std::visit(Overloaded{[](const Fixed&) {},
                        [&](const Translating& moving) { result.translation() = integral(moving.velocity, t0, t1); },
                        [&](const Rotating& turning) {
                          const double angle = integral(turning.rate, t0, t1);
                          const Eigen::AngleAxisd turn(angle, turning.axis.stableNormalized());
                          result.linear() = turn.toRotationMatrix();
                          result.translation() = turning.center - result.linear() * turning.center;
                        }},
             motion);
  return result;
}

Eigen::Vector3d velocity_at(const Motion& motion, double t, const Eigen::Vector3d& x) {
  return std::visit(
      Overloaded{[](const Fixed&) -> Eigen::Vector3d { return origin; },
                 [&](const Translating& moving) -> Eigen::Vector3d { return value_at(moving.velocity, t); },
                 [&](const Rotating& turning) -> Eigen::Vector3d {
                   return value_at(turning.rate, t) * turning.axis.stableNormalized().cross(x - turning.center);
                 }},
      motion);
}

double largest_rate(const Motion& motion) {
  return std::visit(Overloaded{[](const Fixed&) { return 0.0; },
                               [](const Translating& moving) { return largest(moving.velocity); },
                               [](const Rotating& turning) { return largest(turning.rate); }},
                    motion);
}

} // namespace sheet::scene
