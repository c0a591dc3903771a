// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/bath_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Of each vertex, by which face the bath reaches its piece of the sheet where that is not flooded and lies on nothing.
std::vector<BathReach> faces_of_pieces(const FloatingSheet& sheet, const Piled& piled, const Vector3& up) {
  constexpr double least_down = 0.1;    // of the area that lies on nothing
  constexpr double greatest_hole = 0.1; // of the area of what is closed but for it
  constexpr double least_room = 0.3;    // in that, of a sphere's of the same area
  struct Piece {
    Vector3 corners = Vector3::Zero(), across = Vector3::Zero();
    double count = 0, area = 0, cones = 0; // area and across: twice; cones: six times
    bool rim = false;
    double up = 0, lowest = 0; // of what lies on nothing, seen from above, and its area: twice
  };
  const auto& x = sheet.positions;
  std::vector<char> lies(x.size(), 0);
  for (const ContactSpring& s : piled.on)
    lies[s.vertices[0]] = 1;
  DisjointSets together(x.size());
  for (const auto& [a, b] : sheet.mesh.edges)
    together.join(a, b);
  const std::vector<std::uint64_t> piece = together.take();
  std::vector<Piece> pieces(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    pieces[piece[v]].corners += x[v];
    pieces[piece[v]].count += 1;
  }
  for (std::size_t e = 0; e < sheet.mesh.edges.size(); ++e)
    if (sheet.mesh.on_rim(e))
      pieces[piece[sheet.mesh.edges[e][0]]].rim = true;
  for (const Corners& c : sheet.mesh.triangles) {
    Piece& p = pieces[piece[c[0]]];
    const Vector3 normal = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
    p.across += normal;
    p.area += normal.norm();
    p.cones += (x[c[0]] - p.corners / p.count).dot(normal);
    if (std::ranges::none_of(c, [&](auto v) { return lies[v] != 0; })) {
      p.up += up.dot(normal);
      p.lowest += normal.norm();
    }
  }
  std::vector<BathReach> faces(x.size(), BathReach::below);
  for (std::size_t v = 0; v < x.size(); ++v) {
    const Piece& p = pieces[piece[v]];
    const double sphere = p.area / 2 * std::sqrt(p.area / 2) / (6 * std::sqrt(std::numbers::pi));
    if (p.across.norm() <= greatest_hole * p.area && p.cones / 6 > (p.rim ? least_room * sphere : 0))
      faces[v] = BathReach::outside;
    else if (p.up < -least_down * p.lowest)
      faces[v] = BathReach::facing;
  }
  return faces;
}

// Of each vertex, whether it lies on what the bath bears.
std::vector<char> borne_vertices(const FloatingSheet& sheet, const Piled& piled, const std::vector<char>& flooded,
                                 const std::vector<BathReach>& faces, const Vector3& up) {
  const auto& x = sheet.positions;
  std::vector<double> area(x.size(), 0); // seen from above, with its sign
  for (const Corners& c : sheet.mesh.triangles)
    for (const std::uint32_t v : c)
      area[v] += up.dot((x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]));
  std::vector<char> borne(x.size(), 0), bears(x.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    bears[v] = (faces[v] == BathReach::below ? area[v] : -area[v]) > 0 && flooded[v] == 0 ? 1 : 0;
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
  const std::vector<BathReach> faces = faces_of_pieces(sheet, piled, up);
  const std::vector<char> borne = borne_vertices(sheet, piled, flooded, faces, up);
  std::vector<BathReach> reach(sheet.positions.size());
  for (std::size_t v = 0; v < reach.size(); ++v)
    reach[v] = flooded[v] != 0 ? BathReach::around : borne[v] != 0 ? BathReach::none : faces[v];
  if (std::ranges::all_of(reach, [](BathReach r) { return r == BathReach::below; }))
    return {};
  return reach;
}

} // namespace sheet
