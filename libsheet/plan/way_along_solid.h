// SPDX-License-Identifier: GPL-3.0-or-later
// Ways that liquid may go along a solid, in steps, without regard to how fast.
#pragma once
#include <algorithm>
#include <deque>

#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet {

// A way along a solid that stands as at time t, half a thickness above it.
class WayAlongSolid {
public:
  WayAlongSolid(const Scene& scene, const solid::Solids& solids, std::size_t number, double t, double thickness,
                const Vector3& from)
      : scene_(scene), solids_(solids), number_(number), t_(t), thickness_(thickness),
        step_(std::max(thickness / 4, solids.shape(number).bounds().diagonal().norm() / steps_across)), x_(from) {
    come_to(from);
  }

  [[nodiscard]] const Vector3& x() const { return x_; }
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] Vector3 along(const Vector3& direction) const { return direction - direction.dot(normal_) * normal_; }

  // A step in that direction, along the solid; whether an edge has been passed then.
  bool go(const Vector3& direction) {
    const Vector3 ahead = along(direction).normalized();
    directions_.push_back(ahead);
    if (static_cast<double>(directions_.size()) > std::max(1.0, in_reach * thickness_ / step_))
      directions_.pop_front();
    come_to(x_ + step_ * ahead);
    return normal_.dot(directions_.front()) > turned;
  }

  // Whether another solid is near.
  [[nodiscard]] bool meets_another() const {
    for (std::size_t i = 0; i < solids_.size(); ++i)
      if (i != number_ && solids_.at(i, x_, t_).distance < in_reach * thickness_)
        return true;
    return false;
  }

  // Whether something else takes up what is there: another solid, a bath, an outflow.
  [[nodiscard]] bool taken_up() const {
    if (meets_another())
      return true;
    const auto up = scene::up(scene_.environment);
    if (up && scene_.environment.bath && up->dot(x_) < scene_.environment.bath->level)
      return true;
    return std::ranges::any_of(scene_.outflows,
                               [&](const scene::Outflow& o) { return o.normal.dot(x_ - o.point) > 0; });
  }

  static constexpr int most_steps = 1000;
  static constexpr double in_reach = 2;      // thicknesses
  static constexpr double least_slope = 0.1; // part of gravity along the solid, below which nothing runs

private:
  static constexpr double steps_across = 300;
  static constexpr double turned = 0.7; // sine of the angle by which an edge turns at least

  void come_to(const Vector3& x) {
    const solid::SolidPoint there = solids_.at(number_, x, t_);
    normal_ = there.normal;
    x_ = x + (thickness_ / 2 - there.distance) * normal_;
  }

  const Scene& scene_;
  const solid::Solids& solids_;
  std::size_t number_;
  double t_, thickness_, step_;
  Vector3 x_, normal_;
  std::deque<Vector3> directions_; // of the last steps, over as much as an edge may be long
};

} // namespace sheet
