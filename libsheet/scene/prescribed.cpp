// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/prescribed.h"

#include <bit>

#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

std::uint64_t holds_in_force(const Scene& scene, double t) {
  std::uint64_t counting = ~std::uint64_t{0};
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (!in_force(scene.holds[i], t))
      counting &= ~(std::uint64_t{1} << i);
  return counting;
}

Axes held_axes(const Scene& scene, std::uint64_t holds) {
  Axes axes = 0;
  for (; holds != 0; holds &= holds - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(holds));
    axes |= i < scene.holds.size() ? scene.holds[i].axes : all_axes;
  }
  return axes;
}

std::vector<Axes> prescribed_axes(const formats::Frame& frame, const Scene& scene, double t) {
  std::vector<Axes> axes(frame.vertices, 0);
  const std::uint64_t counting = holds_in_force(scene, t);
  const auto hold = holds(frame);
  for (std::size_t v = 0; v < hold.size(); ++v)
    axes[v] = held_axes(scene, hold[v] & counting);
  const auto inlet = masks(frame, "inlet");
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    for (std::size_t v = 0; in_force(scene.inflows[i], t) && v < inlet.size(); ++v)
      if ((of_inlet(inlet[v], i) & in_inlet) != 0)
        axes[v] = all_axes;
  return axes;
}

} // namespace sheet::scene
