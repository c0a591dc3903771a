// SPDX-License-Identifier: GPL-3.0-or-later
// Drops: balls of liquid beside the sheet, as a frame carries them (formats/sheet.md, section 5, drop_*). SI units.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"

namespace sheet {

struct Drop {
  Vector3 position = Vector3::Zero(); // of its middle [m]
  Vector3 velocity = Vector3::Zero(); // [m/s]
  double volume = 0;                  // [m³]
  std::uint32_t liquid = 0;           // number of its liquid, as in the array "liquid"
  double temperature = 0;             // [K]; 0 in frames without temperatures
  std::uint32_t touch = 0;            // 0: it flies; n: it lies on the scene's n-th solid, from 1, or its bath

  [[nodiscard]] bool flies() const { return touch == 0; }
  [[nodiscard]] double radius() const { return ball_radius(volume); }
  // Of a ball of this volume.
  [[nodiscard]] static double ball_radius(double volume);
};

// Whether the frame is of a scene with drops, even if there are none now.
[[nodiscard]] bool knows_drops(const formats::Frame& frame);
// None if the frame has no such arrays.
[[nodiscard]] std::vector<Drop> read_drops(const formats::Frame& frame);
// Replaces the frame's drops; without any its arrays have no rows. Liquids and temperatures are written where the
// frame's triangles have them. Where drops stood at the start of the step is forgotten.
void write_drops(formats::Frame& frame, std::span<const Drop> drops);
// Of all of them [m³].
[[nodiscard]] double volume_of_drops(const formats::Frame& frame);

} // namespace sheet
