// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/sheet.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "libsheet/base/error.h"

namespace sheet {

using formats::Array;
using formats::Frame;
using formats::Place;
using formats::Transfer;
using formats::Type;

namespace {

constexpr std::size_t word_bits = 64;

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
  fill(frame.put(formats::make_standard_array("position", positions.size())), positions);
  fill(frame.put(formats::make_standard_array("triangle", triangles.size())), triangles);
  fill(frame.put(formats::make_standard_array("volume", volumes.size())), volumes);
  return frame;
}

std::span<Eigen::Vector3d> positions(Frame& frame) { return required(frame, "position").values<Eigen::Vector3d>(); }
std::span<const Eigen::Vector3d> positions(const Frame& frame) {
  return required(frame, "position").values<Eigen::Vector3d>();
}
std::span<const Corners> triangles(const Frame& frame) { return required(frame, "triangle").values<Corners>(); }
std::span<double> volumes(Frame& frame) { return required(frame, "volume").values<double>(); }
std::span<const double> volumes(const Frame& frame) { return required(frame, "volume").values<double>(); }

std::span<const double> temperatures(const Frame& frame) {
  const Array* array = frame.find("temperature");
  return array == nullptr ? std::span<const double>{} : array->values<double>();
}

void put_temperatures(std::span<const double> temperatures, Frame& frame) {
  fill(frame.put(formats::make_standard_array("temperature", temperatures.size())), temperatures);
}

std::span<Eigen::Vector3d> velocities(Frame& frame) {
  Array* array = frame.find("velocity");
  if (array == nullptr)
    array = &frame.put(formats::make_standard_array("velocity", frame.vertices));
  return array->values<Eigen::Vector3d>();
}

std::span<const Eigen::Vector3d> velocities(const Frame& frame) {
  const Array* array = frame.find("velocity");
  return array == nullptr ? std::span<const Eigen::Vector3d>() : array->values<Eigen::Vector3d>();
}

std::span<const std::uint64_t> masks(const Frame& frame, std::string_view name) {
  const Array* array = frame.find(name);
  if (array == nullptr)
    return {};
  if (array->place != formats::Place::vertex || array->type != formats::Type::uint64)
    fail(ExitCode::bad_input, "array \"{}\" must be vertex uint64; rename yours", name);
  return array->values<std::uint64_t>();
}

std::span<std::uint64_t> put_masks(Frame& frame, std::string_view name) {
  return frame.put(formats::make_standard_array(name, frame.vertices)).values<std::uint64_t>();
}

std::vector<std::int32_t> touched_solids(const Frame& frame, std::size_t solids) {
  std::vector<std::int32_t> touched(frame.vertices, no_solid);
  const Array* array = frame.find("touch");
  if (array == nullptr)
    return touched;
  const auto words = array->values<std::uint64_t>();
  for (std::size_t i = words.size(); i-- > 0;) { // from the last word, so that the first solid counts
    const std::size_t solid = i % array->components * word_bits + static_cast<std::size_t>(std::countr_zero(words[i]));
    if (words[i] != 0 && solid < solids)
      touched[i / array->components] = static_cast<std::int32_t>(solid);
  }
  return touched;
}

std::vector<std::int32_t> touched_solids(const Frame& frame) {
  return touched_solids(frame, std::numeric_limits<std::int32_t>::max());
}

void put_touched_solids(Frame& frame, std::span<const std::int32_t> touch, std::size_t solids) {
  const std::size_t count = std::max<std::size_t>(1, (solids + word_bits - 1) / word_bits);
  const auto words = frame.put(formats::make_standard_array("touch", frame.vertices, static_cast<std::uint32_t>(count)))
                         .values<std::uint64_t>();
  for (std::size_t v = 0; v < touch.size(); ++v)
    if (touch[v] != no_solid) {
      const auto solid = static_cast<std::size_t>(touch[v]);
      words[v * count + solid / word_bits] = std::uint64_t{1} << solid % word_bits;
    }
}

namespace {

void put_value(Frame& frame, Array array, double value) {
  array.values<double>()[0] = value;
  frame.put(std::move(array));
}

} // namespace

void put_number(Frame& frame, std::string_view name, double value) {
  put_value(frame, formats::make_standard_array(name, 1), value);
}

void put_number(Frame& frame, std::string_view name, std::string_view unit, double value) {
  put_value(frame, formats::make_array(name, Place::frame, Type::float64, 1, unit, Transfer::copy, 1), value);
}

double number(const Frame& frame, std::string_view name, double otherwise) {
  const Array* array = frame.find(name);
  if (array == nullptr)
    return otherwise;
  if (array->place != Place::frame || array->type != Type::float64 || array->rows == 0)
    fail(ExitCode::bad_input, "array \"{}\" must have a float64 of the frame", name);
  return array->values<double>()[0];
}

} // namespace sheet
