// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/camera.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace sheet::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Two level axes beside `up`: ahead is z and aside x if up is y.
void level_axes(const Vector3& up, Vector3& ahead, Vector3& aside) {
  const Vector3 z = std::abs(up.z()) < 0.9 ? Vector3::UnitZ() : Vector3(-Vector3::UnitY());
  ahead = (z - z.dot(up) * up).normalized();
  aside = up.cross(ahead);
}

// What is on the right of somebody who looks ahead; straight up or down, the level axis aside.
Vector3 right_of(const Vector3& ahead, const Vector3& up) {
  const Vector3 right = ahead.cross(up);
  if (right.norm() > 1e-9)
    return right.normalized();
  Vector3 level, aside;
  level_axes(up, level, aside);
  return aside;
}

} // namespace

Camera::Camera(const Vector3& eye, const Vector3& target, const Vector3& up, double field_of_view, double aspect)
    : eye_(eye), ahead_((target - eye).normalized()), right_(right_of(ahead_, up)), up_(right_.cross(ahead_)) {
  tangent_y_ = std::tan(field_of_view * degree / 2);
  tangent_x_ = tangent_y_ * aspect;
}

Vec Camera::direction(double x, double y) const {
  return (ahead_ + (2 * x - 1) * tangent_x_ * right_ + (1 - 2 * y) * tangent_y_ * up_).normalized().cast<float>();
}

std::optional<Eigen::Vector2d> Camera::place(const Vector3& from_eye) const {
  const double depth = from_eye.dot(ahead_);
  if (!(depth > 0))
    return {};
  return Eigen::Vector2d(0.5 + from_eye.dot(right_) / (2 * depth * tangent_x_),
                         0.5 - from_eye.dot(up_) / (2 * depth * tangent_y_));
}

Camera Camera::turned(const Vector3& pivot, const Vector3& axis, double angle) const {
  const Eigen::AngleAxisd turn(angle, axis);
  Camera camera = *this;
  camera.eye_ = pivot + turn * (eye_ - pivot);
  for (Vector3* direction : {&camera.ahead_, &camera.right_, &camera.up_})
    *direction = turn * *direction;
  return camera;
}

bool Camera::sees(const Vector3& x) const {
  const Vector3 d = x - eye_;
  const double depth = d.dot(ahead_);
  return depth > 0 && std::abs(d.dot(right_)) <= depth * tangent_x_ && std::abs(d.dot(up_)) <= depth * tangent_y_;
}

Vector3 direction_to_camera(const CameraOptions& options, const Vector3& up) {
  Vector3 ahead, aside;
  level_axes(up, ahead, aside);
  const double azimuth = options.azimuth.value_or(usual_view.azimuth) * degree,
               elevation = options.elevation.value_or(usual_view.elevation) * degree;
  return std::cos(elevation) * (std::cos(azimuth) * ahead + std::sin(azimuth) * aside) + std::sin(elevation) * up;
}

std::vector<ViewAngles> views_before_planes(CameraOptions options, const Vector3& up,
                                            std::span<const Vector3> normals) {
  // Sines of the angles at which next to nothing is seen of a plane, and at which half is.
  constexpr double grazing = 0.1, aslant = 0.5;
  constexpr std::array aside{0, -30, 30, -60, 60, -90, 90, -120, 120, -150, 150, 180}; // from the usual azimuth
  const CameraOptions asked = options;
  const auto below = [&](double sine, const ViewAngles& view) {
    options.azimuth = view.azimuth;
    options.elevation = view.elevation;
    const Vector3 toward = direction_to_camera(options, up);
    return [sine, toward](const Vector3& n) { return n.dot(toward) < sine; };
  };
  const auto cost = [&](const ViewAngles& view) { // planes that hide what is before them; those not seen
    return std::pair(std::ranges::count_if(normals, below(-1e-9, view)),
                     std::ranges::count_if(normals, below(grazing, view)));
  };
  std::vector<Vector3> walls;
  std::ranges::copy_if(normals, std::back_inserter(walls),
                       [&](const Vector3& n) { return std::abs(n.dot(up)) < wall; });
  std::vector<ViewAngles> views;
  for (const double elevation : {usual_view.elevation, -usual_view.elevation, 0.0})
    for (const int degrees : aside)
      views.push_back({asked.azimuth.value_or(usual_view.azimuth + degrees), asked.elevation.value_or(elevation)});
  const ViewAngles first = *std::ranges::min_element(views, {}, cost);
  std::erase_if(views, [&](const ViewAngles& v) { return v.elevation != first.elevation || cost(v) != cost(first); });
  const ViewAngles best = *std::ranges::min_element(
      views, {}, [&](const ViewAngles& v) { return std::ranges::count_if(walls, below(aslant, v)); });
  views = {best};
  for (const double azimuth : {0.0, 180.0, -90.0, 90.0})
    for (const double elevation : {best.elevation, 50.0, 75.0}) {
      const ViewAngles view{asked.azimuth.value_or(best.azimuth + azimuth), asked.elevation.value_or(elevation)};
      if (cost(view) <= cost(best))
        views.push_back(view);
    }
  return views;
}

ViewFit::ViewFit(const CameraOptions& options, const Vector3& up, double aspect, const Margins& margins)
    : options_(options), up_(up), toward_(direction_to_camera(options, up)), aspect_(aspect) {
  const Vector3 right = right_of(-toward_, up), above = right.cross(-toward_);
  side_ = {right, -right, above, -above};
  const double y = std::tan(options.field_of_view * degree / 2), x = y * aspect;
  tangent_ = {x * (1 - 2 * margins.right), x * (1 - 2 * margins.left), y * (1 - 2 * margins.top),
              y * (1 - 2 * margins.bottom)};
  most_.fill(-std::numeric_limits<double>::infinity());
}

void ViewFit::add(const Vector3& center, double radius) {
  for (std::size_t i = 0; i < 4; ++i)
    most_[i] = std::max(most_[i], center.dot(tangent_[i] * toward_ + side_[i]) + radius * std::hypot(1, tangent_[i]));
}

void ViewFit::add(const ViewFit& other) {
  for (std::size_t i = 0; i < 4; ++i)
    most_[i] = std::max(most_[i], other.most_[i]);
}

Camera ViewFit::camera(const Vector3& middle, double growth) const {
  const Vector3 target = options_.target.value_or(middle);
  if (options_.eye)
    return {*options_.eye, target, up_, options_.field_of_view, aspect_};
  if (options_.target) {
    const Vector3 eye = target + distance(target, middle, growth) * toward_;
    return {eye, eye - toward_, up_, options_.field_of_view, aspect_};
  }
  const std::array<double, 4> most = grown(middle, growth);
  // As near as both pairs of sides allow, and in the middle between those of the other pair.
  double distance = -std::numeric_limits<double>::infinity();
  for (const std::size_t i : {0, 2})
    distance = std::max(distance, (most[i] + most[i + 1]) / (tangent_[i] + tangent_[i + 1]));
  Vector3 across = Vector3::Zero(); // where the eye is in the plane across its line of sight
  for (const std::size_t i : {0, 2})
    across += 0.5 * (most[i] - most[i + 1] + distance * (tangent_[i + 1] - tangent_[i])) * side_[i];
  const Vector3 eye = across + distance * toward_;
  return {eye, eye - toward_, up_, options_.field_of_view, aspect_};
}

std::array<double, 4> ViewFit::grown(const Vector3& middle, double growth) const {
  std::array<double, 4> most = most_;
  for (std::size_t i = 0; i < 4; ++i)
    most[i] += growth * (most[i] - (tangent_[i] * toward_ + side_[i]).dot(middle));
  return most;
}

double ViewFit::distance(const Vector3& target, const Vector3& middle, double growth) const {
  const std::array<double, 4> most = grown(middle, growth);
  double distance = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i)
    distance = std::max(distance, (most[i] - (tangent_[i] * toward_ + side_[i]).dot(target)) / tangent_[i]);
  return distance;
}

} // namespace sheet::render
