// SPDX-License-Identifier: GPL-3.0-or-later
// The contact springs of a frame (arrays contact_*, formats/sheet.md, section 5) on their way through a change of the
// mesh.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet {

class CarriedSprings {
public:
  // Takes note of the frame's springs and of their offsets c = Σ weight x position.
  explicit CarriedSprings(const formats::Frame& frame);
  // True for the names of the arrays that this class looks after.
  [[nodiscard]] static bool has(std::string_view array);
  [[nodiscard]] bool empty() const { return springs_.empty(); }

  // successor[v]: the new vertex that takes the place of old vertex v, or no_index. A spring goes if one of its
  // vertices has none, or if its features come to share one. Where vertices of one feature become one, that one has the
  // sum of their weights, and `put` takes others beside it, with the weight 0, for the feature to stay a triangle or an
  // edge.
  void move(std::span<const std::uint32_t> successor);

  // Writes the springs into a frame whose positions are final. Where c has changed, rest and anchor change by as much,
  // so that a change of the mesh neither strains nor relaxes a spring.
  void put(formats::Frame& frame) const;

private:
  struct Spring {
    std::uint64_t row;
    std::array<std::uint32_t, 4> vertices; // no_index: still to be taken, by `put`
    std::array<double, 4> weights;
    Eigen::Vector3d offset;

    [[nodiscard]] std::size_t second_feature() const { return weights[0] == 1 ? 1 : 2; }
  };
  static bool merge(Spring& spring);
  static std::vector<Spring> completed(std::vector<Spring> springs, const formats::Frame& frame);

  std::vector<Spring> springs_;
  std::vector<formats::Array> arrays_; // as they were
};

} // namespace sheet
