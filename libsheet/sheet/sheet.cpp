// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/sheet.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace sheet {

using formats::Array;
using formats::Frame;
using formats::Place;
using formats::Transfer;
using formats::Type;

namespace {

const Array& required(const Frame& frame, std::string_view name) {
  const Array* array = frame.find(name);
  if (array == nullptr)
    throw std::logic_error("array \"" + std::string(name) + "\" is missing: the reader must have let it pass");
  return *array;
}

Array& required(Frame& frame, std::string_view name) {
  return const_cast<Array&>(required(static_cast<const Frame&>(frame), name));
}

template <class T> void fill(Array& array, std::span<const T> values) {
  if (!values.empty())
    std::memcpy(array.data.data(), values.data(), values.size_bytes());
}

} // namespace

Frame make_frame(std::span<const Eigen::Vector3d> positions, std::span<const Corners> triangles,
                 std::span<const double> volumes) {
  Frame frame;
  frame.vertices = positions.size();
  frame.triangles = triangles.size();
  fill(frame.put(formats::make_array("position", Place::vertex, Type::float64, 3, "m", Transfer::interpolate,
                                     positions.size())),
       positions);
  fill(frame.put(
           formats::make_array("triangle", Place::triangle, Type::uint32, 3, "1", Transfer::drop, triangles.size())),
       triangles);
  fill(frame.put(
           formats::make_array("volume", Place::triangle, Type::float64, 1, "m^3", Transfer::conserve, volumes.size())),
       volumes);
  return frame;
}

std::span<Eigen::Vector3d> positions(Frame& frame) { return required(frame, "position").values<Eigen::Vector3d>(); }
std::span<const Eigen::Vector3d> positions(const Frame& frame) {
  return required(frame, "position").values<Eigen::Vector3d>();
}
std::span<const Corners> triangles(const Frame& frame) { return required(frame, "triangle").values<Corners>(); }
std::span<double> volumes(Frame& frame) { return required(frame, "volume").values<double>(); }
std::span<const double> volumes(const Frame& frame) { return required(frame, "volume").values<double>(); }

std::span<Eigen::Vector3d> velocities(Frame& frame) {
  Array* array = frame.find("velocity");
  if (array == nullptr) {
    array = &frame.put(
        formats::make_array("velocity", Place::vertex, Type::float64, 3, "m/s", Transfer::interpolate, frame.vertices));
    for (Eigen::Vector3d& v : array->values<Eigen::Vector3d>())
      v.setZero();
  }
  return array->values<Eigen::Vector3d>();
}

std::span<const Eigen::Vector3d> velocities(const Frame& frame) {
  const Array* array = frame.find("velocity");
  return array == nullptr ? std::span<const Eigen::Vector3d>() : array->values<Eigen::Vector3d>();
}

std::span<const std::uint64_t> masks(const Frame& frame, std::string_view name) {
  const Array* array = frame.find(name);
  return array == nullptr ? std::span<const std::uint64_t>() : array->values<std::uint64_t>();
}

std::span<std::uint64_t> put_masks(Frame& frame, std::string_view name) {
  const auto bits =
      frame.put(formats::make_array(name, Place::vertex, Type::uint64, 1, "1", Transfer::common, frame.vertices))
          .values<std::uint64_t>();
  std::fill(bits.begin(), bits.end(), 0);
  return bits;
}

void put_number(Frame& frame, std::string_view name, std::string_view unit, double value) {
  Array array = formats::make_array(name, Place::frame, Type::float64, 1, unit, Transfer::copy, 1);
  array.values<double>()[0] = value;
  frame.put(std::move(array));
}

double number(const Frame& frame, std::string_view name, double otherwise) {
  const Array* array = frame.find(name);
  return array == nullptr ? otherwise : array->values<double>()[0];
}

} // namespace sheet
