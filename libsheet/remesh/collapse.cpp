// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "libsheet/remesh/operations.h"

namespace sheet::remesh {

namespace {

// Whether a vertex keeps enough triangles if it loses one: three inside, one at a rim.
bool may_lose_one(const Mesh& mesh, std::uint32_t v) { return mesh.degree(v) >= (mesh.on_rim(v) ? 2U : 4U); }

// Link condition: the ends have no common neighbours but the apices of the edge's triangles, and no apex would be left
// with two triangles (inside) or none (at a rim).
bool keeps_manifold(const Mesh& mesh, std::uint32_t side) {
  const std::uint32_t u = mesh.from(side), v = mesh.to(side), twin = mesh.twin(side);
  if (twin != no_index && mesh.on_rim(u) && mesh.on_rim(v))
    return false;
  std::size_t common = 0;
  mesh.for_neighbours(u, [&](std::uint32_t w) {
    if (w != v && mesh.adjacent(w, v))
      ++common;
  });
  if (common != (twin == no_index ? 1U : 2U))
    return false;
  return may_lose_one(mesh, mesh.apex(side)) && (twin == no_index || may_lose_one(mesh, mesh.apex(twin)));
}

// Regularised quadric of the planes of triangles: the point with the least Σ A (n·(x - c))² + r ΣA |x - middle|².
Vector3 quadric_point(const EditableSheet& sheet, std::span<const std::uint32_t> triangles, const Vector3& middle) {
  constexpr double regularisation = 0.0001;
  Matrix3 quadric = Matrix3::Zero();
  Vector3 pull = Vector3::Zero();
  double area = 0;
  for (const std::uint32_t t : triangles) {
    const TriangleShape s = sheet.shape(t);
    const Vector3 to = sheet.at(sheet.mesh().corners(t)[0]) - middle;
    quadric += s.area * s.normal * s.normal.transpose();
    pull += s.area * s.normal.dot(to) * s.normal;
    area += s.area;
  }
  if (!(area > 0))
    return middle;
  quadric += regularisation * area * Matrix3::Identity();
  return middle + quadric.ldlt().solve(pull);
}

// Moves x along the ring's area vector until the cone over the ring has the wanted volume; at most `reach` far.
Vector3 with_volume(const EditableSheet& sheet, const Edit& edit, const Vector3& x, const Vector3& origin,
                    double six_volumes, double reach) {
  // Each added triangle (w, p, q) makes (x - o)·((p - o) × (q - o)) = six times its cone's volume.
  Vector3 gradient = Vector3::Zero();
  for (const Corners& t : edit.added) {
    const std::size_t i = static_cast<std::size_t>(std::find(t.begin(), t.end(), edit.vertex) - t.begin());
    gradient += (sheet.at(t[(i + 1) % 3]) - origin).cross(sheet.at(t[(i + 2) % 3]) - origin);
  }
  const double square = gradient.squaredNorm();
  if (!(square > 0))
    return x;
  Vector3 shift = (six_volumes - gradient.dot(x - origin)) / square * gradient;
  const double length = shift.norm();
  if (length > reach)
    shift *= reach / length;
  return x + shift;
}

double six_cones(const EditableSheet& sheet, const Edit& edit, const Vector3& tip) {
  double sum = 0;
  for (const Corners& t : edit.added) {
    std::array<Vector3, 3> x;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] = (t[i] == edit.vertex ? edit.position : sheet.at(t[i])) - tip;
    sum += x[0].cross(x[1]).dot(x[2]);
  }
  return sum;
}

// The point x nearest to the middle of the edge u v for which the rim a-x-b encloses what a-u-v-b does: with the middle
// as origin, x × (b - a) = a × u + u × v + v × b [Lindstrom, Turk 1998].
Vector3 rim_point(const EditableSheet& sheet, const Vector3& u, const Vector3& v, std::uint32_t before,
                  std::uint32_t after) {
  const Vector3 middle = 0.5 * (u + v), a = sheet.at(before) - middle, b = sheet.at(after) - middle;
  const Vector3 chord = b - a;
  const double square = chord.squaredNorm();
  if (before == after || !(square > 0))
    return middle;
  const Vector3 p = u - middle, q = v - middle;
  return middle + chord.cross(a.cross(p) + p.cross(q) + q.cross(b)) / square;
}

// All triangles around both ends; those of an inlet's strip, which no edit may touch, only if the kept end moves.
void make_fans(const EditableSheet& sheet, std::uint32_t kept, bool in_place, std::uint32_t gone, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  const auto take = [&](std::uint32_t side) {
    const std::uint32_t t = Mesh::triangle_of(side);
    if (std::find(edit.removed.begin(), edit.removed.end(), t) != edit.removed.end())
      return;
    Corners corners = mesh.corners(t);
    if (in_place && sheet.in_strip(t) && std::find(corners.begin(), corners.end(), gone) == corners.end())
      return;
    edit.removed.push_back(t);
    if (std::find(corners.begin(), corners.end(), kept) != corners.end() &&
        std::find(corners.begin(), corners.end(), gone) != corners.end())
      return;
    std::replace(corners.begin(), corners.end(), gone, kept);
    edit.added.push_back(corners);
    edit.former.push_back(edit.removed.size() - 1);
  };
  mesh.for_fan(kept, take);
  mesh.for_fan(gone, take);
}

} // namespace

RimNeighbours rim_neighbours(const Mesh& mesh, std::uint32_t v) {
  RimNeighbours found{no_index, mesh.to(mesh.side_at(v))};
  mesh.for_fan(v, [&](std::uint32_t side) {
    if (mesh.twin(Mesh::previous(side)) == no_index)
      found.before = mesh.from(Mesh::previous(side));
  });
  return found;
}

bool is_corner(const EditableSheet& sheet, std::uint32_t v) {
  const Mesh& mesh = sheet.mesh();
  if (!mesh.on_rim(v))
    return false;
  const auto [before, after] = rim_neighbours(mesh, v);
  const Vector3 in = sheet.at(v) - sheet.at(before), out = sheet.at(after) - sheet.at(v);
  return in.dot(out) < corner_cosine * in.norm() * out.norm();
}

double cone_volume(const EditableSheet& sheet, std::span<const std::uint32_t> triangles, const Vector3& tip) {
  double sum = 0;
  for (const std::uint32_t t : triangles) {
    const Corners& c = sheet.mesh().corners(t);
    sum += (sheet.at(c[0]) - tip).cross(sheet.at(c[1]) - tip).dot(sheet.at(c[2]) - tip);
  }
  return sum;
}

namespace {
// Which end of a side stays, and whether at its place; no_index if neither may go.
struct Stays {
  std::uint32_t vertex = no_index;
  bool in_place = false;
};

// An end may insist on its place as a corner of the rim, as held more than the other, as the one on the rim; if both do
// for different reasons, neither can go. A corner that an inlet's strip runs into gives way to it: liquid turns around
// the inlet's ends there.
Stays which_stays(const EditableSheet& sheet, std::uint32_t u, std::uint32_t v) {
  const bool under_v = sheet.held_within(u, v), under_u = sheet.held_within(v, u);
  if (!under_u && !under_v)
    return {};
  std::uint32_t kept = no_index;
  const auto insist = [&](bool u_does, bool v_does) {
    if (u_does == v_does)
      return true;
    const std::uint32_t who = u_does ? u : v;
    if (kept != no_index && kept != who)
      return false;
    kept = who;
    return true;
  };
  const bool corner_u = is_corner(sheet, u) && !(sheet.at_inlet(v) && !sheet.at_inlet(u));
  const bool corner_v = is_corner(sheet, v) && !(sheet.at_inlet(u) && !sheet.at_inlet(v));
  if ((corner_u && corner_v) || !insist(corner_u, corner_v) || !insist(!under_v, !under_u) ||
      !insist(sheet.mesh().on_rim(u), sheet.mesh().on_rim(v)))
    return {};
  const bool in_place = kept != no_index || sheet.fixed(u);
  return {kept == no_index ? u : kept, in_place};
}

// Where an edge of which neither end insists on its place contracts to: on the rim's arc, or where the faces around
// want it, with the volume that they had and, as far as `pay` reaches, what is owed.
Vector3 contracted(const EditableSheet& sheet, std::uint32_t u, std::uint32_t v, double pay, const Edit& edit) {
  const Vector3 a = sheet.at(edit.vertex), b = sheet.at(edit.removed_vertex), middle = 0.5 * (a + b);
  Vector3 position;
  if (sheet.mesh().on_rim(u)) {
    const std::uint32_t start = rim_neighbours(sheet.mesh(), u).before, end = rim_neighbours(sheet.mesh(), v).after;
    position = rim_point(sheet, sheet.at(u), sheet.at(v), start, end);
  } else {
    const double before = cone_volume(sheet, edit.removed, middle);
    const Vector3 best = quadric_point(sheet, edit.removed, middle);
    const double owed = 6 * (sheet.swept(u) + sheet.swept(v));
    const Vector3 exact = with_volume(sheet, edit, best, middle, before, (b - a).norm());
    position = with_volume(sheet, edit, exact, middle, before - owed, pay);
  }
  for (int axis = 0; axis < 3; ++axis)
    if (has_axis(sheet.held_axes(edit.vertex), axis))
      position[axis] = middle[axis];
  return position;
}
} // namespace

bool propose_collapse(const EditableSheet& sheet, std::uint32_t side, double pay, Edit& edit, std::uint32_t onto) {
  const Mesh& mesh = sheet.mesh();
  if (!keeps_manifold(mesh, side))
    return false;
  const std::uint32_t u = mesh.from(side), v = mesh.to(side);
  Stays stays = which_stays(sheet, u, v);
  if (stays.vertex == no_index || (onto != no_index && stays.in_place && stays.vertex != onto))
    return false;
  if (onto != no_index)
    stays = {onto, true};
  const std::uint32_t kept = stays.vertex, gone = kept == u ? v : u;

  edit.clear();
  edit.kind = Edit::Kind::collapse;
  edit.vertex = kept;
  edit.removed_vertex = gone;
  make_fans(sheet, kept, stays.in_place, gone, edit);
  if (edit.added.empty())
    return false;
  const Vector3 a = sheet.at(kept), b = sheet.at(gone), middle = 0.5 * (a + b);
  edit.position = stays.in_place ? a : contracted(sheet, u, v, pay, edit);
  if ((edit.position - middle).norm() > 1.5 * (b - a).norm())
    return false;
  const double before = cone_volume(sheet, edit.removed, middle);
  edit.swept = mesh.on_rim(u) && mesh.on_rim(v) ? 0 : (six_cones(sheet, edit, middle) - before) / 6;
  if (stays.in_place)
    edit.parents = {{kept, 1, 1}, {gone, 0, 1}};
  else {
    const double along = std::clamp((edit.position - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    edit.parents = {{kept, 1 - along, 1}, {gone, along, 1}};
  }
  return true;
}

namespace {
// The three neighbours of an inner vertex of three triangles, in the order in which these turn.
Corners rim_of_pocket(const Mesh& mesh, std::uint32_t v) {
  std::array<std::uint32_t, 3> sides{};
  std::size_t count = 0;
  mesh.for_fan(v, [&](std::uint32_t side) { sides[count++] = side; });
  Corners rim{mesh.to(sides[0]), mesh.apex(sides[0]), no_index};
  for (const std::uint32_t side : sides)
    if (std::ranges::find(rim, mesh.to(side)) == rim.end())
      rim[2] = mesh.to(side);
  return rim;
}
} // namespace

bool propose_removal(const EditableSheet& sheet, std::uint32_t v, Edit& edit) {
  const Mesh& mesh = sheet.mesh();
  if (mesh.degree(v) != 3 || mesh.on_rim(v))
    return false;
  edit.clear();
  edit.kind = Edit::Kind::collapse;
  edit.removed_vertex = v;
  const Corners rim = rim_of_pocket(mesh, v);
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t w : rim)
    if (const double way = (sheet.at(w) - sheet.at(v)).norm();
        (sheet.held_by_touch(v) || sheet.held_within(v, w)) && way < least) {
      least = way;
      edit.vertex = w;
    }
  if (edit.vertex == no_index)
    return false;
  mesh.for_fan(v, [&](std::uint32_t side) { edit.removed.push_back(Mesh::triangle_of(side)); });
  edit.swept = -cone_volume(sheet, edit.removed, sheet.at(rim[0])) / 6;
  edit.added = {rim};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t twin = mesh.twin(mesh.find_side(rim[i], rim[(i + 1) % 3]));
    if (!may_lose_one(mesh, rim[i]) || (twin != no_index && mesh.apex(twin) == rim[(i + 2) % 3]))
      return false;
    if (twin == no_index)
      continue;
    edit.removed.push_back(Mesh::triangle_of(twin));
    edit.added.push_back(mesh.corners(Mesh::triangle_of(twin)));
  }
  edit.position = sheet.at(edit.vertex);
  edit.parents = {{edit.vertex, 1, 1}, {v, 0, 1}};
  // The triangle covers a part of each of the pocket's, and its neighbours themselves.
  const std::size_t old_count = edit.removed.size();
  edit.overlap.assign(edit.added.size() * old_count, 0);
  const double area = TriangleShape(sheet.at(rim[0]), sheet.at(rim[1]), sheet.at(rim[2])).area;
  for (std::size_t j = 0; j < 3; ++j)
    edit.overlap[j] = area / 3;
  for (std::size_t i = 1; i < edit.added.size(); ++i)
    edit.overlap[i * old_count + i + 2] = sheet.shape(edit.removed[i + 2]).area;
  return true;
}

} // namespace sheet::remesh
