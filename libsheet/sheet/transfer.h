// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of the rows of arrays when the mesh changes, by each array's transfer rule (formats/sheet.md, section
// 4). One kernel serves single edits (remesh/) and whole frames (tearing, inflow).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet {

// An old row that a new row comes from.
struct Parent {
  std::uint32_t row;
  double weight; // in the new row's value; the weights of a new row sum to 1; 0: it gives of its amount only
  double share; // the part of the old row's amount that the new row gets; the shares of an old row sum to 1 unless some
                // of its amount leaves the sheet
};

// Writes one new row, size_of(type) * components bytes. `parents` is not empty, except under the rule conserve, where
// no parents mean zero. The rule is not drop. copy: the parent with the largest weight, the first of them if several.
// mean: weights are by volume (Lineage::by_volume).
void transfer_row(const formats::Array& from, std::span<const Parent> parents, std::byte* to);

// New rows 0, 1, ... and their parents.
class Lineage {
public:
  void add(std::span<const Parent> parents);
  void keep(std::uint32_t row) { add(std::span<const Parent>(std::initializer_list<Parent>{{row, 1, 1}})); }
  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  [[nodiscard]] std::span<const Parent> operator[](std::size_t row) const {
    return std::span(parents_).subspan(first_[row], first_[row + 1] - first_[row]);
  }

  // The same with weights by the volume that parents give, where they give any, for arrays with the rule mean. Where
  // each new row has the volume that its parents give, the sum of row x volume stays. `volumes`: of the old rows.
  [[nodiscard]] Lineage by_volume(std::span<const double> volumes) const;

private:
  std::vector<std::size_t> first_ = {0};
  std::vector<Parent> parents_;
};

// All rows of an array whose rule is not drop. Of one with the rule mean: `lineage` is by volume.
[[nodiscard]] formats::Array transferred(const formats::Array& old, const Lineage& lineage);

// The frame with new vertices, triangles and connectivity. Vertex and triangle arrays go by their rule (`position`,
// `velocity` and `volume` too: a caller with a better rule overwrites them); arrays whose rule is drop go, at every
// place; arrays at place edge go along (edge_rows.h), contact springs too (carried_springs.h): a spring's vertex
// becomes the new vertex that has the largest share of it, the first of them if several.
void transfer_frame(formats::Frame& frame, const Lineage& vertices, const Lineage& triangles,
                    std::span<const Corners> corners);

} // namespace sheet
