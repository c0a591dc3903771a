// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/camera_rays.h"

#include <cmath>

namespace sheet::render {

CameraRays::CameraRays(const World& world, const Camera& camera)
    : camera_(camera), eye_(world.to_world(camera.eye())),
      radius_(static_cast<float>(camera.lens().radius / world.unit())),
      focus_(static_cast<float>(camera.lens().focus / world.unit())) {}

Ray CameraRays::through(double x, double y, Point2 lens) const {
  const Ray straight = middle(x, y);
  if (!has_lens())
    return straight;
  const Vec sharp = straight.origin + focus_ / straight.direction.dot(camera_.axis()) * straight.direction;
  const float from_middle = radius_ * std::sqrt(lens.x), angle = 2 * float_pi * lens.y;
  const Vec start = eye_ + from_middle * (std::cos(angle) * camera_.right() + std::sin(angle) * camera_.above());
  return {start, (sharp - start).normalized()};
}

std::optional<Eigen::Vector2d> CameraRays::place(const Vec& position) const {
  return camera_.place((position - eye_).cast<double>());
}

float CameraRays::blur(const Vec& position) const {
  const float depth = (position - eye_).dot(camera_.axis());
  if (!has_lens() || !(depth > 0))
    return 0;
  return radius_ * std::abs(1 / depth - 1 / focus_) / static_cast<float>(camera_.pixel_angle(1));
}

} // namespace sheet::render
