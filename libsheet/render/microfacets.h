// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images in rough faces: many small mirrors, whose normals are distributed as of an ellipsoid, GGX [Walter,
// Marschner, Li and Torrance 2007], drawn among those that are seen [Heitz 2018, Sampling the GGX distribution of
// visible normals].
#pragma once
#include <algorithm>
#include <cmath>

#include "libsheet/render/sampler.h"
#include "libsheet/render/types.h"

namespace sheet::render {

// The square that is felt as twice as rough [Burley 2012]: alpha of GGX is roughness².
[[nodiscard]] inline float alpha_of(float roughness) { return roughness * roughness; }

// What a rough face makes of a ray of that `direction`, which goes against its unit `normal`.
class RoughMirror {
public:
  RoughMirror(const Vec& normal, const Vec& direction, float roughness)
      : axes_(normal), direction_(direction), alpha_(std::max(alpha_of(roughness), 1e-4F)) {}

  // A direction of its mirror image; below the face where small mirrors shade each other.
  [[nodiscard]] Vec sample(Point2 p) const {
    const Vec view = -local(direction_);
    const Vec stretched = Vec(alpha_ * view.x(), alpha_ * view.y(), view.z()).normalized();
    const float across = stretched.x() * stretched.x() + stretched.y() * stretched.y();
    const Vec first = across > 0 ? Vec(Vec(-stretched.y(), stretched.x(), 0) / std::sqrt(across)) : Vec(Vec::UnitX());
    const Vec second = stretched.cross(first);
    const float radius = std::sqrt(p.x), angle = 2 * float_pi * p.y, s = 0.5F * (1 + stretched.z());
    const float x = radius * std::cos(angle);
    const float y = (1 - s) * std::sqrt(std::max(0.0F, 1 - x * x)) + s * radius * std::sin(angle);
    const Vec bent = x * first + y * second + std::sqrt(std::max(0.0F, 1 - x * x - y * y)) * stretched;
    const Vec small = axes_.world(alpha_ * bent.x(), alpha_ * bent.y(), std::max(1e-6F, bent.z())).normalized();
    return (direction_ - 2 * direction_.dot(small) * small).normalized();
  }

  // Of sample() by solid angle [1/sr]: G1 D / (4 |cos|) of the small mirror half-way.
  [[nodiscard]] float density(const Vec& image) const {
    const Vec half = local(image - direction_).normalized();
    const float cosine = -direction_.dot(axes_.third);
    if (!(half.z() > 0 && cosine > 0))
      return 0;
    const float a = alpha_ * alpha_, slope = half.z() * half.z() * (a - 1) + 1;
    const float seen = 2 * cosine / (cosine + std::sqrt(a + (1 - a) * cosine * cosine));
    return seen * a / (float_pi * slope * slope) / (4 * cosine);
  }

private:
  [[nodiscard]] Vec local(const Vec& v) const { return {v.dot(axes_.first), v.dot(axes_.second), v.dot(axes_.third)}; }

  Basis axes_;
  Vec direction_;
  float alpha_;
};

} // namespace sheet::render
