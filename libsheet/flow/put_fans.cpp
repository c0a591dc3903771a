// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/put_fans.h"

#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/carried_springs.h"
#include "libsheet/sheet/directors.h"
#include "libsheet/sheet/transfer.h"

namespace sheet::flow {

using formats::Frame;

namespace {

// For each new vertex the volume of a third of its triangles [m³].
std::vector<double> carried(const Fans& fans, std::span<const double> volumes) {
  return vertex_shares(fans.old_vertex.size(), fans.triangles, [&](std::uint32_t t) { return volumes[t]; });
}

// Vertices, as they were numbered before and behind a cut, that have a triangle left or never had one; each one's
// number in the new frame, no_index for the others.
std::vector<std::uint32_t> numbers_of(const Fans& fans, const std::vector<bool>& dropped) {
  std::vector<bool> stays(fans.old_vertex.size(), false);
  for (std::size_t v = 0; v < fans.fan_count.size(); ++v)
    stays[v] = fans.fan_count[v] == 0;
  for (std::size_t t = 0; t < fans.triangles.size(); ++t)
    for (const std::uint32_t v : fans.triangles[t])
      stays[v] = stays[v] || !dropped[t];
  std::vector<std::uint32_t> numbers(stays.size(), no_index);
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < stays.size(); ++v)
    if (stays[v])
      numbers[v] = next++;
  return numbers;
}

// Each fan of a vertex gets its part of what the old vertex carried, by volume.
Lineage vertex_lineage(const Fans& fans, std::span<const double> volumes, const std::vector<std::uint32_t>& numbers) {
  const std::vector<double> part = carried(fans, volumes);
  std::vector<double> whole(fans.fan_count.size(), 0), left(fans.fan_count.size(), 1);
  std::vector<std::uint32_t> to_come = fans.fan_count;
  for (std::size_t v = 0; v < part.size(); ++v)
    whole[fans.old_vertex[v]] += part[v];
  Lineage lineage;
  for (std::size_t v = 0; v < part.size(); ++v) {
    const std::uint32_t old = fans.old_vertex[v];
    const bool last = to_come[old] <= 1; // takes the remainder
    const double share = last ? left[old] : part[v] / whole[old];
    left[old] -= share;
    if (to_come[old] > 0)
      --to_come[old];
    const Parent parent{old, 1, share};
    if (numbers[v] != no_index)
      lineage.add({&parent, 1});
  }
  return lineage;
}

} // namespace

void put_fans(Frame& frame, const Fans& fans, const std::vector<bool>& dropped, std::span<const Vector3> opened) {
  const std::vector<std::uint32_t> numbers = numbers_of(fans, dropped);
  const Lineage vertices = vertex_lineage(fans, volumes(static_cast<const Frame&>(frame)), numbers);
  Lineage kept;
  std::vector<Corners> corners;
  for (std::uint32_t t = 0; t < fans.triangles.size(); ++t) {
    if (dropped[t])
      continue;
    kept.keep(t);
    const Corners& c = fans.triangles[t];
    corners.push_back({numbers[c[0]], numbers[c[1]], numbers[c[2]]});
  }
  const Directors directors(frame);
  transfer_frame(frame, vertices, kept, corners);
  const CarriedSprings springs(frame);
  const auto x = positions(frame);
  for (std::size_t v = 0; v < numbers.size(); ++v)
    if (numbers[v] != no_index)
      x[numbers[v]] = opened[v];
  springs.put(frame);
  directors.put(vertices, frame);
}

Dropped sum_of(const Frame& frame, const std::vector<bool>& dropped, const Scene& scene) {
  Dropped sum;
  const FrameLiquids liquids(scene, frame);
  const auto v = velocities(frame);
  const auto volume = volumes(frame), temperature = temperatures(frame);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    if (!dropped[t])
      continue;
    ++sum.triangles;
    sum.volume += volume[t];
    if (!temperature.empty())
      sum.warmth += liquids.relative_density(t) * volume[t] * temperature[t];
    const double density = liquids.density(t);
    for (const std::uint32_t c : triangles(frame)[t])
      if (!v.empty()) {
        sum.momentum += density * volume[t] / 3 * v[c];
        sum.energy += density * volume[t] / 6 * v[c].squaredNorm();
      }
  }
  return sum;
}

} // namespace sheet::flow
