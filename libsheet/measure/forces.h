// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of holds and solids on the sheet, in scenes that ask for them ([model] forces) or have rolls.
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/cpp/stream_frame.h"

namespace sheet {

struct NamedForce {
  std::string name;      // "hold 0", "solid 2": numbers from 0, in the scene's order
  Eigen::Vector3d force; // on the sheet at the end of the frame's step [N]; NaN where no step has been
};

// Sums of the array hold_force, and the rows of solid_force. Remembers the last scene, which rarely changes within a
// stream.
class SceneForces {
public:
  // None where the scene does not ask, or cannot be read.
  [[nodiscard]] std::vector<NamedForce> of(const formats::Frame& frame);

private:
  std::string scene_;
  bool wanted_ = false;
  std::size_t holds_ = 0, solids_ = 0;
};

} // namespace sheet
