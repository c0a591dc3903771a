// SPDX-License-Identifier: GPL-3.0-or-later
// The rays of a camera in the world's unit, through the middle of its lens or through points of it: a thin lens, of
// which what lies in the plane in focus is sharp [Cook, Porter and Carpenter 1984]. Places of the picture: x, y in
// [0, 1] from the upper left.
#pragma once
#include <optional>

#include "libsheet/render/camera.h"
#include "libsheet/render/sampler.h"
#include "libsheet/render/world.h"

namespace sheet::render {

class CameraRays {
public:
  CameraRays(const World& world, const Camera& camera);
  [[nodiscard]] bool has_lens() const { return radius_ > 0; }
  [[nodiscard]] Ray middle(double x, double y) const { return {eye_, camera_.direction(x, y)}; }
  // Through a point of the lens.
  [[nodiscard]] Ray through(double x, double y, Point2 lens) const;
  // Where a point before the camera is seen through the middle.
  [[nodiscard]] std::optional<Eigen::Vector2d> place(const Vec& position) const;
  // The radius of the disk that a point is drawn as, in heights of the picture.
  [[nodiscard]] float blur(const Vec& position) const;

private:
  Camera camera_;
  Vec eye_;
  float radius_, focus_; // of the lens; distance of the plane in focus
};

} // namespace sheet::render
