// SPDX-License-Identifier: GPL-3.0-or-later
// What ends a run besides its time and its steps: a figure of the frame that passes a bound, "y_max > 40 mm".
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/measure/measure.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet {

class StopCondition {
public:
  // NAME < VALUE, or with >, <=, >=: a column of sheet-info --csv that is one number of the frame, or vertices or
  // triangles; the value with a unit, or in SI (angles in degrees). Throws Error (usage), naming --stop-when, what is
  // wrong and what there is.
  explicit StopCondition(const std::string& text);

  // What may stand before the comparison.
  [[nodiscard]] static std::vector<std::string> names();

  // "y_max is 0.0412 m" where it holds in the frame. Throws Error (usage) if the frame does not have that figure, as an
  // energy without a density.
  [[nodiscard]] std::optional<std::string> holds(const formats::Frame& frame);

private:
  [[nodiscard]] double value_in(const formats::Frame& frame);

  std::string name_, unit_, comparison_;
  double bound_ = 0; // SI, degrees
  SceneDensity density_;
  FrameScene scenes_;
};

} // namespace sheet
