// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle of a sheet as a slab with round edges: all that is nearer to it than half the thickness there. Its field
// is f(x) = |x - p| - h(p)/2, with p the triangle's point nearest to x [Ericson 2005, section 5.1.5] and h linear
// between the corners; for eight places at a time, in single precision. As p moves no faster than x, f changes by no
// more than 1 + |grad h|/2 times the way: what bounds it in a block of space. Lengths are in voxels.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "libsheet/geometry/types.h"
#include "libsheet/solid/vdb/lanes.h"

namespace sheet::solid {

class SlabTriangle {
public:
  SlabTriangle(const std::array<Vector3, 3>& corners, const std::array<double, 3>& thickness);

  // f at eight places.
  void field_at(const LanePlace& place, Lanes& f) const;

  [[nodiscard]] float steepness() const { return steepness_; } // 1 + |grad h|/2

private:
  struct Direction {
    float x, y, z;
    explicit Direction(const Vector3& v = Vector3::Zero())
        : x(static_cast<float>(v.x())), y(static_cast<float>(v.y())), z(static_cast<float>(v.z())) {}
    [[gnu::always_inline]] inline void dot(const LanePlace& p, Lanes& product) const {
      product = x * p.x + y * p.y + z * p.z;
    }
  };
  struct Side { // from corner i to the next one
    Direction corner, way, inward;
    float per_length2; // 1/|way|², 0 if it has no length
    float half, rise;  // half the thickness at the corner, and how much more it is at the next one
  };
  std::array<Side, 3> sides_;
  Direction normal_, slope_; // of half the thickness
  float inside_from_ = 0;    // infinite if the triangle has no area to speak of: its sides are all there is
  float steepness_ = 1;
};

inline SlabTriangle::SlabTriangle(const std::array<Vector3, 3>& corners, const std::array<double, 3>& thickness) {
  const Vector3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double twice_area = across.norm();
  const double size2 = (corners[1] - corners[0]).squaredNorm() + (corners[2] - corners[0]).squaredNorm();
  const bool has_area = twice_area > 1e-6 * size2;
  const Vector3 normal = has_area ? Vector3(across / twice_area) : Vector3::Zero();
  Vector3 slope = Vector3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vector3 way = corners[j] - corners[i], inward = normal.cross(way);
    const double length2 = way.squaredNorm();
    sides_[i] = {.corner = Direction(corners[i]),
                 .way = Direction(way),
                 .inward = Direction(inward),
                 .per_length2 = length2 > 0 ? static_cast<float>(1 / length2) : 0,
                 .half = static_cast<float>(thickness[i] / 2),
                 .rise = static_cast<float>((thickness[j] - thickness[i]) / 2)};
    if (has_area)
      slope += thickness[k] / 2 * inward / twice_area; // the corner's weight is inward·(x - corner i)/twice_area
  }
  normal_ = Direction(normal);
  slope_ = Direction(slope);
  if (!has_area)
    inside_from_ = std::numeric_limits<float>::infinity();
  double steepest = slope.norm(); // along the sides, where there is no area
  for (const Side& side : sides_)
    steepest = std::max(steepest, std::abs(static_cast<double>(side.rise)) * std::sqrt(side.per_length2));
  steepness_ = static_cast<float>(1 + steepest);
}

[[gnu::always_inline]] inline void SlabTriangle::field_at(const LanePlace& place, Lanes& f) const {
  Lanes nearest = std::numeric_limits<float>::infinity() - Lanes{}, half{}; // squared distance; half the thickness
  LanePlace first{};                                                        // from the first corner
  std::array<Lanes, 3> within;
  for (std::size_t i = 0; i < 3; ++i) {
    const Side& side = sides_[i];
    const LanePlace from{place.x - side.corner.x, place.y - side.corner.y, place.z - side.corner.z};
    if (i == 0)
      first = from;
    Lanes part;
    side.way.dot(from, part);
    part *= side.per_length2;
    part = part > 0.0F ? part : Lanes{};
    part = part < 1.0F ? part : 1.0F + Lanes{};
    const LanePlace off{from.x - part * side.way.x, from.y - part * side.way.y, from.z - part * side.way.z};
    const Lanes distance2 = off.x * off.x + off.y * off.y + off.z * off.z;
    half = distance2 < nearest ? side.half + part * side.rise : half;
    nearest = distance2 < nearest ? distance2 : nearest;
    side.inward.dot(from, within[i]);
  }
  Lanes height, along;
  normal_.dot(first, height);
  slope_.dot(first, along);
  const auto above = (within[0] >= inside_from_) & (within[1] >= inside_from_) & (within[2] >= inside_from_);
  half = above ? sides_[0].half + along : half;
  nearest = above ? height * height : nearest;
  for (int i = 0; i < lane_count; ++i)
    f[i] = __builtin_sqrtf(nearest[i]) - half[i];
}

} // namespace sheet::solid
