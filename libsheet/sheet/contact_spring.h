// SPDX-License-Identifier: GPL-3.0-or-later
// The springs between near features of a sheet, as a frame carries them (formats/sheet.md, section 5, contact_*): a
// vertex and a triangle, or two edges.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"

namespace sheet {

struct ContactSpring {
  std::array<std::uint32_t, 4> vertices{};
  std::array<double, 4> weights{}; // their sum is 0
  Vector3 normal = Vector3::UnitZ();
  double rest = 0;                   // of the offset along the normal [m]
  Vector3 anchor = Vector3::Zero();  // the offset at which nothing pulls sideways [m]
  std::array<double, 2> stiffness{}; // normal, tangential [N/m]

  // Between vertices[0] and the triangle of the others; else between the first two and the last two.
  [[nodiscard]] bool of_vertex() const { return weights[0] == 1; }
  // From one feature to the other, Σ weight x position [m].
  [[nodiscard]] Vector3 offset(std::span<const Vector3> positions) const {
    Vector3 c = Vector3::Zero();
    for (std::size_t i = 1; i < 4; ++i) // from the first vertex, so that far from the origin no digits are lost
      c += weights[i] * (positions[vertices[i]] - positions[vertices[0]]);
    return c;
  }
};

// None if the frame has no contact arrays.
[[nodiscard]] std::vector<ContactSpring> read_springs(const formats::Frame& frame);
// Replaces the frame's springs; without any, its contact arrays go.
void write_springs(formats::Frame& frame, std::span<const ContactSpring> springs);

} // namespace sheet
