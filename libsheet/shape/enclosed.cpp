// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/enclosed.h"

#include <algorithm>
#include <string>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

// Of each triangle, from 1, in the order of their first vertices.
std::vector<std::uint32_t> pieces_of(const Connectivity& mesh) {
  DisjointSets sets(mesh.vertices);
  for (const Corners& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> number(mesh.vertices, 0), pieces;
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (sets.find(v) == v)
      number[v] = ++count;
  for (const Corners& t : mesh.triangles)
    pieces.push_back(number[sets.find(t[0])]);
  return pieces;
}

void refuse_open(const Connectivity& mesh, const scene::SheetTable& table, const formats::Frame& frame) {
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (!mesh.on_rim(e))
      continue;
    const Eigen::Vector3d& x = positions(frame)[mesh.edges[e][0]];
    fail(ExitCode::bad_input,
         "pressure: of several pieces each must enclose a volume of its own, but {} is open, at ({:g}, {:g}, {:g}) m; "
         "let it act on another sheet only, such as pressure = {{..., sheet = \"balloon\"}}, or close it",
         table.name.empty() ? std::string("a [[sheet]]") : fmt::format("the sheet \"{}\"", table.name), x.x(), x.y(),
         x.z());
  }
}

} // namespace

void number_enclosures(const Scene& scene, const scene::SheetTable& table, formats::Frame& frame) {
  if (!scene.environment.pressure)
    return;
  const std::string& only = scene.environment.pressure_sheet;
  if (!only.empty() && only != table.name)
    return put_enclosures(std::vector<std::uint32_t>(frame.triangles, 0), frame);
  if (!depends_on_volume(*scene.environment.pressure)) {
    if (!only.empty())
      put_enclosures(std::vector<std::uint32_t>(frame.triangles, 1), frame);
    return;
  }
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const std::vector<std::uint32_t> pieces = pieces_of(mesh);
  const bool several =
      std::ranges::any_of(pieces, [](std::uint32_t p) { return p > 1; }) || (only.empty() && scene.sheets.size() > 1);
  if (several)
    refuse_open(mesh, table, frame);
  if (several || !only.empty())
    put_enclosures(pieces, frame);
}

} // namespace sheet
