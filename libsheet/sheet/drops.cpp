// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/drops.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

namespace sheet {

namespace {

template <class T, class OfDrop>
void put_column(formats::Frame& frame, std::string_view name, std::span<const Drop> drops, OfDrop of) {
  formats::Array array = formats::make_standard_array(name, drops.size());
  const auto values = array.values<T>();
  for (std::size_t i = 0; i < drops.size(); ++i)
    values[i] = drops[i].*of;
  frame.put(std::move(array));
}

template <class T, class OfDrop>
void take_column(const formats::Frame& frame, std::string_view name, std::span<Drop> drops, OfDrop of) {
  if (const formats::Array* array = frame.find(name))
    for (std::size_t i = 0; i < drops.size(); ++i)
      drops[i].*of = array->values<T>()[i];
}

} // namespace

double Drop::ball_radius(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

bool knows_drops(const formats::Frame& frame) { return frame.find("drop_volume") != nullptr; }

std::vector<Drop> read_drops(const formats::Frame& frame) {
  const formats::Array* volume = frame.find("drop_volume");
  std::vector<Drop> drops(volume == nullptr ? 0 : volume->rows);
  take_column<Vector3>(frame, "drop_position", drops, &Drop::position);
  take_column<Vector3>(frame, "drop_velocity", drops, &Drop::velocity);
  take_column<double>(frame, "drop_volume", drops, &Drop::volume);
  take_column<std::uint32_t>(frame, "drop_liquid", drops, &Drop::liquid);
  take_column<double>(frame, "drop_temperature", drops, &Drop::temperature);
  take_column<std::uint32_t>(frame, "drop_touch", drops, &Drop::touch);
  return drops;
}

void write_drops(formats::Frame& frame, std::span<const Drop> drops) {
  put_column<Vector3>(frame, "drop_position", drops, &Drop::position);
  put_column<Vector3>(frame, "drop_velocity", drops, &Drop::velocity);
  put_column<double>(frame, "drop_volume", drops, &Drop::volume);
  if (frame.find("liquid") != nullptr)
    put_column<std::uint32_t>(frame, "drop_liquid", drops, &Drop::liquid);
  if (frame.find("temperature") != nullptr)
    put_column<double>(frame, "drop_temperature", drops, &Drop::temperature);
  put_column<std::uint32_t>(frame, "drop_touch", drops, &Drop::touch);
  frame.erase("drop_start_position");
}

double volume_of_drops(const formats::Frame& frame) {
  const formats::Array* volume = frame.find("drop_volume");
  if (volume == nullptr)
    return 0;
  const auto values = volume->values<double>();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

} // namespace sheet
