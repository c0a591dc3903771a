// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/loose_springs.h"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include "libsheet/geometry/closest_points.h"

namespace sheet::collide {

namespace {

constexpr double kept_facing = 0.5; // cosine

// The index of the edge; no_index if there is none.
std::uint32_t edge_of(const Connectivity& mesh, std::uint32_t a, std::uint32_t b) {
  const Edge edge{std::min(a, b), std::max(a, b)};
  const auto at = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), edge);
  return at != mesh.edges.end() && *at == edge ? static_cast<std::uint32_t>(at - mesh.edges.begin()) : no_index;
}

bool has_triangle(const Connectivity& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const std::uint32_t edge = edge_of(mesh, a, b);
  if (edge == no_index)
    return false;
  const auto& beside = mesh.edge_triangles[edge];
  return std::any_of(beside.begin(), beside.end(), [&](std::uint32_t t) {
    return t != no_index && std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), c) != mesh.triangles[t].end();
  });
}

bool has_features(const Connectivity& mesh, const ContactSpring& s) {
  const auto& v = s.vertices;
  return s.of_vertex() ? has_triangle(mesh, v[1], v[2], v[3])
                       : edge_of(mesh, v[0], v[1]) != no_index && edge_of(mesh, v[2], v[3]) != no_index;
}

bool is_aside(const ContactSpring& s, std::span<const Vector3> x) {
  const Vector3 c = s.offset(x);
  return !s.welded() && !(s.normal.dot(c) > kept_facing * c.norm());
}

struct Force {
  double normal;      // [N], negative where it pushes
  Vector3 tangential; // [N]
};

Force force_of(const ContactSpring& s, std::span<const Vector3> x) {
  const Vector3 c = s.offset(x);
  return {s.stiffness[0] * s.gap(c), s.stiffness[1] * s.slide(c)};
}

} // namespace

void weld_anew(std::vector<ContactSpring>& springs, const Connectivity& mesh, std::span<const Vector3> positions) {
  std::vector<std::vector<std::uint32_t>> around; // the triangles of each vertex
  for (ContactSpring& s : springs) {
    if (!s.welded() || has_features(mesh, s))
      continue;
    if (around.empty()) {
      around.resize(mesh.vertices);
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t])
          around[v].push_back(t);
    }
    const ContactSpring old = s;
    const std::uint32_t vertex = old.vertices[0];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < 4; ++i)
      for (const std::uint32_t t : around[old.vertices[i]]) {
        const Corners& c = mesh.triangles[t];
        const auto closest =
            closest_vertex_triangle({positions[vertex], positions[c[0]], positions[c[1]], positions[c[2]]});
        if (const double distance = closest.offset.norm();
            distance < nearest && std::ranges::find(c, vertex) == c.end()) {
          nearest = distance;
          s.vertices = {vertex, c[0], c[1], c[2]};
          s.weights = closest.weights;
        }
      }
    const Vector3 change = s.offset(positions) - old.offset(positions);
    s.rest += s.normal.dot(change);
    s.anchor += change;
  }
}

LooseSprings take_loose(std::vector<ContactSpring>& springs, const Connectivity& mesh,
                        std::span<const Vector3> positions) {
  LooseSprings loose;
  std::erase_if(springs, [&](const ContactSpring& s) {
    const bool there = has_features(mesh, s);
    if (there && !is_aside(s, positions))
      return false;
    (there ? loose.aside : loose.without_features).push_back(s);
    return true;
  });
  return loose;
}

void hand_over(std::span<const ContactSpring> loose, std::span<const Vector3> positions,
               std::vector<ContactSpring>& springs) {
  if (loose.empty())
    return;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> at; // the springs of each vertex
  for (std::size_t i = 0; i < springs.size(); ++i)
    for (const std::uint32_t v : springs[i].vertices)
      at[v].push_back(i);
  for (const ContactSpring& old : loose) {
    std::map<std::size_t, int> shared; // number of vertices
    for (const std::uint32_t v : old.vertices)
      if (const auto found = at.find(v); found != at.end())
        for (const std::size_t i : found->second)
          if (std::abs(springs[i].normal.dot(old.normal)) > kept_facing)
            ++shared[i];
    int most = 0;
    for (const auto& [i, count] : shared)
      most = std::max(most, count);
    double stiffness = 0;
    for (const auto& [i, count] : shared)
      stiffness += count == most ? springs[i].stiffness[0] : 0;
    const Force force = force_of(old, positions);
    for (const auto& [i, count] : shared) {
      ContactSpring& s = springs[i];
      if (count != most || !(s.stiffness[0] > 0))
        continue;
      if (!old.welded())
        s.since = std::min(s.since, old.since);
      const double part = s.stiffness[0] / stiffness, sign = s.normal.dot(old.normal) > 0 ? 1 : -1;
      s.rest -= part * force.normal / s.stiffness[0];
      if (s.stiffness[1] > 0)
        s.anchor -= sign * part / s.stiffness[1] * force.tangential;
    }
  }
}

} // namespace sheet::collide
