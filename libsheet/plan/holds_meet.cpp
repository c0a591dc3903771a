// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/holds_meet.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <variant>

#include "libsheet/geometry/axes.h"
#include "libsheet/geometry/box.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

bool moves_straight(const scene::Hold& hold) {
  return !hold.roll && !hold.until &&
         (std::holds_alternative<scene::Fixed>(hold.motion) || std::holds_alternative<scene::Translating>(hold.motion));
}

Box held_by(const formats::Frame& first, std::size_t hold) {
  const auto x = positions(first);
  const std::span<const std::uint64_t> held = holds(first);
  Box box;
  for (std::size_t v = 0; v < held.size(); ++v)
    if ((held[v] >> hold & 1) != 0)
      box.add(x[v]);
  return box;
}

// Between two boxes along the axes that both hold; 0 where there are none [m].
double apart(const Box& a, const Box& b, Axes axes, const Vector3& a_moved, const Vector3& b_moved) {
  Vector3 gap = (a.low + a_moved - b.high - b_moved).cwiseMax(b.low + b_moved - a.high - a_moved).cwiseMax(0.0);
  for (int i = 0; i < 3; ++i)
    if (!has_axis(axes, i))
      gap[i] = 0;
  return gap.norm();
}

} // namespace

std::optional<HoldsMeet> holds_meet(const Scene& scene, const formats::Frame& first, double until) {
  constexpr int times = 1000;
  const double thickness = measured(first).thickness.value_or(0);
  std::optional<HoldsMeet> meet;
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    for (std::size_t j = i + 1; j < scene.holds.size(); ++j) {
      const scene::Hold &one = scene.holds[i], &other = scene.holds[j];
      if (!moves_straight(one) || !moves_straight(other))
        continue;
      const Box a = held_by(first, i), b = held_by(first, j);
      const auto apart_at = [&](double t) {
        return apart(a, b, static_cast<Axes>(one.axes & other.axes),
                     scene::motion_between(one.motion, first.time, t).translation(),
                     scene::motion_between(other.motion, first.time, t).translation());
      };
      if (a.empty() || b.empty() || apart_at(first.time) <= 2 * thickness)
        continue;
      for (int k = 1; k <= times; ++k)
        if (const double t = first.time + (until - first.time) * k / times; apart_at(t) <= thickness) {
          if (!meet || t < meet->time)
            meet = HoldsMeet{i, j, t};
          break;
        }
    }
  return meet;
}

} // namespace sheet
