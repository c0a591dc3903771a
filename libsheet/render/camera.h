// SPDX-License-Identifier: GPL-3.0-or-later
// A camera: a pinhole, or a thin lens. Lengths in metres; the tracer works in units of its own (world.h), so rays come
// as directions.
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/geometry/box.h"
#include "libsheet/render/sampler.h"
#include "libsheet/render/types.h"

namespace sheet::render {

struct CameraOptions {
  std::optional<Vector3> eye, target; // [m]; absent: found so that everything is in the picture
  double field_of_view = 28;          // from the picture's lower to its upper edge [degrees]
  std::optional<double> azimuth;      // [degrees] of the camera as seen from what it looks at, if it is found; absent:
  std::optional<double> elevation;    // that of usual_view; likewise
};

struct Lens {
  double radius = 0, focus = 1; // [m]; of the plane that is sharp the distance along the axis
};

class Camera {
public:
  // Looks from `eye` at `target`; both different. `aspect`: width / height.
  Camera(const Vector3& eye, const Vector3& target, const Vector3& up, double field_of_view, double aspect);
  // The direction through a point of the picture, x and y in [0, 1] from the upper left.
  [[nodiscard]] Vec direction(double x, double y) const;
  // Whether the point lies before the camera and in the picture.
  [[nodiscard]] bool sees(const Vector3& x) const;
  [[nodiscard]] const Vector3& eye() const { return eye_; }
  [[nodiscard]] Vec axis() const { return ahead_.cast<float>(); } // where it looks
  [[nodiscard]] Vec right() const { return right_.cast<float>(); }
  [[nodiscard]] Vec above() const { return up_.cast<float>(); }
  // The same, turned about a line through `pivot` along the unit vector `axis` [rad].
  [[nodiscard]] Camera turned(const Vector3& pivot, const Vector3& axis, double angle) const;
  [[nodiscard]] double aspect() const { return tangent_x_ / tangent_y_; }
  // Where a point is in the picture, if it lies before the camera; `from_eye` in any unit.
  [[nodiscard]] std::optional<Eigen::Vector2d> place(const Vector3& from_eye) const;
  void set_lens(const Lens& lens) { lens_ = lens; }
  [[nodiscard]] const Lens& lens() const { return lens_; }
  // The angle that a pixel's edge spans, if the picture is `height` pixels high [rad].
  [[nodiscard]] double pixel_angle(int height) const { return 2 * tangent_y_ / height; }

private:
  Vector3 eye_, ahead_, right_, up_;
  double tangent_x_, tangent_y_;
  Lens lens_;
};

// The direction from what is looked at to the camera. Azimuth runs from the scene's z axis to its x axis if up is y; up
// may be any unit vector.
[[nodiscard]] Vector3 direction_to_camera(const CameraOptions& options, const Vector3& up);

struct ViewAngles {
  double azimuth, elevation; // [degrees]
};
inline constexpr ViewAngles usual_view{30, 25};

// The cosine of the angle between the upward axis and the normal of a plane that is a wall, at most.
inline constexpr double wall = 0.3;

// The angles from which fewest planes hide what is before them and, of those, most are seen by their front, walls not
// aslant, nearest to the usual ones: azimuths every 30 degrees; from above, else from below, else level. Then others of
// which the same is true, from which solids may hide less: from higher above, likewise from the other sides. Those that
// `options` has stay. `normals`: unit vectors out of the planes.
[[nodiscard]] std::vector<ViewAngles> views_before_planes(CameraOptions options, const Vector3& up,
                                                          std::span<const Vector3> normals);

// Parts of the picture's width or height that stay free at each edge.
struct Margins {
  double right = 0, left = 0, top = 0, bottom = 0;
};

// Finds the place of a camera of given direction from which all of some points are in the picture. A point p is in
// it if
//   (p - eye).right <= tangent (eye - p).toward,   likewise to the left, upwards and downwards, each with its tangent,
// which bounds four linear functions of p: their greatest values over the points are all that need be kept.
class ViewFit {
public:
  ViewFit(const CameraOptions& options, const Vector3& up, double aspect, const Margins& margins);
  void add(const Vector3& center, double radius); // a ball
  void add(const ViewFit& other);                 // of the same camera
  // With a target, on the line through it. `growth`: as if all points were so many times their distance farther from
  // `middle`. At least one point must have been added.
  [[nodiscard]] Camera camera(const Vector3& middle, double growth) const;
  // How far from `target` the eye must be to see all of them, if it looks at that. `middle`, `growth`: as above.
  [[nodiscard]] double distance(const Vector3& target, const Vector3& middle, double growth) const;

private:
  [[nodiscard]] std::array<double, 4> grown(const Vector3& middle, double growth) const;
  CameraOptions options_;
  Vector3 up_, toward_;
  std::array<Vector3, 4> side_; // right, left, above, below
  double aspect_;
  std::array<double, 4> tangent_; // of the part of the field of view to each side
  std::array<double, 4> most_;    // of p.(tangent toward + side)
};

} // namespace sheet::render
