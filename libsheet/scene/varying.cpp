// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/varying.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/overloaded.h"

namespace sheet::scene {

double value_at(const PlaceRows& rows, double place) {
  const auto after = std::ranges::upper_bound(rows, place, {}, [](const auto& row) { return row[0]; });
  if (after == rows.begin())
    return rows.front()[1];
  if (after == rows.end())
    return rows.back()[1];
  const auto before = after - 1;
  return std::lerp((*before)[1], (*after)[1], (place - (*before)[0]) / ((*after)[0] - (*before)[0]));
}

double value_at(const Varying& varying, double t, const Eigen::Vector3d& x) {
  return std::visit(Overloaded{[&](const Timed<double>& timed) { return value_at(timed, t); },
                               [&](const AlongAxis& along) { return value_at(along.rows, x[along.axis]); }},
                    varying.over);
}

bool is_constant(const Varying& varying) {
  const auto* timed = std::get_if<Timed<double>>(&varying.over);
  return timed != nullptr && timed->entries.size() == 1;
}

std::pair<double, double> range_of(const Varying& varying) {
  return std::visit(Overloaded{[](const Timed<double>& timed) {
                                 const auto [least, most] =
                                     std::ranges::minmax(timed.entries, {}, &Timed<double>::Entry::value);
                                 return std::pair(least.value, most.value);
                               },
                               [](const AlongAxis& along) {
                                 const auto [least, most] =
                                     std::ranges::minmax(along.rows, {}, [](const auto& row) { return row[1]; });
                                 return std::pair(least[1], most[1]);
                               }},
                    varying.over);
}

} // namespace sheet::scene
