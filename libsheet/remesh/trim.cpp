// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "libsheet/remesh/operations.h"

namespace sheet::remesh {

namespace {

bool may_go(const EditableSheet& sheet, std::uint32_t v) {
  return (sheet.free(v) || sheet.held_by_touch(v)) && !sheet.at_inlet(v);
}

// The vertex between the two rim sides that meets no other triangle goes: its row becomes that of the nearer end.
void note_tip(const EditableSheet& sheet, std::uint32_t tip, std::uint32_t a, std::uint32_t b, Edit& edit) {
  const double to_a = (sheet.at(a) - sheet.at(tip)).norm(), to_b = (sheet.at(b) - sheet.at(tip)).norm();
  edit.kind = Edit::Kind::collapse;
  edit.vertex = to_a < to_b ? a : b;
  edit.removed_vertex = tip;
  edit.position = sheet.at(edit.vertex);
  edit.parents = {{edit.vertex, 1, 1}, {tip, 0, 1}};
}

// What goes covers all of its neighbours, in proportion to their areas.
void share_out_first(const EditableSheet& sheet, Edit& edit) {
  const std::size_t old_count = edit.removed.size(), new_count = edit.added.size();
  double around = 0;
  for (std::size_t i = 0; i < new_count; ++i)
    around += sheet.shape(edit.removed[i + 1]).area;
  edit.overlap.assign(new_count * old_count, 0);
  for (std::size_t i = 0; i < new_count; ++i) {
    const double area = sheet.shape(edit.removed[i + 1]).area;
    edit.overlap[i * old_count] = sheet.shape(edit.removed[0]).area * area / around;
    edit.overlap[i * old_count + i + 1] = area;
  }
}

} // namespace

bool propose_trim(const EditableSheet& sheet, std::uint32_t triangle, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  const Corners& corners = mesh.corners(triangle);
  if (!std::ranges::all_of(corners, [&](std::uint32_t v) { return may_go(sheet, v); }))
    return false;
  edit.clear();
  edit.kind = Edit::Kind::flip;
  edit.removed = {triangle};
  std::uint32_t inner = no_index, rim = no_index; // the last side with a neighbour, without
  for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
    const std::uint32_t twin = mesh.twin(side);
    (twin == no_index ? rim : inner) = side;
    if (twin != no_index) {
      edit.removed.push_back(Mesh::triangle_of(twin));
      edit.added.push_back(mesh.corners(Mesh::triangle_of(twin)));
    }
  }
  if (edit.added.empty() || edit.added.size() == 3)
    return false;
  if (edit.added.size() == 1)
    note_tip(sheet, mesh.apex(inner), mesh.from(inner), mesh.to(inner), edit);
  else if (edit.removed[1] == edit.removed[2] || mesh.on_rim(mesh.apex(rim)))
    return false; // the sheet would hang together by a vertex there
  share_out_first(sheet, edit);
  return true;
}

bool propose_fill(const EditableSheet& sheet, std::uint32_t v, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  if (mesh.side_at(v) == no_index || !mesh.on_rim(v))
    return false;
  const auto [before, after] = rim_neighbours(mesh, v);
  const bool closes = (sheet.at(after) - sheet.at(before)).dot(sheet.velocity(after) - sheet.velocity(before)) < 0;
  if (sheet.wall(v) == no_index || sheet.wall(before) != sheet.wall(v) || sheet.wall(after) != sheet.wall(v) ||
      before == after || mesh.adjacent(before, after) ||
      !(closes || sheet.at_inlet(v) || sheet.at_inlet(before) || sheet.at_inlet(after)))
    return false;
  edit.clear();
  edit.kind = Edit::Kind::flip;
  mesh.for_fan(v, [&](std::uint32_t side) {
    edit.removed.push_back(Mesh::triangle_of(side));
    edit.added.push_back(mesh.corners(Mesh::triangle_of(side)));
  });
  const std::size_t around = edit.removed.size();
  edit.added.push_back({after, v, before});
  const double notch = TriangleShape(sheet.at(after), sheet.at(v), sheet.at(before)).area;
  double area = 0;
  for (const std::uint32_t t : edit.removed)
    area += sheet.shape(t).area;
  edit.overlap.assign((around + 1) * around, 0);
  for (std::size_t i = 0; i < around; ++i) { // what comes counts as covering all in proportion
    const double own = sheet.shape(edit.removed[i]).area;
    edit.overlap[i * around + i] = own;
    edit.overlap[around * around + i] = notch * own / area;
  }
  return true;
}

} // namespace sheet::remesh
