// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/middle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/render/types.h"

namespace sheet::render {
namespace {

constexpr double smooth_turn = 6 * std::numbers::pi / 180;  // of an edge, that needs no parting
constexpr double rim_corner = 135 * std::numbers::pi / 180; // a rim with a smaller angle has a corner there
constexpr double smooth_edges = 0.99;                       // of all
constexpr int most_partings = 3;
constexpr float tight_turn = 0.5F, tightest_turn = 1; // of folds whose radius is two edges, and one [rad]

// For each vertex the length of the longest edge of the triangles around it [m].
std::vector<double> longest_edges(std::span<const Vector3> x, std::span<const Corners> triangles) {
  std::vector<double> longest(x.size(), 0);
  for (const Corners& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (x[t[(i + 1) % 3]] - x[t[i]]).norm();
      for (const std::uint32_t v : t)
        longest[v] = std::max(longest[v], length);
    }
  return longest;
}

// Single triangles that are crushed in corners of solids for a moment would stand out as spikes: what a vertex has
// beyond half as much again as the mean around it, where it is twice as thick as edges are long, is drawn around it.
// The volume stays.
void lower_spikes(std::span<const Vector3> x, std::span<const Corners> triangles, std::span<const double> areas,
                  std::vector<double>& thickness) {
  constexpr double edges = 2, means = 1.5; // by which it is a spike
  constexpr int rounds = 8;                // as what is drawn around may be too much there
  const std::vector<double> longest = longest_edges(x, triangles);
  const auto is_thick = [&](std::uint32_t v) { return thickness[v] > edges * longest[v]; };
  if (std::ranges::none_of(triangles, [&](const Corners& t) { return std::ranges::any_of(t, is_thick); }))
    return;
  std::vector<std::vector<std::uint32_t>> around(x.size()); // each neighbour twice, or once along a rim
  for (const Corners& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      around[t[i]].insert(around[t[i]].end(), {t[(i + 1) % 3], t[(i + 2) % 3]});
  const std::vector<double> area = vertex_shares(x.size(), triangles, [&](std::uint32_t t) { return areas[t]; });
  for (int round = 0; round < rounds; ++round)
    for (std::uint32_t v = 0; v < x.size(); ++v) {
      if (!is_thick(v))
        continue;
      double whole = 0, volume = 0;
      for (const std::uint32_t w : around[v]) {
        whole += area[w];
        volume += area[w] * thickness[w];
      }
      const double excess = thickness[v] - means * volume / whole;
      if (!(excess > 0))
        continue;
      thickness[v] -= excess;
      for (const std::uint32_t w : around[v])
        thickness[w] += excess * area[v] / whole;
    }
}

std::vector<double> thickness_of(std::span<const Vector3> x, std::span<const Corners> triangles,
                                 std::span<const double> volumes, std::span<const double> areas) {
  std::vector<double> thickness =
      thickness_around(x.size(), triangles, volumes, [&](std::uint32_t t) { return areas[t]; });
  lower_spikes(x, triangles, areas, thickness);
  return thickness;
}

// Two ends in order, the corners opposite of them, and how many triangles have the edge.
struct MeshEdge {
  std::uint32_t low, high;
  std::array<std::uint32_t, 2> opposite;
  int triangles;
};

// How a vertex moves with those around it.
enum class Role : std::uint8_t { inner, rim, corner };

struct Mesh {
  std::vector<MeshEdge> edges;                     // ascending
  std::vector<std::array<std::uint32_t, 3>> sides; // of each triangle: the edge from its corner i to i + 1
  std::vector<Role> roles;
  std::vector<std::vector<std::uint32_t>> around; // neighbours that count: of a rim's vertex its two on the rim
};

void find_edges(std::span<const Corners> triangles, Mesh& mesh) {
  struct Half {
    std::uint32_t low, high, opposite, triangle, side;
  };
  std::vector<Half> halves;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3], c = triangles[t][(i + 2) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), c, t, i});
    }
  std::ranges::sort(halves, {}, [](const Half& h) { return std::array{h.low, h.high, h.triangle, h.side}; });
  mesh.sides.resize(triangles.size());
  for (const Half& h : halves) {
    if (mesh.edges.empty() || mesh.edges.back().low != h.low || mesh.edges.back().high != h.high)
      mesh.edges.push_back({h.low, h.high, {h.opposite, h.opposite}, 0});
    MeshEdge& edge = mesh.edges.back();
    edge.opposite[edge.triangles > 0 ? 1 : 0] = h.opposite;
    ++edge.triangles;
    mesh.sides[h.triangle][h.side] = static_cast<std::uint32_t>(mesh.edges.size() - 1);
  }
}

Mesh mesh_of(std::size_t vertices, std::span<const Corners> triangles) {
  Mesh mesh;
  find_edges(triangles, mesh);
  mesh.roles.assign(vertices, Role::inner);
  mesh.around.resize(vertices);
  for (const MeshEdge& e : mesh.edges)
    for (const std::uint32_t v : {e.low, e.high})
      if (e.triangles > 2)
        mesh.roles[v] = Role::corner;
      else if (e.triangles == 1 && mesh.roles[v] == Role::inner)
        mesh.roles[v] = Role::rim;
  for (const MeshEdge& e : mesh.edges)
    for (const auto& [v, other] : {std::pair{e.low, e.high}, std::pair{e.high, e.low}})
      if (mesh.roles[v] == Role::inner || (mesh.roles[v] == Role::rim && e.triangles == 1))
        mesh.around[v].push_back(other);
  for (std::size_t v = 0; v < vertices; ++v) // where rims meet
    if (mesh.roles[v] == Role::rim && mesh.around[v].size() != 2)
      mesh.roles[v] = Role::corner;
  return mesh;
}

// Corners of the rim of the sheet itself; finer rims have none besides.
void find_corners(std::span<const Vector3> x, Mesh& mesh) {
  for (std::size_t v = 0; v < x.size(); ++v)
    if (mesh.roles[v] == Role::rim) {
      const Vector3 to = x[mesh.around[v][0]] - x[v], from = x[mesh.around[v][1]] - x[v];
      if (std::atan2(to.cross(from).norm(), to.dot(from)) < rim_corner)
        mesh.roles[v] = Role::corner;
    }
}

// Loop's weight of each neighbour of a vertex with so many [Warren 1995].
double loop_weight(std::size_t neighbours) {
  return neighbours == 3 ? 3.0 / 16 : 3.0 / (8 * static_cast<double>(neighbours));
}

// x with the part `share` of each neighbour.
Vector3 mixed(std::span<const Vector3> x, std::size_t v, std::span<const std::uint32_t> around, double share) {
  Vector3 sum = (1 - share * static_cast<double>(around.size())) * x[v];
  for (const std::uint32_t other : around)
    sum += share * x[other];
  return sum;
}

// Where subdivision without end takes the control point v.
Vector3 limit(std::span<const Vector3> x, const Mesh& mesh, std::size_t v) {
  const auto& around = mesh.around[v];
  if (mesh.roles[v] == Role::corner || around.empty())
    return x[v];
  if (mesh.roles[v] == Role::rim)
    return mixed(x, v, around, 1.0 / 6);
  return mixed(x, v, around, 1 / (static_cast<double>(around.size()) + 3 / (8 * loop_weight(around.size()))));
}

std::vector<Vector3> limits(std::span<const Vector3> x, const Mesh& mesh) {
  std::vector<Vector3> result;
  for (std::size_t v = 0; v < x.size(); ++v)
    result.push_back(limit(x, mesh, v));
  return result;
}

// By how much the surface turns over each edge [rad]; 0 where there are not two triangles.
std::vector<double> turns_of_edges(const Middle& middle, const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> sides(mesh.edges.size());
  std::vector<std::size_t> found(mesh.edges.size(), 0);
  for (std::uint32_t t = 0; t < middle.triangles.size(); ++t)
    for (const std::uint32_t e : mesh.sides[t])
      if (found[e] < 2)
        sides[e][found[e]++] = t;
  std::vector<double> turns(mesh.edges.size(), 0);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.edges[e].triangles == 2) {
      const Vector3 a = area_normal(middle.positions, middle.triangles[sides[e][0]]),
                    b = area_normal(middle.positions, middle.triangles[sides[e][1]]);
      turns[e] = std::atan2(a.cross(b).norm(), a.dot(b));
    }
  return turns;
}

// By how much the surface turns over nearly all inner edges [rad].
double turn_of_most(const Mesh& mesh, std::span<const double> turns) {
  std::vector<double> inner;
  for (std::size_t e = 0; e < turns.size(); ++e)
    if (mesh.edges[e].triangles == 2)
      inner.push_back(turns[e]);
  if (inner.empty())
    return 0;
  const auto at = inner.begin() + static_cast<std::ptrdiff_t>(smooth_edges * static_cast<double>(inner.size() - 1));
  std::ranges::nth_element(inner, at);
  return *at;
}

// Control points of a surface that goes near to x, but where folds are as tight as edges are long: what is moved out
// there would stand out between the edges, one bump a vertex.
std::vector<Vector3> control_points(std::span<const Vector3> x, const Mesh& mesh, std::span<const double> turns) {
  std::vector<double> sharpest(x.size(), 0);
  for (std::size_t e = 0; e < turns.size(); ++e)
    for (const std::uint32_t v : {mesh.edges[e].low, mesh.edges[e].high})
      sharpest[v] = std::max(sharpest[v], turns[e]);
  const std::vector<Vector3> there = limits(x, mesh);
  std::vector<Vector3> control;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const float tight = smooth_step(tight_turn, tightest_turn, static_cast<float>(sharpest[v]));
    control.push_back(x[v] + static_cast<double>(1 - tight) * (x[v] - there[v]));
  }
  return control;
}

// A triangle's parts: at its corners in their order, and the one in the middle.
std::array<Corners, 4> parts_of(const Corners& t, const std::array<std::uint32_t, 3>& sides, std::uint32_t first) {
  const std::uint32_t ab = first + sides[0], bc = first + sides[1], ca = first + sides[2];
  return {Corners{t[0], ab, ca}, Corners{ab, t[1], bc}, Corners{ca, bc, t[2]}, Corners{ab, bc, ca}};
}

// One round of subdivision. Vertices keep their numbers, those of edges follow, between the ends that `parents` gets.
// The corners of `mesh` stay corners.
void part(Middle& middle, Mesh& mesh, std::vector<std::array<std::uint32_t, 2>>& parents) {
  const std::vector<Vector3> x = std::move(middle.positions);
  middle.positions.clear();
  for (std::size_t v = 0; v < x.size(); ++v)
    middle.positions.push_back(
        mesh.roles[v] == Role::corner || mesh.around[v].empty()
            ? x[v]
            : mixed(x, v, mesh.around[v], mesh.roles[v] == Role::rim ? 1.0 / 8 : loop_weight(mesh.around[v].size())));
  for (const MeshEdge& e : mesh.edges) {
    const Vector3 ends = x[e.low] + x[e.high];
    middle.positions.push_back(
        e.triangles == 2 ? Vector3(3.0 / 8 * ends + 1.0 / 8 * (x[e.opposite[0]] + x[e.opposite[1]])) : 0.5 * ends);
    parents.push_back({e.low, e.high});
  }
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> source;
  for (std::size_t t = 0; t < middle.triangles.size(); ++t)
    for (const Corners& part : parts_of(middle.triangles[t], mesh.sides[t], static_cast<std::uint32_t>(x.size()))) {
      triangles.push_back(part);
      source.push_back(middle.source_triangle[t]);
    }
  middle.triangles = std::move(triangles);
  middle.source_triangle = std::move(source);
  const std::vector<Role> roles = std::move(mesh.roles);
  mesh = mesh_of(middle.positions.size(), middle.triangles);
  for (std::size_t v = 0; v < roles.size(); ++v)
    if (roles[v] == Role::corner)
      mesh.roles[v] = Role::corner;
}

// Half of the edges are as long [m].
double median_edge(std::span<const Vector3> x, const Mesh& mesh) {
  std::vector<double> lengths;
  for (const MeshEdge& e : mesh.edges)
    lengths.push_back((x[e.high] - x[e.low]).norm());
  if (lengths.empty())
    return 0;
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, at);
  return *at;
}

// How often triangles are parted in four, and how far the last parts lie where they belong: 0 on those of the parting
// before, 1 all the way. Rises from 0 where a parting begins to be worth while, so that films do not jump there.
struct Partings {
  int count = 0;
  double last = 1;
};

// Of triangles whose edges turn by that.
Partings partings_of(const Middle& middle, const Mesh& mesh, double turn, const PartingLimits& until) {
  constexpr double by_turn = 0.25, by_chord = 1, by_number = 0.2; // the widths in which it rises to 1
  const double edge = median_edge(middle.positions, mesh);
  if (!(turn > smooth_turn))
    return {};
  const double wanted = std::log2(turn / smooth_turn);
  int partings = std::min(most_partings, static_cast<int>(std::ceil(wanted)));
  const double chord = edge * turn / 8; // its height; a quarter of that in halves that turn by half as much
  while (partings > 0 && (middle.triangles.size() << (2 * partings) > until.most_triangles ||
                          std::ldexp(chord, -2 * (partings - 1)) < until.flat))
    --partings;
  if (partings == 0)
    return {};
  const double number = std::ldexp(static_cast<double>(middle.triangles.size()), 2 * partings);
  const double last =
      std::min({(wanted - (partings - 1)) / by_turn,
                until.flat > 0 ? (std::ldexp(chord, -2 * (partings - 1)) / until.flat - 1) / by_chord : 1,
                (static_cast<double>(until.most_triangles) / number - 1) / by_number});
  return {partings, std::clamp(last, 0.0, 1.0)};
}

// Draws the last parting's points back as far as its fineness says. `coarse`: the middle before all partings, if that
// was the only one.
void draw_back(Middle& middle, const Middle* coarse) {
  const double back = 1 - middle.fineness;
  std::vector<Vector3>& x = middle.positions;
  for (std::size_t v = 0; coarse != nullptr && v < coarse->positions.size(); ++v)
    x[v] += back * (coarse->positions[v] - x[v]);
  std::size_t point = x.size() - middle.of_edges.size();
  for (const auto& [a, b] : middle.of_edges) {
    x[point] += back * ((x[a] + x[b]) / 2 - x[point]);
    ++point;
  }
}

// Of the vertices of `coarse`, whose triangles are as large as their parts on `smooth`.
std::vector<double> thickness_on(const Middle& smooth, const Middle& coarse, std::span<const double> volumes) {
  std::vector<double> area_of(volumes.size(), 0);
  for (std::size_t t = 0; t < smooth.triangles.size(); ++t)
    area_of[smooth.source_triangle[t]] += area_normal(smooth.positions, smooth.triangles[t]).norm();
  std::vector<double> volume, area;
  for (const std::uint32_t source : coarse.source_triangle) {
    volume.push_back(volumes[source]);
    area.push_back(area_of[source]);
  }
  return thickness_of(coarse.positions, coarse.triangles, volume, area);
}

} // namespace

Vector3 area_normal(std::span<const Vector3> x, const Corners& t) {
  return (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]) / 2;
}

std::vector<double> vertex_thickness(const formats::Frame& frame) {
  const auto x = positions(frame);
  std::vector<double> areas;
  for (const Corners& t : sheet::triangles(frame))
    areas.push_back(area_normal(x, t).norm());
  return thickness_of(x, sheet::triangles(frame), volumes(frame), areas);
}

Middle middle_of(const formats::Frame& frame) {
  const auto x = positions(frame);
  Middle middle{{x.begin(), x.end()}, vertex_thickness(frame), {}, {}};
  const auto all = sheet::triangles(frame);
  for (std::uint32_t t = 0; t < all.size(); ++t)
    if (area_normal(x, all[t]).norm() > 0) {
      middle.triangles.push_back(all[t]);
      middle.source_triangle.push_back(t);
    }
  return middle;
}

Middle smoothed(const Middle& middle, std::span<const double> volumes, const PartingLimits& until) {
  Mesh mesh = mesh_of(middle.positions.size(), middle.triangles);
  const std::vector<double> turns = turns_of_edges(middle, mesh);
  const Partings partings = partings_of(middle, mesh, turn_of_most(mesh, turns), until);
  if (partings.count == 0)
    return middle;
  find_corners(middle.positions, mesh);
  Middle result = middle;
  result.positions = control_points(middle.positions, mesh, turns);
  std::vector<std::array<std::uint32_t, 2>> parents;
  std::size_t before_last = 0; // parents
  for (int i = 0; i < partings.count; ++i) {
    before_last = parents.size();
    part(result, mesh, parents);
  }
  result.positions = limits(result.positions, mesh);
  result.of_edges.assign(parents.begin() + static_cast<std::ptrdiff_t>(before_last), parents.end());
  result.fineness = partings.last;
  draw_back(result, partings.count == 1 ? &middle : nullptr);
  result.thickness = thickness_on(result, middle, volumes);
  for (const auto& [a, b] : parents)
    result.thickness.push_back(0.5 * (result.thickness[a] + result.thickness[b]));
  return result;
}

} // namespace sheet::render
