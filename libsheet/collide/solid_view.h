// SPDX-License-Identifier: GPL-3.0-or-later
// A step as one solid sees it: the sheet's paths in the solid's own frame, in straight pieces.
#pragma once
#include <vector>

#include "libsheet/collide/step_path.h"
#include "libsheet/solid/solids.h"

namespace sheet::collide {

class SolidView {
public:
  // As many pieces as keep within `deviation` [m] of the true, bent paths of the sheet's vertices: a curve whose second
  // derivative stays below a leaves its chord over the time t by at most a t² / 8.
  SolidView(const solid::Solids& solids, std::size_t solid, const StepPath& path, double deviation);

  [[nodiscard]] const solid::SolidDistance& shape() const { return *shape_; }
  [[nodiscard]] bool flows() const { return flows_; } // whether what touches it moves along it
  [[nodiscard]] std::size_t pieces() const { return to_own_.size() - 1; }

  // From the world to the solid's frame at the start of piece k; k = pieces(): at the end of the step.
  [[nodiscard]] Vector3 own(std::size_t k, const Vector3& x) const { return to_own_[k] * x; }
  // Back, at the end of the step.
  [[nodiscard]] Vector3 world_at_end(const Vector3& own) const { return from_own_at_end_ * own; }
  [[nodiscard]] Vector3 turned_at_end(const Vector3& direction) const { return from_own_at_end_.linear() * direction; }
  // Where the solid takes the point that is at x at the step's start.
  [[nodiscard]] Vector3 carried(const Vector3& x) const { return world_at_end(own(0, x)); }
  // How far the belt moves where the surface has this normal, in the part s of the step, in the solid's frame at the
  // end [m].
  [[nodiscard]] Vector3 belt(double s, const Vector3& normal) const { return solid::along_surface(s * belt_, normal); }
  // Whether it has one.
  [[nodiscard]] bool runs() const { return !belt_.isZero(0); }

  // A point's place at the start of piece k: on its straight path in the world, or, where it rides on the solid, on the
  // straight path in the solid's frame.
  [[nodiscard]] Vector3 on_path(std::size_t k, const Vector3& start, const Vector3& end, bool rides) const {
    const double part = static_cast<double>(k) / static_cast<double>(pieces());
    if (rides)
      return (1 - part) * own(0, start) + part * own(pieces(), end);
    return own(k, (1 - part) * start + part * end);
  }

  // Where the solid is in the course of the step, in the world; infinite for a half-space.
  [[nodiscard]] const solid::Box3& swept() const { return swept_; }

private:
  const solid::SolidDistance* shape_;
  bool flows_;
  std::vector<Eigen::Isometry3d> to_own_;
  Eigen::Isometry3d from_own_at_end_;
  Vector3 belt_;
  solid::Box3 swept_;
};

} // namespace sheet::collide
