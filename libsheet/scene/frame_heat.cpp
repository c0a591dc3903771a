// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/frame_heat.h"

#include "libsheet/base/error.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

void check_temperatures(const Scene& scene, const formats::Frame& frame) {
  constexpr double highest = 1e5; // [K]
  if (!scene.heat)
    return;
  const auto temperature = temperatures(frame);
  if (temperature.size() != frame.triangles)
    fail(ExitCode::bad_input, "the scene has [heat], but the frame no temperatures (array \"temperature\"): make the "
                              "first frame with sheet-init");
  for (std::size_t t = 0; t < temperature.size(); ++t)
    if (!(temperature[t] <= highest))
      fail(ExitCode::bad_input, "array \"temperature\", row {}: {:g} K is too warm to compute with; is its unit wrong?",
           t, temperature[t]);
}

} // namespace sheet::scene
