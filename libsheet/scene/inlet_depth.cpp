// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/inlet_depth.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/error.h"

namespace sheet::scene {

namespace {

constexpr std::string_view depth_array = "emit.depth";
constexpr std::string_view profile_array = "emit.border_depth"; // means nothing off the border

} // namespace

double inlet_depth(const formats::Frame& frame, const Scene& scene, std::size_t number) {
  const double thickness = scene.inflows[number].thickness;
  const formats::Array* array = frame.find(depth_array);
  if (array == nullptr)
    return thickness;
  if (array->place != formats::Place::frame || array->type != formats::Type::float64 || array->components != 1 ||
      array->rows != scene.inflows.size())
    fail(ExitCode::bad_input, "array \"{}\" must be frame[{}] float64, a row for each [inflow]", depth_array,
         scene.inflows.size());
  const double depth = array->values<double>()[number];
  if (!std::isfinite(depth))
    fail(ExitCode::bad_input, "array \"{}\", row {}: {} is no depth", depth_array, number, depth);
  return std::max(thickness, depth);
}

std::vector<double> inlet_depths(const formats::Frame& frame, const Scene& scene, std::size_t number,
                                 std::span<const std::uint32_t> border) {
  const double thickness = scene.inflows[number].thickness;
  const formats::Array* array = frame.find(profile_array);
  if (array == nullptr)
    return std::vector<double>(border.size(), thickness);
  if (array->place != formats::Place::vertex || array->type != formats::Type::float64 || array->components != 1)
    fail(ExitCode::bad_input, "array \"{}\" must be vertex float64", profile_array);
  std::vector<double> depths;
  for (const std::uint32_t v : border) {
    const double depth = array->values<double>()[v];
    if (!std::isfinite(depth))
      fail(ExitCode::bad_input, "array \"{}\", vertex {}: {} is no depth", profile_array, v, depth);
    depths.push_back(std::max(thickness, depth));
  }
  return depths;
}

InletVelocity inlet_velocity(const formats::Frame& frame, const Scene& scene, std::size_t number) {
  const Inflow& inflow = scene.inflows[number];
  const double depth = inlet_depth(frame, scene, number);
  InletVelocity velocity = inlet_velocity(scene, inflow);
  if (depth > inflow.thickness) {
    for (auto& entry : velocity.common.entries)
      entry.value *= inflow.thickness / depth;
    for (auto& entry : velocity.radial.entries)
      entry.value *= inflow.thickness / depth;
  }
  return velocity;
}

void put_inlet_depth(formats::Frame& frame, const Scene& scene, std::size_t number, double depth) {
  if (frame.find(depth_array) == nullptr) {
    if (!(depth > scene.inflows[number].thickness))
      return;
    formats::Array& array =
        frame.put(formats::make_array(depth_array, formats::Place::frame, formats::Type::float64, 1, "m",
                                      formats::Transfer::copy, static_cast<std::uint32_t>(scene.inflows.size())));
    std::ranges::transform(scene.inflows, array.values<double>().begin(), &Inflow::thickness);
  }
  frame.find(depth_array)->values<double>()[number] = std::max(depth, scene.inflows[number].thickness);
}

void put_inlet_depths(formats::Frame& frame, const Scene& scene, std::size_t number,
                      std::span<const std::uint32_t> border, std::span<const double> depths) {
  const double thickness = scene.inflows[number].thickness;
  if (frame.find(profile_array) == nullptr) {
    if (std::ranges::none_of(depths, [&](double depth) { return depth > thickness; }))
      return;
    frame.put(formats::make_array(profile_array, formats::Place::vertex, formats::Type::float64, 1, "m",
                                  formats::Transfer::interpolate, frame.vertices));
  }
  const auto profile = frame.find(profile_array)->values<double>();
  for (std::size_t i = 0; i < border.size(); ++i)
    profile[border[i]] = std::max(depths[i], thickness);
}

void erase_inlet_depths(formats::Frame& frame) {
  frame.erase(depth_array);
  frame.erase(profile_array);
}

} // namespace sheet::scene
