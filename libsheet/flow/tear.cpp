// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/tear.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/flow/cracks.h"
#include "libsheet/flow/fans.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/account.h"
#include "libsheet/sheet/carried_springs.h"
#include "libsheet/sheet/directors.h"
#include "libsheet/sheet/transfer.h"

namespace sheet::flow {

using formats::Frame;

namespace {

// For each new vertex the volume of a third of its triangles [m³].
std::vector<double> carried(const Fans& fans, std::span<const double> volumes) {
  std::vector<double> carried(fans.old_vertex.size(), 0);
  for (std::size_t t = 0; t < fans.triangles.size(); ++t)
    for (const std::uint32_t v : fans.triangles[t])
      carried[v] += volumes[t] / 3;
  return carried;
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

// Gives the frame the vertices of the fans at these positions, without dropped triangles.
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

std::size_t count_apart(const Fans& fans) { return fans.old_vertex.size() - fans.fan_count.size(); }

std::vector<bool> none_of(std::size_t size) { return std::vector<bool>(size, false); }

// For [[hold]] tables and solids, which of them hold each vertex fast.
std::vector<std::vector<std::uint64_t>> grips_of(const Frame& frame, const Scene& scene) {
  std::uint64_t in_force = scene::holds_in_force(scene, frame.time);
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (scene.holds[i].axes != all_axes)
      in_force &= ~(std::uint64_t{1} << i);
  std::vector<std::vector<std::uint64_t>> grips;
  for (const std::string_view name : {"hold", "touch"}) {
    const formats::Array* array = frame.find(name);
    for (std::size_t k = 0; array != nullptr && k < array->components; ++k) { // the k-th word of each vertex
      std::vector<std::uint64_t>& bits = grips.emplace_back();
      const std::uint64_t wanted = name == "hold" ? in_force : ~std::uint64_t{0};
      for (std::size_t v = 0; v < frame.vertices; ++v)
        bits.push_back(array->values<std::uint64_t>()[v * array->components + k] & wanted);
    }
  }
  return grips;
}

std::vector<bool> inlet_of(const Frame& frame) {
  std::vector<bool> inlet;
  for (const std::uint64_t bits : masks(frame, "inlet"))
    inlet.push_back(bits != 0);
  return inlet;
}

} // namespace

Torn tear(Frame& frame, const Scene& scene) {
  Torn torn;
  Connectivity mesh = connect(frame.vertices, triangles(frame));
  if (const Fans fans = take_apart(mesh, none_of(mesh.edges.size())); count_apart(fans) > 0) {
    torn.vertices = count_apart(fans);
    const std::vector<bool> dropped = none_of(mesh.triangles.size());
    put_fans(frame, fans, dropped, open_cracks(fans, dropped, positions(static_cast<const Frame&>(frame))));
    mesh = connect(frame.vertices, triangles(frame));
  }
  const auto x = positions(static_cast<const Frame&>(frame));
  const auto volume = volumes(static_cast<const Frame&>(frame));
  std::vector<double> areas;
  for (const Corners& c : mesh.triangles)
    areas.push_back(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
  TearCuts cuts = find_cuts({.mesh = mesh,
                             .volumes = volume,
                             .areas = areas,
                             .below = scene.tear->below,
                             .drop_crumbs = scene.tear->drop_crumbs,
                             .grips = grips_of(frame, scene),
                             .whole = inlet_of(frame)});
  torn.vetoed = cuts.vetoed;
  if (cuts.edges == 0)
    return torn;
  Fans fans = take_apart(mesh, cuts.cut);
  std::vector<Vector3> opened = open_cracks(fans, cuts.dropped, x);
  for (;;) {
    const std::size_t crossing = leave_crossing_whole(mesh, x, fans, opened, cuts);
    if (crossing == 0)
      break;
    torn.crossing += crossing;
    fans = take_apart(mesh, cuts.cut);
    opened = open_cracks(fans, cuts.dropped, x);
  }
  torn.edges = cuts.edges;
  if (cuts.edges == 0)
    return torn;
  const auto v = velocities(static_cast<const Frame&>(frame));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!cuts.dropped[t])
      continue;
    ++torn.dropped;
    torn.volume += volume[t];
    for (const std::uint32_t c : mesh.triangles[t])
      if (!v.empty())
        torn.momentum += scene.material.density * volume[t] / 3 * v[c];
  }
  torn.vertices += count_apart(fans);
  put_fans(frame, fans, cuts.dropped, opened);
  if (torn.dropped > 0) {
    add_to_account(frame, "tear.volume", "m^3", {&torn.volume, 1});
    add_to_account(frame, "tear.momentum", "kg*m/s", {torn.momentum.data(), 3});
  }
  return torn;
}

void TearStage::tear(Frame& frame) {
  check_magnitudes(frame);
  const Scene& scene = scenes_.of(frame);
  if (!scene.tear)
    return;
  const Torn torn = flow::tear(frame, scene);
  if (torn.vertices > 0)
    log::detail("step {}: {} edges cut, {} vertices came apart, {} edges left whole for crumbs, {} as layers would "
                "cross, {} triangles dropped",
                frame.step, torn.edges, torn.vertices, torn.vetoed, torn.crossing, torn.dropped);
  total_.edges += torn.edges;
  total_.dropped += torn.dropped;
  total_.volume += torn.volume;
}

void TearStage::report() const {
  log::detail("{} edges cut", total_.edges);
  if (total_.dropped > 0)
    log::warning("{} triangles of crumbs dropped, {:.6g} m^3 (the frame's arrays tear.volume, tear.momentum)",
                 total_.dropped, total_.volume);
}

} // namespace sheet::flow
