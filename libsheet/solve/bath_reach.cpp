// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/bath_reach.h"

#include <algorithm>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double least_over = 0.5; // cosine between up and the normal of what lies on a layer

// Springs between a vertex and a triangle under it, or over it.
struct Piled {
  std::vector<ContactSpring> on, under; // what the vertex does to the triangle

  Piled(std::span<const ContactSpring> contacts, const Vector3& up) {
    for (const ContactSpring& s : contacts)
      if (s.of_vertex() && s.normal.dot(up) > least_over)
        on.push_back(s);
      else if (s.of_vertex() && s.normal.dot(up) < -least_over)
        under.push_back(s);
  }
};

// Whether most of the triangle of a spring is so.
bool is_so(const std::vector<char>& of_vertices, const ContactSpring& spring) {
  double part = 0;
  for (std::size_t i = 1; i < 4; ++i)
    part -= of_vertices[spring.vertices[i]] != 0 ? spring.weights[i] : 0;
  return part >= 0.5;
}

// Of each vertex, whether the bath would stand above it and all that lies on it.
std::vector<char> deep_vertices(const FloatingSheet& sheet, const Piled& piled, const Vector3& up, double level) {
  const auto& x = sheet.positions;
  std::vector<double> top = thickness_around(x.size(), sheet.mesh.triangles, sheet.volumes, [&](std::uint32_t t) {
    const Corners& c = sheet.mesh.triangles[t];
    return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  });
  for (std::size_t v = 0; v < x.size(); ++v)
    top[v] += up.dot(x[v]) - level;
  bool more = true;
  const auto raise = [&](std::uint32_t below, std::uint32_t above) {
    more = more || top[below] < top[above];
    top[below] = std::max(top[below], top[above]);
  };
  while (more) { // a layer in each round
    more = false;
    for (const ContactSpring& s : piled.on)
      for (std::size_t i = 1; i < 4; ++i)
        raise(s.vertices[i], s.vertices[0]);
    for (const ContactSpring& s : piled.under)
      for (std::size_t i = 1; i < 4; ++i)
        raise(s.vertices[0], s.vertices[i]);
  }
  std::vector<char> deep(x.size());
  std::ranges::transform(top, deep.begin(), [](double height) { return height < 0 ? 1 : 0; });
  return deep;
}

// Of each vertex, whether it can be reached from a rim over vertices that are as deep.
std::vector<char> flooded_vertices(const FloatingSheet& sheet, const Piled& piled, const std::vector<char>& deep) {
  const std::size_t vertices = deep.size();
  std::vector<char> lies(vertices, 0), open(vertices, 0), flooded(vertices, 0);
  for (const ContactSpring& s : piled.on)
    lies[s.vertices[0]] = 1;
  DisjointSets together(vertices);
  for (std::size_t e = 0; e < sheet.mesh.edges.size(); ++e) {
    const auto [a, b] = sheet.mesh.edges[e];
    if (deep[a] != 0 && deep[b] != 0)
      together.join(a, b);
    for (const std::uint32_t v : {a, b})
      if (sheet.mesh.on_rim(e) && deep[v] != 0 && sheet.shut[v] == 0)
        open[v] = 1;
  }
  const std::vector<std::uint64_t> piece = together.take();
  std::vector<char> wet(vertices, 0); // of pieces, by their numbers
  for (std::size_t v = 0; v < vertices; ++v)
    if (open[v] != 0 && lies[v] == 0)
      wet[piece[v]] = 1;
  for (bool more = true; more;) { // a layer in each round
    more = false;
    for (std::size_t v = 0; v < vertices; ++v)
      flooded[v] = deep[v] != 0 ? wet[piece[v]] : 0;
    for (const ContactSpring& s : piled.on)
      if (const std::uint32_t v = s.vertices[0]; open[v] != 0 && wet[piece[v]] == 0 && is_so(flooded, s)) {
        wet[piece[v]] = 1;
        more = true;
      }
  }
  return flooded;
}

// Of each vertex, whether it lies on what the bath bears.
std::vector<char> borne_vertices(const FloatingSheet& sheet, const Piled& piled, const std::vector<char>& flooded,
                                 const Vector3& up) {
  const auto& x = sheet.positions;
  std::vector<double> area(x.size(), 0); // seen from above, with its sign
  for (const Corners& c : sheet.mesh.triangles)
    for (const std::uint32_t v : c)
      area[v] += up.dot((x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]));
  std::vector<char> borne(x.size(), 0), bears(x.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    bears[v] = area[v] > 0 && flooded[v] == 0 ? 1 : 0;
  for (bool more = true; more;) { // a layer in each round
    more = false;
    for (const ContactSpring& spring : piled.on)
      if (const std::uint32_t v = spring.vertices[0]; borne[v] == 0 && flooded[v] == 0 && is_so(bears, spring)) {
        borne[v] = bears[v] = 1;
        more = true;
      }
  }
  return borne;
}

} // namespace

std::vector<BathReach> bath_reach(const FloatingSheet& sheet, const Vector3& up, double level) {
  const Piled piled(sheet.contacts, up);
  const std::vector<char> flooded = flooded_vertices(sheet, piled, deep_vertices(sheet, piled, up, level));
  const std::vector<char> borne = borne_vertices(sheet, piled, flooded, up);
  std::vector<BathReach> reach(sheet.positions.size());
  for (std::size_t v = 0; v < reach.size(); ++v)
    reach[v] = flooded[v] != 0 ? BathReach::around : borne[v] != 0 ? BathReach::none : BathReach::below;
  if (std::ranges::all_of(reach, [](BathReach r) { return r == BathReach::below; }))
    return {};
  return reach;
}

} // namespace sheet
