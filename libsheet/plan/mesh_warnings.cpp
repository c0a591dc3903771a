// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/mesh_warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "libsheet/geometry/box.h"
#include "libsheet/geometry/coincident.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/mesh_width.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/scene/solid_width.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;

constexpr double large = 20;                          // [m]
constexpr double needle = 5 * std::numbers::pi / 180; // [rad]
constexpr double close = 1e-6;                        // of the whole: what lies on each other
constexpr double as_long = 0.9;                       // of edges, which are longer and shorter than the scene says

std::string written(const Vector3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z()); }

bool is_mesh_sheet(const scene::SheetTable& sheet) { return std::holds_alternative<scene::SheetMesh>(sheet.shape); }

bool is_mesh(const scene::Solid& solid) { return std::holds_alternative<scene::SolidMesh>(solid.shape); }

std::size_t pieces_of(const Frame& frame) {
  DisjointSets sets(frame.vertices);
  for (const Corners& c : triangles(frame)) {
    sets.join(c[0], c[1]);
    sets.join(c[0], c[2]);
  }
  std::set<std::uint64_t> roots;
  for (const Corners& c : triangles(frame))
    roots.insert(sets.find(c[0]));
  return roots.size();
}

std::vector<Vector3> border_middles(const Frame& frame) {
  const auto x = positions(frame);
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  std::vector<Vector3> middles;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.on_rim(e))
      middles.emplace_back((x[mesh.edges[e][0]] + x[mesh.edges[e][1]]) / 2);
  return middles;
}

// Of pieces that nothing joins, of meshes without seams.
std::string warning_of_pieces(const Scene& scene, const Frame& first) {
  if (std::ranges::none_of(scene.sheets, is_mesh_sheet) || !seam_warning(scene, first).empty())
    return {};
  const auto present = std::ranges::count_if(scene.sheets, [](const auto& sheet) { return !sheet.enters; });
  if (const std::size_t pieces = pieces_of(first); pieces > static_cast<std::size_t>(present))
    return fmt::format("the sheet's mesh has {} pieces that nothing joins: if they belong together, weld its vertices",
                       pieces - static_cast<std::size_t>(present) + 1);
  return {};
}

std::string warning_of_needles(const Frame& first) {
  const auto x = positions(first);
  std::size_t count = 0, sharpest = 0;
  double least = needle;
  for (std::size_t t = 0; t < first.triangles; ++t) {
    const Corners& c = triangles(first)[t];
    const double angle = smallest_angle(x[c[0]], x[c[1]], x[c[2]]);
    count += angle < needle ? 1 : 0;
    if (angle < least) {
      least = angle;
      sharpest = t;
    }
  }
  if (count == 0)
    return {};
  return fmt::format(
      "{} of the sheet's triangles are needles, the sharpest with {:.2g} degrees, number {} at {}: steps "
      "are short and inaccurate until sheet-remesh has mended them; better mesh it anew",
      count, least * 180 / std::numbers::pi, sharpest, written(x[triangles(first)[sharpest][0]]));
}

// Of solids that are narrower than edges are long, meshes in parts; else "".
std::string warning_of_narrow_solids(const Scene& scene, const solid::Solids& solids, const Frame& first) {
  const double edge = scene::mean_edge(first);
  std::vector<double> width;
  for (std::size_t i = 0; i < solids.size(); ++i)
    width.push_back(is_mesh(scene.solids[i]) ? narrow_width(solids.shape(i)) : scene::width_of(scene.solids[i].shape));
  const auto narrow = std::ranges::count_if(width, [&](double w) { return w < as_long * edge; });
  if (narrow == 0)
    return {};
  const auto least = static_cast<std::size_t>(std::ranges::min_element(width) - width.begin());
  const bool thick = *measured(first).thickness > 2 * width[least];
  return fmt::format(
      "{}{}{} narrower ({:.3g} m) than edges are long ({:.3g} m), so triangles span {} instead of lying on "
      "{}: {}{}",
      solids.name(least), narrow > 1 ? fmt::format(" and {} more are", narrow - 1) : " is",
      is_mesh(scene.solids[least]) ? " in parts" : "", width[least], edge, narrow > 1 ? "them" : "it",
      narrow > 1 ? "them" : "it", setting_of_edges(scene, width[least]),
      thick ? "; and thinner than the sheet: a groove that it draws within the layer is not modelled" : "");
}

} // namespace

std::string hint_of_scale(const std::string& what, double length) {
  return length > large && std::isfinite(length)
             ? fmt::format("{} is {:.3g} m long: if its mesh is in millimetres, give it scale = 0.001", what, length)
             : std::string();
}

std::string setting_of_edges(const Scene& scene, double length) {
  return std::ranges::all_of(scene.sheets, is_mesh_sheet)
             ? fmt::format("sheet-remesh --edge-length {:.2g} in the ring", length)
             : fmt::format("edge_length = {:.2g} in [sheet]", length);
}

std::string seam_warning(const Scene& scene, const Frame& first) {
  if (std::ranges::none_of(scene.sheets, is_mesh_sheet))
    return {};
  Box box;
  for (const Vector3& x : positions(first))
    box.add(x);
  const std::vector<Vector3> middles = border_middles(first);
  const std::vector<bool> paired = coincident(middles, close * box.diagonal());
  const auto seam = std::ranges::find(paired, true);
  if (seam == paired.end())
    return {};
  return fmt::format("{} edges of the sheet's border lie on each other, the first at {}, and nothing joins them: weld "
                     "the mesh's vertices (merge those at the same place), or it comes apart there",
                     std::ranges::count(paired, true),
                     written(middles[static_cast<std::size_t>(seam - paired.begin())]));
}

std::vector<std::string> mesh_warnings(const Scene& scene, const Frame& first) {
  const solid::Solids solids(scene);
  std::vector<std::string> warnings{seam_warning(scene, first), warning_of_pieces(scene, first),
                                    warning_of_needles(first), warning_of_narrow_solids(scene, solids, first)};
  constexpr double of_the_sheet = 50; // a landscape is not as much longer than what flows in it
  Box sheet;
  for (const Vector3& x : positions(first))
    sheet.add(x);
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (const double length = solids.shape(i).bounds().diagonal().norm();
        is_mesh(scene.solids[i]) && length > of_the_sheet * sheet.diagonal())
      warnings.push_back(hint_of_scale(solids.name(i), length));
  std::erase(warnings, "");
  return warnings;
}

} // namespace sheet
