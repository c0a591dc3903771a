// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/spring_feet.h"

#include <algorithm>
#include <set>
#include <utility>

#include "libsheet/base/each.h"

namespace sheet::collide {

namespace {

constexpr int farthest_walk = 8;          // triangles
constexpr double least_beside = 0.258819; // sine of 15 degrees

// Where a vertex stands on a triangle; weights in the order of its corners.
struct SpringFoot {
  std::uint32_t triangle = no_index;
  ClosestPoints at;
};

std::array<std::uint32_t, 4> vertices_of(const Connectivity& mesh, std::uint32_t vertex, std::uint32_t triangle) {
  const Corners& c = mesh.triangles[triangle];
  return {vertex, c[0], c[1], c[2]};
}

SpringFoot foot_on(const Connectivity& mesh, std::uint32_t vertex, std::uint32_t triangle, std::span<const Vector3> x) {
  const Corners& c = mesh.triangles[triangle];
  return {triangle, closest_vertex_triangle({x[vertex], x[c[0]], x[c[1]], x[c[2]]})};
}

// The triangle beyond the edge opposite to a corner; no_index at the border.
std::uint32_t across(const Connectivity& mesh, std::uint32_t triangle, std::size_t corner) {
  const auto [one, other] = mesh.edge_triangles[mesh.triangle_edges[triangle][corner]];
  return one == triangle ? other : one;
}

// The triangles round a corner of one, without it: one way round, and from a border the other way.
template <class Visit>
void each_round(const Connectivity& mesh, std::uint32_t triangle, std::size_t corner, Visit visit) {
  const std::uint32_t vertex = mesh.triangles[triangle][corner];
  for (const std::size_t way : {std::size_t{1}, std::size_t{2}}) {
    std::uint32_t from = triangle, at = across(mesh, triangle, (corner + way) % 3);
    while (at != no_index && at != triangle) {
      visit(at);
      std::size_t next = 0; // the corner opposite to the edge at the vertex by which it was not entered
      while (mesh.triangles[at][next] == vertex || across(mesh, at, next) == from)
        ++next;
      from = std::exchange(at, across(mesh, at, next));
    }
    if (at == triangle)
      return;
  }
}

// The triangles that share with a foot's one the edge or corner on which it stands.
template <class Visit> void each_beside(const Connectivity& mesh, const SpringFoot& foot, Visit visit) {
  const auto& w = foot.at.weights;
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (const std::size_t next = (corner + 1) % 3, last = (corner + 2) % 3; w[next + 1] == 0 && w[last + 1] == 0)
      return each_round(mesh, foot.triangle, corner, visit);
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (const std::uint32_t t = w[corner + 1] == 0 ? across(mesh, foot.triangle, corner) : no_index; t != no_index)
      visit(t);
}

// From triangle to triangle, as long as the vertex is nearer to the next one.
SpringFoot walk(const Connectivity& mesh, std::uint32_t vertex, std::uint32_t from, std::span<const Vector3> x) {
  SpringFoot foot = foot_on(mesh, vertex, from, x);
  for (int step = 0; step < farthest_walk; ++step) {
    SpringFoot nearest = foot;
    each_beside(mesh, foot, [&](std::uint32_t t) {
      if (std::ranges::find(mesh.triangles[t], vertex) != mesh.triangles[t].end())
        return;
      if (const SpringFoot there = foot_on(mesh, vertex, t, x);
          there.at.offset.squaredNorm() < nearest.at.offset.squaredNorm())
        nearest = there;
    });
    if (nearest.triangle == foot.triangle)
      break;
    foot = nearest;
  }
  return foot;
}

// Off its triangle's normal, where that triangle's edge or corner on which it stands is on the mesh's border.
bool is_beside_border(const Connectivity& mesh, const SpringFoot& foot, std::span<const Vector3> x) {
  bool border = false;
  for (std::size_t corner = 0; corner < 3; ++corner)
    border = border || (foot.at.weights[corner + 1] == 0 && across(mesh, foot.triangle, corner) == no_index);
  if (!border)
    return false;
  const Corners& c = mesh.triangles[foot.triangle];
  const Vector3 normal = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).normalized(), &offset = foot.at.offset;
  return (offset - normal.dot(offset) * normal).squaredNorm() > least_beside * least_beside * offset.squaredNorm();
}

bool slides(const ContactSpring& s) { return s.of_vertex() && !s.welded() && s.stiffness[1] == 0; }

} // namespace

bool beside_border(const Connectivity& mesh, const std::array<std::uint32_t, 4>& v,
                   std::span<const Vector3> positions) {
  const std::uint32_t triangle = triangle_of(mesh, {v[1], v[2], v[3]});
  return triangle != no_index && is_beside_border(mesh, foot_on(mesh, v[0], triangle, positions), positions);
}

std::vector<ContactSpring> let_feet_slide(std::vector<ContactSpring>& springs, std::vector<double>& had,
                                          const Connectivity& mesh, std::span<const Vector3> positions) {
  std::vector<std::uint32_t> on(springs.size(), no_index); // where it has its foot; no_index: it goes
  const std::vector<ContactSpring> before = springs;
  each_in_parallel(springs.size(), [&](std::size_t i) {
    ContactSpring& s = springs[i];
    if (!slides(s))
      return;
    const std::uint32_t from = triangle_of(mesh, {s.vertices[1], s.vertices[2], s.vertices[3]});
    const SpringFoot foot = walk(mesh, s.vertices[0], from, positions);
    if (is_beside_border(mesh, foot, positions))
      return;
    on[i] = foot.triangle;
    if (!(foot.at.offset.dot(s.normal) > 0))
      return;
    s.vertices = vertices_of(mesh, s.vertices[0], foot.triangle);
    s.weights = foot.at.weights;
    s.normal = foot.at.offset.normalized();
    s.anchor = foot.at.offset;
  });
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken; // vertex and triangle
  std::vector<ContactSpring> out;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (slides(springs[i]) && (on[i] == no_index || !taken.emplace(springs[i].vertices[0], on[i]).second)) {
      out.push_back(before[i]);
    } else {
      had[kept] = had[i];
      springs[kept++] = springs[i];
    }
  springs.resize(kept);
  had.resize(kept);
  return out;
}

} // namespace sheet::collide
