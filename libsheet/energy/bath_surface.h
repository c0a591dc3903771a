// SPDX-License-Identifier: GPL-3.0-or-later
// How a bath reaches a sheet: what is under its surface.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// By which faces it reaches a vertex that is under its surface.
enum class BathReach : std::uint8_t {
  below,   // the lower one, from which the normals point away: what floats
  facing,  // the lower one, to which they point: what floats on its face
  outside, // the outer one, to which they point: what is closed
  around,  // both: the bath has come over a rim
  none     // neither: another layer is in between
};

class BathSurface {
public:
  // level: of the surface, against gravity [m]; reach: one a vertex; empty: below for all.
  BathSurface(const Vector3& gravity, double level, std::vector<BathReach> reach)
      : up_(-gravity.normalized()), level_(level), reach_(std::move(reach)) {}
  [[nodiscard]] const Vector3& up() const { return up_; }
  [[nodiscard]] double level() const { return level_; }
  [[nodiscard]] double height(const Vector3& x) const { return up_.dot(x) - level_; } // above the surface [m]
  [[nodiscard]] BathReach reach(std::uint32_t v) const { return reach_.empty() ? BathReach::below : reach_[v]; }
  [[nodiscard]] bool on_one_face(std::uint32_t v) const { return reach(v) < BathReach::around; }
  // Of a triangle, -1 if the face that it reaches is the one to which the normal points, else 1.
  [[nodiscard]] double side(const Corners& corners) const {
    return std::ranges::any_of(corners, [&](auto v) { return on_one_face(v) && reach(v) != BathReach::below; }) ? -1
                                                                                                                : 1;
  }
  // Whether a vertex at x floats on the bath; whether the bath is there at all.
  [[nodiscard]] bool bears(std::uint32_t v, const Vector3& x) const { return height(x) < 0 && on_one_face(v); }
  [[nodiscard]] bool wets(std::uint32_t v, const Vector3& x) const {
    return height(x) < 0 && reach(v) != BathReach::none;
  }

private:
  Vector3 up_;
  double level_;
  std::vector<BathReach> reach_;
};

} // namespace sheet
