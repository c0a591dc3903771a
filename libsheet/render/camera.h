// SPDX-License-Identifier: GPL-3.0-or-later
// A pinhole camera. Lengths in metres; the tracer works in units of its own (world.h), so rays come as directions.
#pragma once
#include <limits>
#include <optional>

#include "libsheet/geometry/types.h"
#include "libsheet/render/sampler.h"
#include "libsheet/render/types.h"

namespace sheet::render {

struct CameraOptions {
  std::optional<Vector3> eye, target; // [m]; absent: found so that everything is in the picture
  double field_of_view = 28;          // from the picture's lower to its upper edge [degrees]
  double azimuth = 30, elevation = 25; // [degrees] of the camera as seen from what it looks at, if it is found
};

struct Box {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vector3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] bool empty() const { return !(low.array() <= high.array()).all(); }
  [[nodiscard]] Vector3 center() const { return 0.5 * (low + high); }
  [[nodiscard]] double diagonal() const { return empty() ? 0 : (high - low).norm(); }
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
  // The angle that a pixel's edge spans, if the picture is `height` pixels high [rad].
  [[nodiscard]] double pixel_angle(int height) const { return 2 * tangent_y_ / height; }

private:
  Vector3 eye_, ahead_, right_, up_;
  double tangent_x_, tangent_y_;
};

// The direction from what is looked at to the camera. Azimuth runs from the scene's z axis to its x axis if up is y; up
// may be any unit vector.
[[nodiscard]] Vector3 direction_to_camera(const CameraOptions& options, const Vector3& up);

// The camera that has the whole box in the picture, with a margin of `margin` of the picture around it. The box must
// not be empty.
[[nodiscard]] Camera frame_box(const Box& box, const CameraOptions& options, const Vector3& up, double aspect,
                               double margin);

} // namespace sheet::render
