// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/overshoot.h"

#include <algorithm>
#include <utility>

#include "libsheet/sheet/sheet.h"

namespace sheet {

using formats::Array;
using formats::Frame;

namespace {

double time_after_step(const Frame& frame) {
  return time_to_make_up * (frame.time - number(frame, "start_time", frame.time));
}

} // namespace

std::vector<Overshoot> overshoots(const Frame& frame) {
  const Array *ways = frame.find("touch_overshoot"), *times = frame.find("touch_overshoot_time");
  if (ways == nullptr)
    return {};
  std::vector<Overshoot> result(frame.vertices);
  const double after_step = time_after_step(frame);
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = {ways->values<Vector3>()[v], times != nullptr ? times->values<double>()[v] : after_step};
  return result;
}

void put_overshoots(std::span<const Overshoot> overshoots, Frame& frame) {
  frame.erase("touch_overshoot");
  frame.erase("touch_overshoot_time");
  const auto counts = [](const Overshoot& o) { return !o.way.isZero(0); };
  if (std::ranges::none_of(overshoots, counts))
    return;
  Array ways = formats::make_standard_array("touch_overshoot", frame.vertices);
  std::ranges::transform(overshoots, ways.values<Vector3>().begin(), &Overshoot::way);
  frame.put(std::move(ways));
  const double after_step = time_after_step(frame);
  if (std::ranges::all_of(overshoots, [&](const Overshoot& o) { return !counts(o) || o.time == after_step; }))
    return;
  Array times = formats::make_standard_array("touch_overshoot_time", frame.vertices);
  std::ranges::transform(overshoots, times.values<double>().begin(), &Overshoot::time);
  frame.put(std::move(times));
}

} // namespace sheet
