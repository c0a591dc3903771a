// SPDX-License-Identifier: GPL-3.0-or-later
// A frame without some of its triangles, its vertices taken apart into fans (fans.h).
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/flow/fans.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Gives the frame the vertices of the fans at the positions `opened`, without dropped triangles. Each fan of a vertex
// gets its part of what the old vertex carried, by volume; vertices that have no triangle left go.
void put_fans(formats::Frame& frame, const Fans& fans, const std::vector<bool>& dropped,
              std::span<const Vector3> opened);

// What dropped triangles take with them, by a third of each at its corners.
struct Dropped {
  std::size_t triangles = 0;
  double volume = 0;                  // [m³]
  Vector3 momentum = Vector3::Zero(); // [kg m/s]
  double energy = 0;                  // kinetic [J]
  double warmth = 0;                  // see heat_account.h [m³ K]; 0 without temperatures
};
[[nodiscard]] Dropped sum_of(const formats::Frame& frame, const std::vector<bool>& dropped, const Scene& scene);

} // namespace sheet::flow
