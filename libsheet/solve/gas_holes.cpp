// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/gas_holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/capped_volume.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;

constexpr std::string_view sealed = "gas.sealed"; // vertex, uint64, rule common: 1 where a rim was free at the start

// A rim edge, as its triangle runs along it, if that counts.
std::optional<Edge> rim_edge(const Connectivity& mesh, std::size_t e, std::span<const char> part) {
  if (!mesh.on_rim(e))
    return {};
  const auto [forward, backward] = mesh.edge_triangles[e];
  const std::uint32_t triangle = forward != no_index ? forward : backward;
  if (!part.empty() && part[triangle] == 0)
    return {};
  const auto [low, high] = mesh.edges[e];
  return forward != no_index ? Edge{low, high} : Edge{high, low};
}

// Those along which gas can leave.
std::vector<Edge> open_edges(const Connectivity& mesh, std::span<const double> clearances, std::span<const char> part) {
  std::vector<Edge> edges;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (const auto edge = rim_edge(mesh, e, part); edge && clearances[(*edge)[0]] + clearances[(*edge)[1]] > 0)
      edges.push_back(*edge);
  return edges;
}

// Open edges that hang together.
struct Hole {
  std::uint32_t start = no_index; // a vertex to which none of them leads, if there is one; else any
  bool chain = false;             // there is one
  Vector3 area = Vector3::Zero(); // as a vector, closed from the start [m²]
  double gap = 0;                 // under them [m²]
  Vector3 sum = Vector3::Zero();  // of their middles [m]
  double edges = 0;
};

std::map<std::uint64_t, Hole> holes_of(const Connectivity& mesh, std::span<const Vector3> x,
                                       std::span<const double> clearances, std::span<const Edge> edges) {
  DisjointSets sets(mesh.vertices);
  std::vector<char> entered(mesh.vertices, 0);
  for (const auto& [a, b] : edges) {
    sets.join(a, b);
    entered[b] = 1;
  }
  std::map<std::uint64_t, Hole> holes;
  for (const auto& [a, b] : edges) {
    Hole& hole = holes[sets.find(a)];
    const bool starts = entered[a] == 0;
    if (hole.start == no_index || (starts && !hole.chain)) {
      hole.start = a;
      hole.chain = starts;
    }
  }
  for (const auto& [a, b] : edges) {
    Hole& hole = holes[sets.find(a)];
    hole.area += (x[a] - x[hole.start]).cross(x[b] - x[hole.start]) / 2;
    hole.gap += (x[b] - x[a]).norm() * (clearances[a] + clearances[b]) / 2;
    hole.sum += (x[a] + x[b]) / 2;
    ++hole.edges;
  }
  return holes;
}

// By rims that lie on another layer, and welds.
void close_on_layers(const Frame& frame, std::vector<char>& closed) {
  for (const ContactSpring& spring : read_springs(frame))
    if (spring.of_vertex())
      closed[spring.vertices[0]] = 1;
}

std::vector<char> closed_vertices(const Scene& scene, const Frame& frame) {
  std::vector<char> closed(frame.vertices, 0);
  const std::vector<Axes> prescribed = scene::prescribed_axes(frame, scene, frame.time);
  const auto touched = touched_solids(frame, scene.solids.size());
  const auto marks = masks(frame, sealed);
  for (std::size_t v = 0; v < closed.size(); ++v)
    closed[v] = prescribed[v] != 0 || touched[v] != no_solid || (!marks.empty() && marks[v] != 0);
  close_on_layers(frame, closed);
  return closed;
}

// Over the nearest solid, less the thickness h there, half of which is between it and what touches it.
double clearance(const solid::Solids* solids, const Vector3& x, double h, double t) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; solids != nullptr && i < solids->size(); ++i)
    least = std::min(least, solids->at(i, x, t).distance - h);
  return std::max(0.0, least);
}

std::vector<std::uint32_t> rim_vertices(const Connectivity& mesh) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.on_rim(e))
      vertices.insert(vertices.end(), mesh.edges[e].begin(), mesh.edges[e].end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

double area_of(const Connectivity& mesh, std::span<const Vector3> x, std::uint32_t t) {
  const Corners& c = mesh.triangles[t];
  return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
}

// Whether it holds more than a tenth of the ball of its area.
bool hollow(const Connectivity& mesh, std::span<const Vector3> x, std::span<const char> part) {
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (part.empty() || part[t] != 0)
      area += area_of(mesh, x, t);
  return capped_volume(mesh, x, part) > 0.1 * std::pow(area, 1.5) / (6 * std::sqrt(std::numbers::pi));
}

} // namespace

RimClearances rim_clearances(const Scene& scene, const Frame& frame, const Connectivity& mesh,
                             const solid::Solids* solids) {
  RimClearances result;
  result.with_bath.assign(frame.vertices, 0);
  const std::vector<std::uint32_t> rim = rim_vertices(mesh);
  if (rim.empty())
    return result;
  const auto x = positions(frame);
  const std::vector<char> closed = closed_vertices(scene, frame);
  const std::vector<double> thickness = thickness_around(frame.vertices, mesh.triangles, volumes(frame),
                                                         [&](std::uint32_t t) { return area_of(mesh, x, t); });
  for (const std::uint32_t v : rim)
    if (closed[v] == 0)
      result.with_bath[v] = clearance(solids, x[v], thickness[v], frame.time);
  const auto up = scene::up(scene.environment);
  if (!up || !scene.environment.bath)
    return result;
  result.without = result.with_bath;
  result.depths.assign(frame.vertices, 0);
  for (const std::uint32_t v : rim) {
    result.depths[v] = scene.environment.bath->level - up->dot(x[v]);
    result.with_bath[v] = std::min(result.with_bath[v], std::max(0.0, -result.depths[v]));
  }
  return result;
}

std::span<const double> clearances_at(const RimClearances& clearances, const Connectivity& mesh,
                                      std::span<const Vector3> positions, std::span<const char> part, double weight,
                                      double pressure) {
  if (clearances.without.empty())
    return clearances.with_bath;
  double shallowest = std::numeric_limits<double>::infinity();
  for (const Edge& edge : open_edges(mesh, clearances.without, part))
    for (const std::uint32_t v : edge)
      if (clearances.depths[v] >= 0 && clearances.without[v] > 0)
        shallowest = std::min(shallowest, clearances.depths[v]);
  const bool holds = pressure <= weight * shallowest && hollow(mesh, positions, part);
  return holds ? clearances.with_bath : clearances.without;
}

GasHoles gas_holes(const Connectivity& mesh, std::span<const Vector3> positions, std::span<const double> clearances,
                   std::span<const char> part) {
  GasHoles all;
  const std::vector<Edge> edges = open_edges(mesh, clearances, part);
  for (const auto& [set, hole] : holes_of(mesh, positions, clearances, edges)) {
    const double area = std::min(hole.area.norm(), hole.gap);
    all.area += area;
    if (area >= all.widest) {
      all.widest = area;
      all.place = hole.sum / hole.edges;
    }
  }
  return all;
}

std::vector<char> still_enclosing(const Connectivity& mesh, std::span<const Vector3> positions,
                                  std::span<const double> clearances, std::span<const char> part) {
  DisjointSets pieces(mesh.vertices);
  for (const Corners& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  std::map<std::uint64_t, double> open; // of each piece with holes, what it holds [m³]
  for (const auto& [a, b] : open_edges(mesh, clearances, part))
    open[pieces.find(a)] = 0;
  std::vector<char> mask(mesh.triangles.size());
  const auto piece_of = [&](std::size_t t) { return pieces.find(mesh.triangles[t][0]); };
  for (auto& [piece, held] : open) {
    for (std::size_t t = 0; t < mask.size(); ++t)
      mask[t] = piece_of(t) == piece;
    held = capped_volume(mesh, positions, mask);
  }
  const auto fullest = std::ranges::max_element(open, {}, [](const auto& of) { return of.second; });
  for (std::size_t t = 0; t < mask.size(); ++t) {
    const std::uint64_t piece = piece_of(t);
    mask[t] = (part.empty() || part[t] != 0) && (!open.contains(piece) || piece == fullest->first);
  }
  return mask;
}

void seal_open_rims(const Scene& scene, Frame& frame, const solid::Solids* solids) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const RimClearances all = rim_clearances(scene, frame, mesh, solids);
  const std::vector<double>& clearances = all.without.empty() ? all.with_bath : all.without;
  if (std::ranges::none_of(clearances, [](double c) { return c > 0; }))
    return;
  const auto numbers = enclosures(frame);
  std::vector<char> encloses(frame.vertices, numbers.empty());
  for (std::size_t t = 0; t < numbers.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      encloses[v] = encloses[v] != 0 || numbers[t] != 0;
  formats::Array marks = formats::make_array(sealed, formats::Place::vertex, formats::Type::uint64, 1, "1",
                                             formats::Transfer::common, frame.vertices);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    marks.values<std::uint64_t>()[v] = clearances[v] > 0 && encloses[v] != 0;
  frame.put(std::move(marks));
}

} // namespace sheet
