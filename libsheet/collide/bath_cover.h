// SPDX-License-Identifier: GPL-3.0-or-later
// Where a sheet that floats lies on a bath, or a boat of it is dry, so that nothing that falls there comes to the bath.
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet::collide {

class BathCover {
public:
  // up: against gravity; level: of the bath along that [m].
  BathCover(const formats::Frame& frame, const Vector3& up, double level);

  // Whether the sheet covers the bath under the place x [m]: one of its triangles lies below x, and is not flooded.
  // What is flooded lies deeper than its thickness, and so does all from there to a rim.
  [[nodiscard]] bool under(const Vector3& x) const;

private:
  Connectivity mesh_;
  std::span<const Vector3> positions_;
  Vector3 up_;
  std::vector<char> flooded_; // of each vertex
};

} // namespace sheet::collide
