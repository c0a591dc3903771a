// SPDX-License-Identifier: GPL-3.0-or-later
// The perturbation of positions of what enters at an inlet: that of its sheet (libsheet/scene/scene.h) goes on there,
// as if the sheet had been as long from the start. A wave is taken at the place that liquid would have had at the
// start; noise is drawn anew for each vertex.
#pragma once
#include <cstdint>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/shape/perturb.h"

namespace sheet::flow {

class RowPerturbation {
public:
  // Of inlet `number` of the scene, at the frame's time and step.
  RowPerturbation(const Scene& scene, std::size_t number, const formats::Frame& frame);

  // Whether nothing is perturbed.
  [[nodiscard]] bool none() const { return waves_.empty() && noises_.empty(); }
  // The way along the sheet's normal [m] of a vertex that is put at this part of the way from `origin`, its place in
  // the inlet, to `lowest`, its like in the row that entered last; the i-th of this row of those that enter now. The
  // same for the same numbers on every machine.
  [[nodiscard]] double at(const Eigen::Vector3d& origin, const Eigen::Vector3d& lowest, double part, std::size_t row,
                          std::size_t i) const;

private:
  struct NoiseOf {
    double amplitude;
    std::uint64_t seed; // of the noise, the inlet and the step
  };
  std::vector<HeightField> waves_;
  std::vector<NoiseOf> noises_;
  Eigen::Vector3d center_;        // of the sheet [m]
  scene::InletVelocity velocity_; // of what has come
  double from_, until_;           // since the start [s]
  Eigen::Matrix3d to_plane_;      // undoes the sheet's rotation
};

} // namespace sheet::flow
