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

Camera frame_box(const Box& box, const CameraOptions& options, const Vector3& up, double aspect, double margin) {
  const Vector3 target = options.target.value_or(box.center());
  if (options.eye)
    return {*options.eye, target, up, options.field_of_view, aspect};
  const Vector3 toward = direction_to_camera(options, up);
  const double tangent_y = std::tan(options.field_of_view * degree / 2) * (1 - margin), tangent_x = tangent_y * aspect;
  const Vector3 right = right_of(-toward, up), above = right.cross(-toward);
  // A corner p is in the picture if |p.right| <= (distance - p.toward) tangent_x, and likewise upwards.
  double distance = 1e-9 * box.diagonal();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 p = Vector3((corner & 1) != 0 ? box.high.x() : box.low.x(), (corner & 2) != 0 ? box.high.y() : box.low.y(),
                              (corner & 4) != 0 ? box.high.z() : box.low.z()) -
                      target;
    distance = std::max({distance, std::abs(p.dot(right)) / tangent_x + p.dot(toward),
                         std::abs(p.dot(above)) / tangent_y + p.dot(toward)});
  }
  return {target + distance * toward, target, up, options.field_of_view, aspect};
}

} // namespace sheet::render
