// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/drops_at_once.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "libsheet/flow/entering.h"
#include "libsheet/flow/shed.h"
#include "libsheet/scene/brief.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;

// With all that enter later, each where it starts.
Frame with_later_sheets(const Scene& scene, const Frame& first) {
  Frame all = first;
  for (const scene::SheetTable& sheet : scene.sheets)
    all.time = std::max(all.time, sheet.enters.value_or(0));
  if (all.time > first.time)
    flow::let_enter(all, scene);
  return all;
}

// In the mean [m].
double edge_of(const Frame& frame, const std::vector<std::uint32_t>& piece) {
  const auto x = positions(frame);
  double length = 0;
  for (const std::uint32_t t : piece)
    for (std::size_t k = 0; k < 3; ++k)
      length += (x[triangles(frame)[t][(k + 1) % 3]] - x[triangles(frame)[t][k]]).norm();
  return length / (3 * static_cast<double>(piece.size()));
}

} // namespace

std::string drops_at_once_warning(const Scene& scene, const Frame& first) {
  if (!scene.tear || !scene.tear->drops)
    return {};
  const Frame all = with_later_sheets(scene, first);
  const auto pieces = flow::round_pieces(all, scene);
  if (pieces.empty())
    return {};
  constexpr double enough = 150; // triangles: half as many again as a drop may have, as sheet-remesh changes them, too
  const Vector3 place = positions(all)[triangles(all)[pieces[0][0]][0]];
  const double longest = edge_of(all, pieces[0]) * std::sqrt(static_cast<double>(pieces[0].size()) / enough);
  return fmt::format(
      "what starts at ({}, {}, {}) m{} is a ball from the first step on: [tear] drops takes free pieces of "
      "fewer than 100 triangles for drops that are at most some 40 times as wide as they are thick, and "
      "it has {}; edges of {} m or less keep it a sheet",
      scene::brief(place.x()), scene::brief(place.y()), scene::brief(place.z()),
      pieces.size() > 1 ? fmt::format(", and {} more,", pieces.size() - 1) : "", pieces[0].size(),
      scene::brief(longest));
}

} // namespace sheet
