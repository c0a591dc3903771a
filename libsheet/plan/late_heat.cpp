// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/late_heat.h"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/scales.h"

namespace sheet {

std::string late_heat_warning(const Scene& scene, const formats::Frame& first, double until) {
  constexpr double late = 10, much_later = 1000; // times the run
  constexpr double as_good_as_at_start = 1.5;    // factor of the viscosity
  if (!scene.heat || !scene.inflows.empty() ||
      std::ranges::all_of(scene::liquids_of(scene), [](const Liquid& l) { return l.temperature_law.constant(); }))
    return "";
  double least = std::numeric_limits<double>::infinity();
  const Scene as_it_starts = scene::as_it_starts(scene);
  for (const scene::Scales& scales : scene::scales_of_sheets(as_it_starts, measured_sheets(as_it_starts, first)))
    for (const scene::Scale& scale : scene::heat_scales(scene, scales))
      least = std::min(least, scale.value);
  if (!(least > late * until && least < much_later * until) ||
      scene::change_of_viscosity(scene, least, until) > as_good_as_at_start)
    return "";
  const double about = std::stod(fmt::format("{:.2g}", least));
  return fmt::format(
      "the run ends, at {} s, before heat changes how it flows, as cooling and warming take some {:.10g} "
      "s: --until {:.10g} shows that",
      until, about, about);
}

} // namespace sheet
