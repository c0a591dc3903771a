// SPDX-License-Identifier: GPL-3.0-or-later
// How long steps are done without arcs after one that did not converge with them: 1, 2, 4, ... 32 steps, twice as many
// each time that arcs fail again at once. Where triangles are crushed they fail step after step, and each attempt costs
// some fifty iterations where the step without them takes one or two.
#pragma once
#include "formats/cpp/stream_frame.h"

namespace sheet {

class ArcRest {
public:
  // As the frame says (arrays step.flat_left and step.flat_run; absent: 0).
  explicit ArcRest(const formats::Frame& frame);

  [[nodiscard]] bool rests() const { return left_ > 0; }
  // After a step: whether it was done without arcs, though they did not rest.
  void note(bool failed);
  void put(formats::Frame& frame) const;

private:
  double left_, run_; // steps still to be done, and of the last rest
};

} // namespace sheet
