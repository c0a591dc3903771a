// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/tear.h"

#include <algorithm>
#include <cmath>

#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/flow/cracks.h"
#include "libsheet/flow/heat_account.h"
#include "libsheet/flow/put_fans.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/prescribed.h"

namespace sheet::flow {

using formats::Frame;

namespace {

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
    put_fans(frame, fans, dropped, open_clear_cracks(mesh, fans, dropped, positions(static_cast<const Frame&>(frame))));
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
  const Dropped dropped = sum_of(frame, cuts.dropped, scene);
  torn.dropped = dropped.triangles;
  torn.volume = dropped.volume;
  torn.momentum = dropped.momentum;
  torn.vertices += count_apart(fans);
  // What is left is beside dropped triangles, and stays where it is.
  put_fans(frame, fans, cuts.dropped, open_clear_cracks(mesh, fans, cuts.dropped, x));
  if (torn.dropped > 0) {
    add_to_account(frame, "tear.volume", "m^3", {&torn.volume, 1});
    add_to_account(frame, "tear.momentum", "kg*m/s", {torn.momentum.data(), 3});
    add_heat_to_account(frame, "tear.heat", scene, dropped.warmth);
  }
  return torn;
}

Torn& Torn::operator+=(const Torn& later) {
  edges += later.edges;
  vertices += later.vertices;
  vetoed += later.vetoed;
  crossing += later.crossing;
  dropped += later.dropped;
  volume += later.volume;
  momentum += later.momentum;
  return *this;
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
  total_ += torn;
}

void TearStage::report() const {
  log::detail("{} edges cut", total_.edges);
  if (total_.dropped > 0)
    log::warning("{} triangles of crumbs dropped, {:.6g} m^3 (the frame's arrays tear.volume, tear.momentum)",
                 total_.dropped, total_.volume);
}

} // namespace sheet::flow
