// SPDX-License-Identifier: GPL-3.0-or-later
// The connectivity of one frame after another, found anew only where it has changed.
#pragma once
#include <algorithm>
#include <memory>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

class FrameMesh {
public:
  // True if this frame's connectivity is another one than that of the frame before. Errors: as connect.
  bool follow(const formats::Frame& frame) {
    const auto corners = triangles(frame);
    if (mesh_ && mesh_->vertices == frame.vertices &&
        std::equal(corners.begin(), corners.end(), mesh_->triangles.begin(), mesh_->triangles.end()))
      return false;
    mesh_ = std::make_shared<Connectivity>(connect(frame.vertices, corners));
    return true;
  }
  // Null before the first frame.
  [[nodiscard]] const std::shared_ptr<const Connectivity>& mesh() const { return mesh_; }

private:
  std::shared_ptr<const Connectivity> mesh_;
};

} // namespace sheet
