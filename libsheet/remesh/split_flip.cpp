// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/operations.h"

namespace sheet::remesh {

void propose_split(const EditableSheet& sheet, std::uint32_t side, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  edit.clear();
  edit.kind = Edit::Kind::split;
  const std::uint32_t a = mesh.from(side), b = mesh.to(side), m = mesh.next_vertex();
  edit.vertex = m;
  edit.position = 0.5 * (sheet.at(a) + sheet.at(b));
  double volume = 0;
  const auto halve = [&](std::uint32_t s) {
    const std::uint32_t t = Mesh::triangle_of(s);
    edit.removed.push_back(t);
    edit.added.push_back({mesh.from(s), m, mesh.apex(s)});
    edit.added.push_back({m, mesh.to(s), mesh.apex(s)});
    volume += sheet.volume(t);
  };
  halve(side);
  if (mesh.twin(side) != no_index)
    halve(mesh.twin(side));
  const std::size_t old_count = edit.removed.size();
  for (std::size_t i = 0; i < edit.added.size(); ++i)
    for (std::size_t j = 0; j < old_count; ++j)
      edit.overlap.push_back(i / 2 == j ? sheet.shape(edit.removed[j]).area / 2 : 0);
  // half of what a's corners of these triangles carry passes to the new vertex
  const auto share = [&](std::uint32_t v) { return volume / 6 / sheet.carried(v); };
  edit.parents = {{a, 0.5, share(a)}, {b, 0.5, share(b)}};
}

bool propose_flip(const EditableSheet& sheet, std::uint32_t side, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  const std::uint32_t twin = mesh.twin(side);
  if (twin == no_index)
    return false;
  const std::uint32_t a = mesh.from(side), b = mesh.to(side), c = mesh.apex(side), d = mesh.apex(twin);
  if (c == d || mesh.adjacent(c, d) || (sheet.held_alike(a, b) && sheet.fixed(a)))
    return false;
  edit.clear();
  edit.kind = Edit::Kind::flip;
  edit.removed = {Mesh::triangle_of(side), Mesh::triangle_of(twin)};
  edit.added = {{a, d, c}, {d, b, c}};
  const Vector3 o = sheet.at(a);
  edit.swept = (sheet.at(d) - o).cross(sheet.at(b) - o).dot(sheet.at(c) - o) / 6;
  return true;
}

} // namespace sheet::remesh
