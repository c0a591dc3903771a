// SPDX-License-Identifier: GPL-3.0-or-later
// Places of a sheet: where a plane cuts it, and what is nearest to a point.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"
#include "libsheet/measure/cut_plane.h"
#include "libsheet/quantities/fields.h"

namespace sheet {

struct SurfacePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{}; // of its corners, whose sum is 1
};

[[nodiscard]] Vector3 position_of(const formats::Frame& frame, const SurfacePoint& point); // [m]
// Of a field's `values`: the triangle's, or between those of its corners.
[[nodiscard]] double value_at(const formats::Frame& frame, const Field& field, const std::vector<double>& values,
                              const SurfacePoint& point);

// A connected piece of a cut: start and end in each triangle that is cut, one after the other.
using CutCurve = std::vector<std::array<SurfacePoint, 2>>;

// The curves in which a plane cuts the sheet, the longest first. With the plane's normal upwards, what is above lies to
// the left of who walks along a curve on the sheet's positive side; so the direction stays from frame to frame. What is
// open begins at a rim; what is closed at its lowest place along y, in planes across y at the least x. Vertices on the
// plane are above it, or below if nothing else is. Throws Error (bad_input) where the mesh is not that of a sheet
// (connect).
[[nodiscard]] std::vector<CutCurve> cut(const formats::Frame& frame, const CutPlane& plane);

// Nothing of a sheet without triangles. Of several equally near the one in the first triangle.
[[nodiscard]] std::optional<SurfacePoint> nearest_point(const formats::Frame& frame, const Vector3& point);

} // namespace sheet
