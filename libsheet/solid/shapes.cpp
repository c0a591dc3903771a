// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/shapes.h"

#include <algorithm>
#include <cmath>

#include "libsheet/solid/convex_distance.h"

namespace sheet::solid {
namespace {

// A direction where every one is right.
Vector3 direction(const Vector3& v, const Vector3& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vector3(v / length) : otherwise;
}

Box3 around_origin(const Vector3& half) { return {-half, half}; }

class SphereDistance final : public ConvexDistance {
public:
  explicit SphereDistance(double radius) : radius_(radius) {}
  [[nodiscard]] Box3 bounds() const override { return around_origin(Vector3::Constant(radius_)); }
  [[nodiscard]] Near nearest(const Vector3& x) const override {
    return {x.norm() - radius_, direction(x, Vector3::UnitY())};
  }

private:
  double radius_;
};

class CapsuleDistance final : public ConvexDistance {
public:
  explicit CapsuleDistance(const scene::Capsule& capsule) : radius_(capsule.radius), half_(capsule.length / 2) {}
  [[nodiscard]] Box3 bounds() const override { return around_origin(Vector3(radius_, half_ + radius_, radius_)); }
  [[nodiscard]] Near nearest(const Vector3& x) const override {
    const Vector3 from_axis(x.x(), x.y() - std::clamp(x.y(), -half_, half_), x.z());
    return {from_axis.norm() - radius_, direction(from_axis, Vector3::UnitX())};
  }

private:
  double radius_, half_;
};

// Inside, the nearest face; outside, the nearest point.
class BoxDistance final : public ConvexDistance {
public:
  explicit BoxDistance(const Vector3& size) : half_(size / 2) {}
  [[nodiscard]] Box3 bounds() const override { return around_origin(half_); }
  [[nodiscard]] Near nearest(const Vector3& x) const override {
    const Vector3 over = x.cwiseAbs() - half_;
    Vector3 normal = Vector3::Zero();
    int axis = 0;
    const double most = over.maxCoeff(&axis);
    if (most <= 0) {
      normal[axis] = std::copysign(1.0, x[axis]);
      return {most, normal};
    }
    const Vector3 out = over.cwiseMax(0.0);
    const double distance = out.norm();
    for (int i = 0; i < 3; ++i)
      normal[i] = std::copysign(out[i] / distance, x[i]);
    return {distance, normal};
  }

private:
  Vector3 half_;
};

// The distance of a rectangle in the plane of radius and height.
class CylinderDistance final : public ConvexDistance {
public:
  explicit CylinderDistance(const scene::Cylinder& cylinder) : radius_(cylinder.radius), half_(cylinder.height / 2) {}
  [[nodiscard]] Box3 bounds() const override { return around_origin(Vector3(radius_, half_, radius_)); }
  [[nodiscard]] Near nearest(const Vector3& x) const override {
    const Vector3 radial = direction(Vector3(x.x(), 0, x.z()), Vector3::UnitX());
    const Vector3 axial(0, std::copysign(1.0, x.y()), 0);
    const double out = std::hypot(x.x(), x.z()) - radius_, up = std::abs(x.y()) - half_;
    if (out <= 0 && up <= 0)
      return out >= up ? Near{out, radial} : Near{up, axial};
    const Vector3 from = std::max(out, 0.0) * radial + std::max(up, 0.0) * axial;
    const double distance = from.norm();
    return {distance, from / distance};
  }

private:
  double radius_, half_;
};

class HalfSpaceDistance final : public ConvexDistance {
public:
  explicit HalfSpaceDistance(const Vector3& normal) : normal_(normal.stableNormalized()) {}
  [[nodiscard]] Box3 bounds() const override {
    return around_origin(Vector3::Constant(std::numeric_limits<double>::infinity()));
  }
  [[nodiscard]] Near nearest(const Vector3& x) const override { return {normal_.dot(x), normal_}; }

private:
  Vector3 normal_;
};

} // namespace

std::unique_ptr<const SolidDistance> make_distance(const scene::Sphere& sphere) {
  return std::make_unique<SphereDistance>(sphere.radius);
}
std::unique_ptr<const SolidDistance> make_distance(const scene::SolidBox& box) {
  return std::make_unique<BoxDistance>(box.size);
}
std::unique_ptr<const SolidDistance> make_distance(const scene::Capsule& capsule) {
  return std::make_unique<CapsuleDistance>(capsule);
}
std::unique_ptr<const SolidDistance> make_distance(const scene::Cylinder& cylinder) {
  return std::make_unique<CylinderDistance>(cylinder);
}
std::unique_ptr<const SolidDistance> make_distance(const scene::HalfSpace& half_space) {
  return std::make_unique<HalfSpaceDistance>(half_space.normal);
}

} // namespace sheet::solid
