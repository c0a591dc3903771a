// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/entering.h"

#include <algorithm>
#include <numeric>

#include "libsheet/base/error.h"
#include "libsheet/flow/heat_account.h"
#include "libsheet/scene/frame_heat.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

// Numbers of the sheets that enter, in their order.
std::vector<std::size_t> order_of_entry(const Scene& scene) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (scene.sheets[i].enters)
      order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return *scene.sheets[i].enters; });
  return order;
}

// How many of them have entered.
std::size_t entered(const Frame& frame, const std::vector<std::size_t>& order) {
  const double count = number(frame, "entered", 0);
  if (!(count >= 0))
    fail(ExitCode::bad_input, "array \"entered\" counts the sheets that have entered: {} is no count", count);
  return static_cast<std::size_t>(std::min(count, static_cast<double>(order.size())));
}

} // namespace

bool has_entered(const Scene& scene, const std::string& name, const Frame& frame) {
  const std::vector<std::size_t> order = order_of_entry(scene);
  const auto at = std::ranges::find_if(order, [&](std::size_t i) { return scene.sheets[i].name == name; });
  return at == order.end() || static_cast<std::size_t>(at - order.begin()) < entered(frame, order);
}

double let_enter(Frame& frame, const Scene& scene) {
  scene::check_temperatures(scene, frame);
  const std::vector<std::size_t> order = order_of_entry(scene);
  double volume = 0, warmth = 0;
  std::size_t count = entered(frame, order);
  for (; count < order.size() && frame.time >= *scene.sheets[order[count]].enters; ++count) {
    const Frame sheet = build_sheet(scene, order[count]);
    append_sheet(sheet, frame);
    const auto volumes = sheet::volumes(sheet);
    volume += std::accumulate(volumes.begin(), volumes.end(), 0.0);
    const auto temperatures = sheet::temperatures(sheet);
    const double weight = FrameLiquids(scene, sheet).relative_density(0);
    warmth += weight * std::inner_product(temperatures.begin(), temperatures.end(), volumes.begin(), 0.0);
  }
  if (volume > 0) {
    put_number(frame, "entered", "1", static_cast<double>(count));
    add_to_account(frame, "emit.volume", "m^3", {&volume, 1});
    add_heat_to_account(frame, "emit.heat", scene, warmth);
  }
  return volume;
}

} // namespace sheet::flow
