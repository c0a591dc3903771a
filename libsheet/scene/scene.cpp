// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sheet::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double edge_of_rim = 1.05; // the longest of six edges around a rim, over its radius

std::optional<ShapeSize> size(const Rectangle& s) {
  const double shortest = std::min(s.size_first, s.size_second);
  return ShapeSize{shortest, shortest, s.size_first * s.size_second};
}
std::optional<ShapeSize> size(const Disk& s) { return ShapeSize{s.radius, s.radius, pi * s.radius * s.radius}; }
std::optional<ShapeSize> size(const Annulus& s) {
  const double width = s.outer_radius - s.inner_radius;
  return ShapeSize{width, std::min(width, edge_of_rim * s.inner_radius),
                   pi * width * (s.outer_radius + s.inner_radius)};
}
std::optional<ShapeSize> size(const Sphere& s) { return ShapeSize{s.radius, s.radius, 4 * pi * s.radius * s.radius}; }
std::optional<ShapeSize> size(const Cap& s) {
  const double height = s.radius * (std::cos(s.opening) - std::cos(s.angle));
  double smallest = std::min(1.0, s.angle - s.opening);
  for (const double rim : {s.opening, s.angle})
    if (rim > 0 && rim < pi)
      smallest = std::min(smallest, edge_of_rim * std::sin(rim));
  return ShapeSize{s.radius, s.radius * smallest, 2 * pi * s.radius * height};
}
std::optional<ShapeSize> size(const Tube& s) {
  const double shortest = std::min(s.radius, s.height);
  return ShapeSize{shortest, shortest, 2 * pi * s.radius * s.height};
}
std::optional<ShapeSize> size(const SheetMesh&) { return {}; }

Border least(int axis) { return static_cast<Border>(static_cast<int>(Border::x_min) + 2 * axis); }
Border greatest(int axis) { return static_cast<Border>(static_cast<int>(Border::x_max) + 2 * axis); }

std::vector<Border> borders(const Rectangle&, const PlaneAxes& axes) {
  return {Border::rim, least(axes.first), greatest(axes.first), least(axes.second), greatest(axes.second)};
}
std::vector<Border> borders(const Disk&, const PlaneAxes&) { return {Border::rim, Border::outer_rim}; }
std::vector<Border> borders(const Annulus&, const PlaneAxes&) {
  return {Border::rim, Border::inner_rim, Border::outer_rim};
}
std::vector<Border> borders(const Sphere&, const PlaneAxes&) { return {}; }
std::vector<Border> borders(const Cap& cap, const PlaneAxes&) {
  std::vector<Border> result;
  if (cap.opening > 0)
    result.push_back(Border::inner_rim);
  if (!(cap.angle >= pi))
    result.push_back(Border::outer_rim);
  if (!result.empty())
    result.insert(result.begin(), Border::rim);
  return result;
}
std::vector<Border> borders(const Tube&, const PlaneAxes& axes) {
  return {Border::rim, least(axes.normal), greatest(axes.normal)};
}
std::vector<Border> borders(const SheetMesh&, const PlaneAxes&) {
  return {Border::rim,   Border::inner_rim, Border::outer_rim, Border::x_min, Border::x_max,
          Border::y_min, Border::y_max,     Border::z_min,     Border::z_max};
}

} // namespace

std::optional<ShapeSize> size_of(const SheetShape& shape) {
  return std::visit([](const auto& s) { return size(s); }, shape);
}

bool flows_in_or_out(const Scene& scene) {
  return !scene.inflows.empty() || !scene.outflows.empty() ||
         std::ranges::any_of(scene.sheets, [](const SheetTable& sheet) { return sheet.enters.has_value(); });
}

std::vector<Liquid> liquids_of(const Scene& scene) {
  std::vector<Liquid> liquids{scene.material};
  for (const SheetTable& sheet : scene.sheets)
    if (sheet.material && std::ranges::find(liquids, *sheet.material) == liquids.end())
      liquids.push_back(*sheet.material);
  return liquids;
}

std::size_t liquid_of(const Scene& scene, const SheetTable& sheet) {
  const std::vector<Liquid> liquids = liquids_of(scene);
  return static_cast<std::size_t>(std::ranges::find(liquids, material_of(scene, sheet)) - liquids.begin());
}

const Liquid& material_of(const Scene& scene, const SheetTable& sheet) {
  return sheet.material ? *sheet.material : scene.material;
}

Scene with_material_of(const Scene& scene, const SheetTable& sheet) {
  Scene result = scene;
  result.material = material_of(scene, sheet);
  for (SheetTable& each : result.sheets)
    each.material.reset();
  return result;
}

const SheetTable& sheet_named(const Scene& scene, const std::string& name) {
  return name.empty() ? scene.sheets.front()
                      : *std::ranges::find(scene.sheets, name, [](const SheetTable& sheet) { return sheet.name; });
}

std::vector<Border> borders_of(const SheetTable& sheet) {
  return std::visit([&](const auto& s) { return borders(s, axes_of(sheet.plane)); }, sheet.shape);
}

Eigen::Matrix3d matrix(const std::optional<Rotation>& rotation) {
  if (!rotation)
    return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(rotation->angle, rotation->axis.stableNormalized()).toRotationMatrix();
}

Vector3d SheetAxis::outward(const Vector3d& x) const {
  const Vector3d from = x - center;
  return (from - direction.dot(from) * direction).normalized();
}

SheetAxis axis_of(const SheetTable& sheet) {
  return {sheet.center, matrix(sheet.rotation) * Vector3d::Unit(axes_of(sheet.plane).normal)};
}

PlaneAxes axes_of(Plane plane) {
  switch (plane) {
  case Plane::xy:
    return {0, 1, 2};
  case Plane::yz:
    return {1, 2, 0};
  case Plane::xz:
    break;
  }
  return {0, 2, 1};
}

std::optional<Vector3d> up(const Environment& environment) {
  if (!environment.gravity)
    return {};
  return -environment.gravity->stableNormalized();
}

bool solids_squeeze(const Scene& scene) {
  return scene.solids.size() > 1 &&
         std::ranges::any_of(scene.solids, [](const Solid& s) { return !std::holds_alternative<Fixed>(s.motion); });
}

bool encloses_gas(const Scene& scene) {
  return scene.environment.pressure && std::holds_alternative<GasPressure>(*scene.environment.pressure);
}

bool flows_on_solids(const Scene& scene) {
  return std::ranges::any_of(scene.solids, [](const Solid& s) { return s.contact != SolidContact::stick; });
}

bool is_bottomless(const Scene& scene) {
  constexpr double least = 0.1; // of its normal upwards
  const auto above = up(scene.environment);
  if (!above || scene.environment.bath)
    return false;
  const auto catches = [&](const Solid& solid) {
    const auto* plane = std::get_if<HalfSpace>(&solid.shape);
    return plane != nullptr && plane->normal.dot(*above) > least * plane->normal.norm();
  };
  return std::ranges::none_of(scene.solids, catches) &&
         std::ranges::none_of(scene.outflows, [&](const Outflow& outflow) { return outflow.normal.dot(*above) < 0; });
}

bool nothing_resists_fall(const Scene& scene) {
  return up(scene.environment) && !scene.model.inertia && !scene.environment.bath && !scene.environment.air &&
         scene.holds.empty() && scene.inflows.empty();
}

bool layers_flow(const Scene& scene) {
  return flows_on_solids(scene) || (scene.environment.bath && scene.environment.bath->spreads);
}

bool contacts_adhere(const Scene& scene) { return !scene.contact || scene.contact->adhesion != 0.0; }

} // namespace sheet::scene
