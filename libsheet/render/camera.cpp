// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sheet::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Two level axes beside `up`: ahead is z and aside x if up is y.
void level_axes(const Vector3& up, Vector3& ahead, Vector3& aside) {
  const Vector3 z = std::abs(up.z()) < 0.9 ? Vector3::UnitZ() : Vector3(-Vector3::UnitY());
  ahead = (z - z.dot(up) * up).normalized();
  aside = up.cross(ahead);
}

// What is on the right of somebody who looks ahead; straight up or down, the level axis aside.
Vector3 right_of(const Vector3& ahead, const Vector3& up) {
  const Vector3 right = ahead.cross(up);
  if (right.norm() > 1e-9)
    return right.normalized();
  Vector3 level, aside;
  level_axes(up, level, aside);
  return aside;
}

} // namespace

Camera::Camera(const Vector3& eye, const Vector3& target, const Vector3& up, double field_of_view, double aspect)
    : eye_(eye), ahead_((target - eye).normalized()), right_(right_of(ahead_, up)), up_(right_.cross(ahead_)) {
  tangent_y_ = std::tan(field_of_view * degree / 2);
  tangent_x_ = tangent_y_ * aspect;
}

Vec Camera::direction(double x, double y) const {
  return (ahead_ + (2 * x - 1) * tangent_x_ * right_ + (1 - 2 * y) * tangent_y_ * up_).normalized().cast<float>();
}

bool Camera::sees(const Vector3& x) const {
  const Vector3 d = x - eye_;
  const double depth = d.dot(ahead_);
  return depth > 0 && std::abs(d.dot(right_)) <= depth * tangent_x_ && std::abs(d.dot(up_)) <= depth * tangent_y_;
}

Vector3 direction_to_camera(const CameraOptions& options, const Vector3& up) {
  Vector3 ahead, aside;
  level_axes(up, ahead, aside);
  const double azimuth = options.azimuth * degree, elevation = options.elevation * degree;
  return std::cos(elevation) * (std::cos(azimuth) * ahead + std::sin(azimuth) * aside) + std::sin(elevation) * up;
}

ViewFit::ViewFit(const CameraOptions& options, const Vector3& up, double aspect, double margin_x, double margin_y)
    : options_(options), up_(up), toward_(direction_to_camera(options, up)), right_(right_of(-toward_, up)),
      above_(right_.cross(-toward_)), aspect_(aspect) {
  const double tangent = std::tan(options.field_of_view * degree / 2);
  tangent_x_ = tangent * aspect * (1 - 2 * margin_x);
  tangent_y_ = tangent * (1 - 2 * margin_y);
  most_.fill(-std::numeric_limits<double>::infinity());
}

void ViewFit::add(const Vector3& center, double radius) {
  const double near_x = tangent_x_ * center.dot(toward_), near_y = tangent_y_ * center.dot(toward_);
  const double x = center.dot(right_), y = center.dot(above_);
  const double reach_x = radius * std::hypot(1, tangent_x_), reach_y = radius * std::hypot(1, tangent_y_);
  most_ = {std::max(most_[0], near_x + x + reach_x), std::max(most_[1], near_x - x + reach_x),
           std::max(most_[2], near_y + y + reach_y), std::max(most_[3], near_y - y + reach_y)};
}

void ViewFit::add(const ViewFit& other) {
  for (std::size_t i = 0; i < 4; ++i)
    most_[i] = std::max(most_[i], other.most_[i]);
}

Camera ViewFit::camera(const Vector3& middle, double growth) const {
  const Vector3 target = options_.target.value_or(middle);
  if (options_.eye)
    return {*options_.eye, target, up_, options_.field_of_view, aspect_};
  const std::array<Vector3, 4> slope = {tangent_x_ * toward_ + right_, tangent_x_ * toward_ - right_,
                                        tangent_y_ * toward_ + above_, tangent_y_ * toward_ - above_};
  std::array<double, 4> most = most_;
  for (std::size_t i = 0; i < 4; ++i)
    most[i] += growth * (most[i] - slope[i].dot(middle));
  Vector3 side; // where the eye is in the plane across its line of sight
  if (options_.target)
    side = target - target.dot(toward_) * toward_;
  else
    side = 0.5 * (most[0] - most[1]) * right_ + 0.5 * (most[2] - most[3]) * above_;
  double distance = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i)
    distance = std::max(distance, (most[i] - slope[i].dot(side)) / (i < 2 ? tangent_x_ : tangent_y_));
  const Vector3 eye = side + distance * toward_;
  return {eye, eye - toward_, up_, options_.field_of_view, aspect_};
}

} // namespace sheet::render
