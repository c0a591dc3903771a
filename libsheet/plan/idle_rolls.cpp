// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/idle_rolls.h"

#include <cstdint>

#include <fmt/format.h>

#include "libsheet/sheet/sheet.h"

namespace sheet {

std::vector<std::string> idle_roll_warnings(const Scene& scene, const formats::Frame& first) {
  std::uint64_t held = 0; // bits of any vertex
  for (const std::uint64_t bits : holds(first))
    held |= bits;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (scene.holds[i].roll && (held >> i & 1) == 0)
      warnings.push_back(fmt::format(
          "[[hold]] number {} (from 0), a roll, draws nothing until something comes to it: no vertex lies in its "
          "region at the start",
          i));
  return warnings;
}

} // namespace sheet
