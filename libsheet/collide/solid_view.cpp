// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/solid_view.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/error.h"

namespace sheet::collide {
namespace {

// Of a path in a solid's frame. Each vertex and each triangle is followed through all of them.
constexpr double most_pieces = 1e4;

// How far and how fast points are.
struct Reach {
  double radius = 0, speed = 0; // from where the motion's center is at first [m], in the world [m/s]
};

// A bound of the acceleration of such points as the moving frame sees it [m/s²]: its own, and for rotations those of
// Coriolis, centrifugal and Euler.
double acceleration_bound(const scene::MotionBounds& motion, double duration, const Reach& reach) {
  const double radius = reach.radius + motion.speed * duration, speed = reach.speed + motion.speed;
  return motion.acceleration + 2 * motion.turning * speed +
         (motion.turning * motion.turning + motion.turning_change) * radius;
}

Reach reach_of(const StepPath& path, const Vector3& center) {
  Reach reach;
  for (std::size_t v = 0; v < path.start.size(); ++v) {
    reach.radius = std::max({reach.radius, (path.start[v] - center).norm(), (path.end[v] - center).norm()});
    reach.speed = std::max(reach.speed, (path.end[v] - path.start[v]).norm() / path.length());
  }
  return reach;
}

} // namespace

SolidView::SolidView(const solid::Solids& solids, std::size_t solid, const StepPath& path, double deviation)
    : shape_(&solids.shape(solid)), flows_(solids.scene(solid).contact != SolidContact::stick) {
  const scene::MotionBounds motion = scene::bounds(solids.scene(solid).motion, path.start_time, path.end_time);
  const auto bent = [&](const Reach& reach, double time) {
    return acceleration_bound(motion, path.length(), reach) * time * time / 8;
  };
  const Vector3& center = motion.center;
  const double wanted = std::max(1.0, std::ceil(std::sqrt(bent(reach_of(path, center), path.length()) / deviation)));
  if (!(wanted <= most_pieces))
    fail(ExitCode::bad_input,
         "{} turns or speeds up so much within the step that paths beside it bend by {:.2g} m, while the sheet is "
         "{:.2g} m thin: take shorter steps, or a slower motion",
         solids.name(solid), bent(reach_of(path, center), path.length()), 100 * deviation);
  const auto pieces = static_cast<std::size_t>(wanted);
  const solid::Box3 own = shape_->bounds();
  const bool finite = own.sizes().allFinite();
  swept_ = finite ? solid::Box3() : own;
  Reach solid_reach;
  for (std::size_t k = 0; k <= pieces; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(pieces);
    const Eigen::Isometry3d place = solids.pose(solid, (1 - part) * path.start_time + part * path.end_time);
    to_own_.push_back(place.inverse());
    if (!finite)
      continue;
    const solid::Box3 now = own.transformed(place);
    swept_.extend(now);
    solid_reach.radius = std::max(solid_reach.radius, (now.center() - center).norm() + now.diagonal().norm() / 2);
  }
  from_own_at_end_ = to_own_.back().inverse();
  belt_ = to_own_.back().linear() * (path.length() * solids.scene(solid).surface_velocity);
  if (finite) { // the solid's own points bow out between the pieces' ends
    const double bow = bent(solid_reach, path.length() / static_cast<double>(pieces));
    swept_.min().array() -= bow;
    swept_.max().array() += bow;
  }
}

} // namespace sheet::collide
