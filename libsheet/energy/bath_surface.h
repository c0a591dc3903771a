// SPDX-License-Identifier: GPL-3.0-or-later
// What of a sheet a bath bears: what is under its surface, unless another layer is in between.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

class BathSurface {
public:
  // level: of the surface, against gravity [m]; borne: whether another layer bears a vertex; empty: none.
  BathSurface(const Vector3& gravity, double level, std::vector<char> borne)
      : up_(-gravity.normalized()), level_(level), borne_(std::move(borne)) {}
  [[nodiscard]] const Vector3& up() const { return up_; }
  [[nodiscard]] double level() const { return level_; }
  [[nodiscard]] double height(const Vector3& x) const { return up_.dot(x) - level_; } // above the surface [m]
  // Whether only the bath can bear a vertex.
  [[nodiscard]] bool open(std::uint32_t v) const { return borne_.empty() || borne_[v] == 0; }
  [[nodiscard]] bool bears(std::uint32_t v, const Vector3& x) const { return height(x) < 0 && open(v); }

private:
  Vector3 up_;
  double level_;
  std::vector<char> borne_;
};

} // namespace sheet
