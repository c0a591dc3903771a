// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/rolls.h"

#include <algorithm>

#include "libsheet/base/overloaded.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

namespace {

// Signed distance, negative inside [m].
double outside(const Region& region, const Vector3& x) {
  return std::visit(Overloaded{[](Border) { return 0.0; }, // which a roll never has, nor an array
                               [](const ArrayRegion&) { return 0.0; },
                               [&](const BoxRegion& box) {
                                 const Vector3 d = (x - box.high).cwiseMax(box.low - x);
                                 return d.cwiseMax(0).norm() + std::min(0.0, d.maxCoeff());
                               },
                               [&](const SphereRegion& s) { return (x - s.center).norm() - s.radius; }},
                    region);
}

std::vector<double> mean_edges(const formats::Frame& frame) {
  const auto x = positions(frame);
  std::vector<double> length(frame.vertices, 0), count(frame.vertices, 0);
  for (const Corners& c : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i) {
      const double edge = (x[c[(i + 1) % 3]] - x[c[i]]).norm();
      for (const std::uint32_t v : {c[i], c[(i + 1) % 3]}) {
        length[v] += edge;
        ++count[v];
      }
    }
  for (std::size_t v = 0; v < length.size(); ++v)
    length[v] /= std::max(1.0, count[v]);
  return length;
}

} // namespace

bool wants_forces(const Scene& scene) { return scene.model.forces || has_rolls(scene); }

bool has_rolls(const Scene& scene) { return std::ranges::any_of(scene.holds, &Hold::roll); }

void follow_rolls(const Scene& scene, formats::Frame& frame) {
  if (!has_rolls(scene))
    return;
  const std::vector<double> edges = mean_edges(frame);
  const auto bits =
      frame.find("hold") != nullptr ? frame.find("hold")->values<std::uint64_t>() : put_masks(frame, "hold");
  const auto x = positions(frame);
  for (std::size_t i = 0; i < scene.holds.size(); ++i) {
    const Hold& roll = scene.holds[i];
    if (!roll.roll || !in_force(roll, frame.time))
      continue;
    for (std::size_t v = 0; v < bits.size(); ++v) {
      const std::uint64_t bit = std::uint64_t{1} << i;
      bits[v] = outside(roll.region, x[v]) < 0.5 * edges[v] ? bits[v] | bit : bits[v] & ~bit;
    }
  }
}

} // namespace sheet::scene
