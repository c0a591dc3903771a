// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/frame_liquids.h"

#include <algorithm>

#include "libsheet/base/error.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

FrameLiquids::FrameLiquids(const Scene& scene, const formats::Frame& frame) : all_(liquids_of(scene)) {
  if (!several())
    return;
  const formats::Array* array = frame.find("liquid");
  if (array == nullptr)
    fail(ExitCode::bad_input,
         "the scene has {} liquids, and the frame does not say which triangle is of which (array \"liquid\"): make it "
         "with sheet-init",
         all_.size());
  numbers_ = array->values<std::uint32_t>();
  const auto wrong = std::ranges::find_if(numbers_, [&](std::uint32_t number) { return number >= all_.size(); });
  if (wrong != numbers_.end())
    fail(ExitCode::bad_input,
         "triangle {} is of liquid {}, but the scene has only {} (from 0): make the frame anew with sheet-init",
         wrong - numbers_.begin(), *wrong, all_.size());
}

std::vector<std::uint32_t> FrameLiquids::numbers_at_vertices(const formats::Frame& frame) const {
  std::vector<std::uint32_t> numbers(several() ? frame.vertices : 0, 0);
  for (std::size_t t = 0; t < numbers_.size(); ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      numbers[v] = numbers_[t];
  return numbers;
}

bool tells_liquids(const Scene& scene, const formats::Frame& frame) {
  return liquids_of(scene).size() < 2 || frame.find("liquid") != nullptr;
}

void put_liquid(std::size_t number, formats::Frame& frame) {
  formats::Array array = formats::make_standard_array("liquid", frame.triangles);
  std::ranges::fill(array.values<std::uint32_t>(), static_cast<std::uint32_t>(number));
  frame.put(std::move(array));
}

} // namespace sheet::scene
