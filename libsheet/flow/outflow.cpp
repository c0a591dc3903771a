// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/outflow.h"

#include <algorithm>

#include "libsheet/flow/drop.h"
#include "libsheet/flow/heat_account.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/drop_densities.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr double close = 0.25; // of a triangle's mean edge: what is not farther inside is not worth a triangle

// Of x from the plane, positive beyond it [m].
double past(const scene::Outflow& o, const Vector3& x) { return o.normal.dot(x - o.point) / o.normal.norm(); }

// Triangles that reach beyond a plane, and at most `inside` of their mean edge to this side.
std::vector<bool> beyond(const Frame& frame, const std::vector<scene::Outflow>& outflows, double inside) {
  const auto x = positions(frame);
  const auto inlet = masks(frame, "inlet");
  std::vector<bool> leaves(frame.triangles, false);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    if (!inlet.empty() && std::ranges::all_of(c, [&](std::uint32_t v) { return inlet[v] != 0; }))
      continue;
    const double edge = ((x[c[1]] - x[c[0]]).norm() + (x[c[2]] - x[c[1]]).norm() + (x[c[0]] - x[c[2]]).norm()) / 3;
    leaves[t] = std::ranges::any_of(outflows, [&](const scene::Outflow& o) {
      const auto d = std::minmax({past(o, x[c[0]]), past(o, x[c[1]]), past(o, x[c[2]])});
      return d.second > 0 && d.first > -inside * edge;
    });
  }
  return leaves;
}

double area_of(const Corners& c, std::span<const Vector3> x) { return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area; }

// The frame's vertices, those beyond a plane back on it, and which those are.
struct PulledBack {
  std::vector<Vector3> positions;
  std::vector<bool> moved;
};
PulledBack pulled_back(const Frame& frame, const std::vector<scene::Outflow>& outflows) {
  const auto old = positions(frame);
  PulledBack result{{old.begin(), old.end()}, std::vector<bool>(old.size(), false)};
  for (const scene::Outflow& o : outflows)
    for (std::size_t v = 0; v < old.size(); ++v)
      if (const double d = past(o, result.positions[v]); d > 0) {
        result.positions[v] -= d * o.normal.normalized();
        result.moved[v] = true;
      }
  return result;
}

// Adds the triangles at vertices that cannot go back to the plane: of each triangle that would turn over, the vertex
// that would go farthest.
void add_overturned(const Frame& frame, const std::vector<scene::Outflow>& outflows, std::vector<bool>& leaves) {
  const auto old = positions(frame);
  const std::vector<Vector3> x = pulled_back(frame, outflows).positions;
  std::vector<bool> leaving(old.size(), false);
  for (std::size_t t = 0; t < leaves.size(); ++t) {
    const Corners& c = triangles(frame)[t];
    const Vector3 before = TriangleArea(old[c[0]], old[c[1]], old[c[2]]).normal;
    if (!leaves[t] && before.dot(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal) < 0)
      leaving[*std::ranges::max_element(c, {}, [&](std::uint32_t v) { return (x[v] - old[v]).squaredNorm(); })] = true;
  }
  for (std::size_t t = 0; t < leaves.size(); ++t)
    leaves[t] = leaves[t] || std::ranges::any_of(triangles(frame)[t], [&](std::uint32_t v) { return leaving[v]; });
}

// Vertices that are still beyond a plane go back to it; triangles lose volume with their area.
Dropped pull_back(Frame& frame, const Scene& scene) {
  const auto old = positions(static_cast<const Frame&>(frame));
  const auto [x, moved] = pulled_back(frame, scene.outflows);
  Frame gone = frame; // with the volumes that leave
  std::vector<bool> loses(frame.triangles, false);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(static_cast<const Frame&>(frame))[t];
    const double part = area_of(c, x) / area_of(c, old);
    if (!(moved[c[0]] || moved[c[1]] || moved[c[2]]) || part >= 1)
      continue;
    loses[t] = true;
    volumes(gone)[t] = (1 - part) * volumes(frame)[t];
    volumes(frame)[t] -= volumes(gone)[t];
  }
  std::ranges::copy(x, positions(frame).begin());
  return sum_of(gone, loses, scene);
}

Dropped let_triangles_out(Frame& frame, const Scene& scene) {
  const auto x = positions(static_cast<const Frame&>(frame));
  if (std::ranges::none_of(x, [&](const Vector3& at) {
        return std::ranges::any_of(scene.outflows, [&](const scene::Outflow& o) { return past(o, at) > 0; });
      }))
    return {};
  // Where the sheet must not pass through itself nothing is moved: layers that lie on each other would.
  const bool straight = !(scene.contact && scene.contact->self);
  std::vector<bool> leaves = beyond(frame, scene.outflows, straight ? close : 0);
  if (straight)
    add_overturned(frame, scene.outflows, leaves);
  Dropped out = sum_of(frame, leaves, scene);
  if (out.triangles > 0)
    out = drop(frame, leaves, scene);
  const Dropped cut = straight ? pull_back(frame, scene) : Dropped{};
  if (out.triangles == 0 && cut.volume == 0)
    return {};
  out.volume += cut.volume;
  out.momentum += cut.momentum;
  out.energy += cut.energy;
  out.warmth += cut.warmth;
  return out;
}

// Those whose middles are beyond.
Dropped let_drops_out(Frame& frame, const Scene& scene) {
  Dropped out;
  const std::vector<Drop> drops = read_drops(frame);
  const std::vector<double> densities = scene::densities_of(drops, scene);
  std::vector<Drop> left;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Drop& drop = drops[i];
    if (std::ranges::none_of(scene.outflows, [&](const scene::Outflow& o) { return past(o, drop.position) > 0; })) {
      left.push_back(drop);
      continue;
    }
    const double density = densities[i];
    out.volume += drop.volume;
    out.momentum += density * drop.volume * drop.velocity;
    out.energy += density * drop.volume / 2 * drop.velocity.squaredNorm();
    if (scene.heat && scene.material.density > 0)
      out.warmth += density / scene.material.density * drop.volume * drop.temperature;
  }
  if (left.size() < drops.size())
    write_drops(frame, left);
  return out;
}

} // namespace

Dropped let_out(Frame& frame, const Scene& scene) {
  Dropped out = let_triangles_out(frame, scene);
  const Dropped drops = let_drops_out(frame, scene);
  out.volume += drops.volume;
  out.momentum += drops.momentum;
  out.energy += drops.energy;
  out.warmth += drops.warmth;
  if (out.volume == 0)
    return out;
  add_to_account(frame, "outflow.volume", "m^3", {&out.volume, 1});
  add_to_account(frame, "outflow.momentum", "kg*m/s", {out.momentum.data(), 3});
  add_to_account(frame, "outflow.energy", "J", {&out.energy, 1});
  add_heat_to_account(frame, "outflow.heat", scene, out.warmth);
  return out;
}

} // namespace sheet::flow
