// SPDX-License-Identifier: GPL-3.0-or-later
// Short names of what pictures are computed in. Directions are unit vectors; colours are linear, with the primaries and
// the white of sRGB [IEC 61966-2-1]: red, green, blue.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sheet::render {

using Vec = Eigen::Vector3f;
using Colour = Eigen::Array3f;

inline constexpr float float_pi = std::numbers::pi_v<float>;

inline float luminance(const Colour& c) { return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2]; }

// From 0 at `low` to 1 at `high`, level at both.
inline float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

// Any right-handed frame whose third axis is the unit vector n [Duff et al. 2017].
struct Basis {
  Vec first, second, third;
  explicit Basis(const Vec& n) : third(n) {
    const float sign = std::copysign(1.0F, n.z()), a = -1.0F / (sign + n.z()), b = n.x() * n.y() * a;
    first = {1.0F + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    second = {b, sign + n.y() * n.y() * a, -n.y()};
  }
  [[nodiscard]] Vec world(float x, float y, float z) const { return x * first + y * second + z * third; }
};

} // namespace sheet::render
