// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/enclosures.h"

#include <algorithm>

#include "libsheet/base/error.h"

namespace sheet {

using formats::Array;
using formats::Place;
using formats::Type;

std::span<const std::uint32_t> enclosures(const formats::Frame& frame) {
  const Array* array = frame.find("enclosure");
  if (array == nullptr)
    return {};
  if (array->place != Place::triangle || array->type != Type::uint32 || array->components != 1)
    fail(ExitCode::bad_input, "array \"enclosure\" must have one uint32 a triangle: make it with sheet-init");
  return array->values<std::uint32_t>();
}

void put_enclosures(std::span<const std::uint32_t> numbers, formats::Frame& frame) {
  Array array =
      formats::make_array("enclosure", Place::triangle, Type::uint32, 1, "1", formats::Transfer::copy, frame.triangles);
  std::ranges::copy(numbers, array.values<std::uint32_t>().begin());
  frame.put(std::move(array));
}

std::uint32_t last_enclosure(const formats::Frame& frame) {
  const auto numbers = enclosures(frame);
  return numbers.empty() ? 0 : *std::ranges::max_element(numbers);
}

std::vector<std::uint32_t> enclosure_numbers(const formats::Frame& frame) {
  const auto all = enclosures(frame);
  std::vector<std::uint32_t> numbers(all.begin(), all.end());
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::erase(numbers, 0);
  return numbers;
}

std::span<const double> of_enclosures(const formats::Frame& frame, std::string_view name) {
  const Array* array = frame.find(name);
  if (array == nullptr)
    return {};
  if (array->place != Place::frame || array->type != Type::float64 || array->components != 1)
    fail(ExitCode::bad_input, "array \"{}\" must be frame float64, a row for each enclosure of gas; rename yours",
         name);
  return array->values<double>();
}

} // namespace sheet
