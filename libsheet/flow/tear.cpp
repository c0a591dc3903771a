// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/tear.h"

#include <algorithm>
#include <utility>

#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/flow/cracks.h"
#include "libsheet/flow/exposure.h"
#include "libsheet/flow/holes.h"
#include "libsheet/flow/put_fans.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/area.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

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

std::vector<double> areas_of(const Frame& frame) {
  const auto x = positions(frame);
  std::vector<double> areas;
  for (const Corners& c : triangles(frame))
    areas.push_back(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
  return areas;
}

// Vertices that something holds fast, that touch a solid or another layer, or belong to an inlet.
std::vector<bool> supported_vertices(const Frame& frame, const Scene& scene) {
  std::vector<bool> supported = inlet_of(frame);
  supported.resize(frame.vertices, false);
  for (const std::vector<std::uint64_t>& bits : grips_of(frame, scene))
    for (std::size_t v = 0; v < bits.size(); ++v)
      supported[v] = supported[v] || bits[v] != 0;
  for (const ContactSpring& spring : read_springs(frame))
    for (const std::uint32_t v : spring.vertices)
      supported[v] = true;
  return supported;
}

// The frame's mesh, in which no pieces hang together in a point any more.
Connectivity part_at_pinches(Frame& frame, Torn& torn) {
  Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  const Fans fans = take_apart(mesh, none_of(mesh.edges.size()));
  if (count_apart(fans) == 0)
    return mesh;
  torn.vertices += count_apart(fans);
  const std::vector<bool> dropped = none_of(mesh.triangles.size());
  put_fans(frame, fans, dropped, open_clear_cracks(mesh, fans, dropped, positions(std::as_const(frame))));
  return connect(frame.vertices, triangles(std::as_const(frame)));
}

Holes open_at_sites(Frame& frame, const Scene& scene, Torn& torn) {
  const std::vector<bool> supported = supported_vertices(frame, scene);
  const std::vector<Site> sites = draw_sites(frame, *scene.tear->inclusions, areas_of(frame), supported);
  Holes holes = open_holes(frame, sites, supported);
  torn.holes += holes.opened;
  torn.without_room += holes.without_room;
  return holes;
}

// Where the sheet is thinner than the scene allows, and at these triangles.
void cut_thin(Frame& frame, const Connectivity& mesh, const Scene& scene, std::span<const std::uint32_t> at,
              Torn& torn) {
  std::vector<bool> pierced = none_of(at.empty() ? 0 : mesh.triangles.size());
  for (const std::uint32_t t : at)
    pierced[t] = true;
  const auto x = positions(std::as_const(frame));
  const std::vector<double> areas = areas_of(frame);
  TearCuts cuts = find_cuts({.mesh = mesh,
                             .volumes = volumes(std::as_const(frame)),
                             .areas = areas,
                             .below = scene.tear->below.value_or(0),
                             .drop_crumbs = scene.tear->drop_crumbs || scene.tear->drops,
                             .pierced = std::move(pierced),
                             .grips = grips_of(frame, scene),
                             .whole = inlet_of(frame)});
  torn.vetoed += cuts.vetoed;
  if (cuts.edges == 0)
    return;
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
  torn.edges += cuts.edges;
  if (cuts.edges == 0)
    return;
  const Shed crumbs = what_becomes_of(frame, cuts.dropped, scene);
  torn.add(crumbs);
  torn.vertices += count_apart(fans);
  // What is left is beside dropped triangles, and stays where it is.
  put_fans(frame, fans, cuts.dropped, open_clear_cracks(mesh, fans, cuts.dropped, x));
  put_shed(crumbs, scene, frame);
}

} // namespace

Torn tear(Frame& frame, const Scene& scene) {
  Torn torn;
  Connectivity mesh = part_at_pinches(frame, torn);
  Holes holes;
  if (scene.tear->inclusions)
    holes = open_at_sites(frame, scene, torn);
  if (holes.opened > 0)
    mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  if (scene.tear->below || !holes.pierced.empty())
    cut_thin(frame, mesh, scene, holes.pierced, torn);
  torn.add(shed_round_pieces(frame, scene));
  return torn;
}

void Torn::add(const Shed& shed) {
  drops += shed.drops.size();
  if (!shed.drops.empty())
    return;
  dropped += shed.sum.triangles;
  volume += shed.sum.volume;
  momentum += shed.sum.momentum;
}

Torn& Torn::operator+=(const Torn& later) {
  edges += later.edges;
  vertices += later.vertices;
  vetoed += later.vetoed;
  crossing += later.crossing;
  holes += later.holes;
  without_room += later.without_room;
  dropped += later.dropped;
  drops += later.drops;
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
  if (torn.holes + torn.without_room > 0)
    log::detail("step {}: {} holes opened, {} sites had no room for one", frame.step, torn.holes, torn.without_room);
  if (torn.vertices > 0)
    log::detail("step {}: {} edges cut, {} vertices came apart, {} edges left whole for crumbs, {} as layers would "
                "cross, {} triangles dropped",
                frame.step, torn.edges, torn.vertices, torn.vetoed, torn.crossing, torn.dropped);
  if (torn.drops > 0)
    log::detail("step {}: {} drops came off", frame.step, torn.drops);
  total_ += torn;
}

void TearStage::report() const {
  log::detail("{} edges cut", total_.edges);
  if (total_.holes + total_.without_room > 0)
    log::detail("{} holes opened, {} sites had no room for one", total_.holes, total_.without_room);
  if (total_.drops > 0)
    log::detail("{} drops came off", total_.drops);
  if (total_.dropped > 0)
    log::warning("{} triangles of crumbs dropped, {:.6g} m^3 (the frame's arrays tear.volume, tear.momentum)",
                 total_.dropped, total_.volume);
}

} // namespace sheet::flow
