// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/held_whole.h"

#include <algorithm>
#include <cstdint>

#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

std::string held_whole_warning(const Scene& scene, const formats::Frame& first) {
  std::uint64_t for_ever = 0; // bits of holds
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (!scene.holds[i].until && !scene.holds[i].roll)
      for_ever |= std::uint64_t{1} << i;
  const auto held = holds(first);
  if (for_ever == 0 || held.empty() || !scene.inflows.empty() ||
      std::ranges::any_of(scene.sheets, [](const scene::SheetTable& sheet) { return sheet.enters.has_value(); }) ||
      !std::ranges::all_of(held,
                           [&](std::uint64_t bits) { return scene::held_axes(scene, bits & for_ever) == all_axes; }))
    return "";
  return "[[hold]] holds every vertex of the sheet, so none of it can flow: `region` is where it is held, not where it "
         "is free";
}

} // namespace sheet
