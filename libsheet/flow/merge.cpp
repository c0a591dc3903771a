// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/merge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/flow/deposit.h"
#include "libsheet/flow/lift.h"
#include "libsheet/flow/merge_patches.h"
#include "libsheet/flow/put_fans.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/material/shifted_liquid.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/account.h"
#include "libsheet/sheet/carried_springs.h"

namespace sheet::flow {

using formats::Frame;

namespace {

bool has_contacts(const Frame& frame) {
  const formats::Array* contacts = frame.find("contact_vertex");
  return contacts != nullptr && contacts->rows > 0;
}

// A spring at rest between the vertex and the nearest of these triangles; its rest is 0 where there is no distance.
ContactSpring nearest_spring(std::uint32_t v, std::span<const std::uint32_t> among, const Connectivity& mesh,
                             std::span<const Vector3> x) {
  ContactSpring s;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : among) {
    const Corners& c = mesh.triangles[t];
    const ClosestPoints closest = closest_vertex_triangle({x[v], x[c[0]], x[c[1]], x[c[2]]});
    if (const double distance = closest.offset.norm(); distance < nearest) {
      nearest = distance;
      s.vertices = {v, c[0], c[1], c[2]};
      s.weights = closest.weights;
      s.anchor = closest.offset;
    }
  }
  s.rest = s.anchor.norm();
  s.normal = s.anchor / s.rest;
  return s;
}

// For each vertex of the border of what goes, which stays, the nearest triangle that takes up what goes there.
class Border {
public:
  Border(const Frame& frame, const Connectivity& mesh, const MergePatches& patches)
      : frame_(frame), mesh_(mesh), x_(positions(frame)), lower_(mesh.vertices) {
    std::vector<bool> stays(mesh.vertices, false);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t])
        stays[v] = stays[v] || !patches.taken[t];
    for (const Lying& l : patches.lying)
      for (const std::uint32_t v : mesh.triangles[l.upper])
        if (stays[v])
          lower_[v].push_back(l.lower);
    for (const Lying& l : patches.lying) // at a bend, where the layer turns over on itself, nothing is to be welded
      for (const std::uint32_t v : mesh.triangles[l.upper])
        if (std::ranges::find(mesh.triangles[l.lower], v) != mesh.triangles[l.lower].end())
          lower_[v].clear();
  }

  // Springs that never part; none where the vertex has one already.
  [[nodiscard]] std::vector<ContactSpring> welds(const Scene& scene, std::span<const ContactSpring> there) const {
    std::vector<bool> welded(mesh_.vertices, false);
    for (const ContactSpring& s : there)
      if (s.welded())
        welded[s.vertices[0]] = true;
    const auto area_of = [&](std::uint32_t t) {
      const Corners& c = mesh_.triangles[t];
      return (x_[c[1]] - x_[c[0]]).cross(x_[c[2]] - x_[c[0]]).norm() / 2;
    };
    const std::vector<double> area = vertex_shares(mesh_.vertices, mesh_.triangles, area_of);
    const std::vector<double> thickness = thickness_around(mesh_.vertices, mesh_.triangles, volumes(frame_), area_of);
    std::vector<ContactSpring> welds;
    const FrameLiquids liquids(scene, frame_);
    const auto temperature = temperatures(frame_);
    for (std::uint32_t v = 0; v < mesh_.vertices; ++v)
      if (!lower_[v].empty() && !welded[v])
        if (ContactSpring s = nearest_spring(v, lower_[v], mesh_, x_); s.rest > 0) {
          s.since = ContactSpring::always;
          const std::uint32_t t = lower_[v].front();
          const double warm = temperature.empty() ? 0 : temperature[t];
          s.stiffness.fill(stiffness(scene, liquids.of(t), warm, s.mean(thickness), s.area(area)));
          welds.push_back(s);
        }
    return welds;
  }

private:
  // temperature: 0: without one.
  [[nodiscard]] double stiffness(const Scene& scene, const Liquid& liquid, double temperature, double h,
                                 double area) const {
    const double step = frame_.time - number(frame_, "start_time", frame_.time);
    const double g = scene.environment.gravity ? scene.environment.gravity->norm() : 0;
    const double time = g > 0 ? 0.1 * std::sqrt(h / g) : step;
    if (!(time > 0))
      return 0;
    const double inertia = scene.model.inertia ? area * liquid.density * h / (time * time) : 0;
    const Liquid there = temperature > 0 ? at_temperature(liquid, temperature) : liquid;
    return 0.5 * viscosity_of(there, {1 / (time * time)}) * h / time + inertia;
  }

  const Frame& frame_;
  const Connectivity& mesh_;
  std::span<const Vector3> x_;
  std::vector<std::vector<std::uint32_t>> lower_; // of each vertex
};

// What lies on what goes lies on what took it up from now on: a spring between a vertex that stays and a triangle that
// goes takes the nearest of the triangles which take that one up, keeps its force, and has touched as long.
void hand_down(std::vector<ContactSpring>& springs, const Connectivity& mesh, const MergePatches& patches,
               std::span<const Vector3> x) {
  std::map<Corners, std::vector<std::uint32_t>> lower; // of a triangle that goes, by its vertices
  const auto sorted = [](Corners c) {
    std::ranges::sort(c);
    return c;
  };
  std::vector<bool> stays(mesh.vertices, false);
  for (const Lying& l : patches.lying)
    lower[sorted(mesh.triangles[l.upper])].push_back(l.lower);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      stays[v] = stays[v] || !patches.taken[t];
  for (ContactSpring& s : springs) {
    const std::uint32_t v = s.vertices[0];
    const auto below = lower.find(sorted({s.vertices[1], s.vertices[2], s.vertices[3]}));
    if (!s.of_vertex() || !stays[v] || below == lower.end())
      continue;
    const ContactSpring made = nearest_spring(v, below->second, mesh, x);
    const Vector3 change = made.offset(x) - s.offset(x);
    if (!(made.rest > 0) || s.normal.dot(made.normal) < 0.5)
      continue;
    s.vertices = made.vertices;
    s.weights = made.weights;
    s.rest += s.normal.dot(change);
    s.anchor += change;
  }
}

double kinetic_energy(const Frame& frame, const Scene& scene) {
  double energy = 0;
  const FrameLiquids liquids(scene, frame);
  const auto v = velocities(frame);
  for (std::size_t t = 0; t < frame.triangles && !v.empty(); ++t)
    for (const std::uint32_t c : triangles(frame)[t])
      energy += liquids.density(t) * volumes(frame)[t] / 6 * v[c].squaredNorm();
  return energy;
}

void move(Frame& frame, std::span<const Vector3> ways) {
  const CarriedSprings springs(frame);
  const auto x = positions(frame);
  for (std::size_t v = 0; v < x.size(); ++v)
    x[v] += ways[v];
  springs.put(frame);
}

// What was taken up has given all, and goes.
void take_away(Frame& frame, const Connectivity& mesh, const std::vector<bool>& taken) {
  std::vector<bool> cut(mesh.edges.size(), false);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    cut[e] = !mesh.on_rim(e) && taken[mesh.edge_triangles[e][0]] != taken[mesh.edge_triangles[e][1]];
  const Fans fans = take_apart(mesh, cut);
  std::vector<Vector3> places;
  for (const std::uint32_t v : fans.old_vertex)
    places.push_back(positions(std::as_const(frame))[v]);
  put_fans(frame, fans, taken, places);
}

} // namespace

Merged merge(Frame& frame, const Scene& scene) {
  Merged merged;
  if (!has_contacts(frame))
    return merged;
  const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  const MergePatches patches = find_patches(frame, mesh, scene);
  merged.ripe = patches.ripe;
  if (!patches.any())
    return merged;
  for (const Lying& l : patches.lying)
    merged.volume += l.part * volumes(std::as_const(frame))[l.upper];
  merged.ripe = std::max(0.0, patches.ripe - merged.volume);
  merged.triangles = static_cast<std::size_t>(std::ranges::count(patches.taken, true));
  const double before = kinetic_energy(frame, scene);
  std::vector<ContactSpring> springs = read_springs(frame);
  for (ContactSpring& s : springs)
    s.since = std::min(s.since, frame.time); // of streams without dates
  const std::vector<ContactSpring> welds = Border(frame, mesh, patches).welds(scene, springs);
  merged.welds = welds.size();
  hand_down(springs, mesh, patches, positions(std::as_const(frame)));
  springs.insert(springs.end(), welds.begin(), welds.end());
  write_springs(frame, springs);
  std::vector<Vector3> ways = deposit(frame, patches.lying);
  merged.staying = keep_clear(mesh, patches.taken, positions(std::as_const(frame)), welds, ways);
  move(frame, ways);
  take_away(frame, mesh, patches.taken);
  merged.energy = before - kinetic_energy(frame, scene);
  add_to_account(frame, "merge.volume", "m^3", {&merged.volume, 1});
  add_to_account(frame, "merge.energy", "J", {&merged.energy, 1});
  return merged;
}

Merged& Merged::operator+=(const Merged& later) {
  triangles += later.triangles;
  welds += later.welds;
  staying += later.staying;
  volume += later.volume;
  energy += later.energy;
  ripe = later.ripe;
  return *this;
}

void MergeStage::merge(Frame& frame) {
  check_magnitudes(frame);
  const Scene& scene = scenes_.of(frame);
  if (!scene.merge)
    return;
  const Merged merged = flow::merge(frame, scene);
  if (merged.triangles > 0)
    log::detail("step {}: {} triangles taken up, {:.6g} m^3; {} welds, {} vertices had no room to move", frame.step,
                merged.triangles, merged.volume, merged.welds, merged.staying);
  total_ += merged;
}

void MergeStage::report() const {
  log::detail(
      "{} triangles taken up, {:.6g} m^3, {:.6g} J of kinetic energy lost; {} welds, {} vertices had no room to "
      "move; {:.6g} m^3 that have touched for long enough are left",
      total_.triangles, total_.volume, total_.energy, total_.welds, total_.staying, total_.ripe);
}

} // namespace sheet::flow
