// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "libsheet/remesh/operations.h"

namespace sheet::remesh {

namespace {

// Weights of the point x in the triangle, cut off to it.
std::array<double, 3> barycentric(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& x) {
  const Vector3 normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  std::array<double, 3> w = {(c - b).cross(x - b).dot(normal) / square, (a - c).cross(x - c).dot(normal) / square,
                             (b - a).cross(x - a).dot(normal) / square};
  double sum = 0;
  for (double& value : w) {
    value = std::max(value, 0.0);
    sum += value;
  }
  for (double& value : w)
    value /= sum;
  return w;
}

// Where x lies among the triangles: the one in which its least weight is greatest.
void find_parents(const EditableSheet& sheet, const Vector3& x, Edit& edit) {
  double best = -1;
  for (const std::uint32_t t : edit.removed) {
    const Corners& c = sheet.mesh().corners(t);
    const std::array<double, 3> w = barycentric(sheet.at(c[0]), sheet.at(c[1]), sheet.at(c[2]), x);
    const double least = std::min({w[0], w[1], w[2]});
    if (!(least > best))
      continue;
    best = least;
    edit.parents.clear();
    for (std::size_t i = 0; i < 3; ++i)
      edit.parents.push_back({c[i], w[i], c[i] == edit.vertex ? 1.0 : 0.0});
  }
  if (!(best > 0)) // at the border of its triangles: it keeps what it has
    edit.parents = {{edit.vertex, 1, 1}};
}

} // namespace

bool propose_smooth(const EditableSheet& sheet, std::uint32_t v, double pay, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  if (mesh.on_rim(v) || sheet.fixed(v) || mesh.side_at(v) == no_index)
    return false;
  edit.clear();
  edit.kind = Edit::Kind::smooth;
  edit.vertex = v;
  edit.keeps_hold = true;
  const Vector3 x = sheet.at(v);
  Vector3 normal = Vector3::Zero(), middle = Vector3::Zero();
  double area = 0;
  mesh.for_fan(v, [&](std::uint32_t side) {
    const std::uint32_t t = Mesh::triangle_of(side), b = mesh.to(side), c = mesh.apex(side);
    const TriangleShape s = sheet.shape(t);
    edit.removed.push_back(t);
    edit.added.push_back({v, b, c});
    edit.former.push_back(edit.removed.size() - 1);
    normal += s.area * s.normal;
    middle += s.area * (x + sheet.at(b) + sheet.at(c)) / 3;
    area += s.area;
  });
  const double length = normal.norm();
  if (!(area > 0 && length > 0.5 * area))
    return false;
  normal /= length;
  // A step across the ring's area vector sweeps no volume: that is linear in the step.
  Vector3 step = middle / area - x;
  step -= normal.dot(step) * normal;
  // The step h along the normal sweeps h |Σ A n| / 3.
  const double owed = std::clamp(3 * sheet.swept(v) / length, -pay, pay);
  step -= owed * normal;
  for (int axis = 0; axis < 3; ++axis)
    if (has_axis(sheet.held_axes(v), axis))
      step[axis] = 0;
  const double rise = normal.dot(step);
  find_parents(sheet, x + step - rise * normal, edit);
  edit.position = x + step;
  edit.swept = rise * length / 3;
  return true;
}

bool propose_absorb(const EditableSheet& sheet, std::uint32_t rim_side, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  if (mesh.twin(rim_side) != no_index)
    return false;
  const std::uint32_t a = mesh.from(rim_side), b = mesh.to(rim_side), c = mesh.apex(rim_side);
  const std::uint32_t flat = Mesh::triangle_of(rim_side);
  if (mesh.on_rim(c) || !sheet.held_within(c, a) || !sheet.held_within(c, b))
    return false;
  const Vector3 along = sheet.at(b) - sheet.at(a);
  const double t = along.dot(sheet.at(c) - sheet.at(a)) / along.squaredNorm();
  if (!(t > 0 && t < 1))
    return false;
  edit.clear();
  edit.kind = Edit::Kind::smooth;
  edit.vertex = c;
  edit.position = sheet.at(a) + t * along;
  // held by what holds both ends, if anything does more than hold it now
  if (!sheet.held_alike(c, a) && !sheet.held_alike(c, b))
    edit.parents = {{a, 1 - t, 0}, {b, t, 0}, {c, 0, 1}};
  else {
    edit.parents = {{c, 1, 1}};
    edit.keeps_hold = true;
  }
  mesh.for_fan(c, [&](std::uint32_t side) {
    edit.removed.push_back(Mesh::triangle_of(side));
    if (Mesh::triangle_of(side) == flat)
      return;
    edit.added.push_back({c, mesh.to(side), mesh.apex(side)});
    edit.former.push_back(edit.removed.size() - 1);
  });
  return edit.added.size() >= 2;
}

} // namespace sheet::remesh
