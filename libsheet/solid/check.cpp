// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "libsheet/base/error.h"
#include "libsheet/geometry/box_tree.h"
#include "libsheet/geometry/coincident.h"
#include "libsheet/geometry/triangle_pair.h"

namespace sheet::solid {
namespace {

using Triangles = std::vector<std::uint32_t>;

std::string written(const Vector3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()); }

void check_points(const SolidSurface& surface, const std::string& name) {
  if (surface.triangles.size() < 4)
    fail(ExitCode::bad_input, "{}: {} triangles; a closed surface has at least 4", name, surface.triangles.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    if (!surface.points[i].allFinite())
      fail(ExitCode::bad_input, "{}: vertex {} is not finite; export the mesh again", name, i);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vector3& x = surface.points[a];
    const Vector3 u = surface.points[b] - x, v = surface.points[c] - x;
    if (u.cross(v).norm() <= 1e-14 * std::max(u.squaredNorm(), v.squaredNorm()))
      fail(ExitCode::bad_input, "{}: triangle {} at {} has no area; collapse or remove such triangles", name, t,
           written(x));
  }
}

// How many of these points are as good as another one.
std::size_t lie_on_each_other(const std::vector<Vector3>& points) {
  Box3 box;
  for (const Vector3& x : points)
    box.extend(x);
  constexpr double close = 1e-6; // of the whole
  return static_cast<std::size_t>(std::ranges::count(coincident(points, close * box.diagonal().norm()), true));
}

// Fails if there are open edges, with these middles, the first at `where`.
void refuse_open(const std::vector<Vector3>& middles, const std::string& where, const std::string& name) {
  if (middles.empty())
    return;
  const std::size_t open = middles.size(), together = lie_on_each_other(middles);
  if (together == open)
    fail(ExitCode::bad_input,
         "{}: the surface is open along {} edges that lie on each other, the first at {}: weld its vertices (merge "
         "those at the same place)",
         name, open, where);
  if (together > 0)
    fail(ExitCode::bad_input,
         "{}: the surface is open along {} edges, the first at {}; {} of them lie on each other: weld its vertices "
         "(merge those at the same place), and close the holes that remain",
         name, open, where, together);
  fail(ExitCode::bad_input,
       "{}: the surface is open along {} edges, the first at {}; close its holes (a solid is a body: ground that is "
       "a height field needs sides and a bottom)",
       name, open, where);
}

// The neighbour of each triangle across each side; fails where a side has not exactly one.
std::vector<std::array<std::uint32_t, 3>> check_closed(const SolidSurface& surface, const std::string& name) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sides; // directed, with their triangle
  const auto at = [&](std::uint32_t a, std::uint32_t b) {
    return written((surface.points[a] + surface.points[b]) / 2);
  };
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
      if (!sides.emplace(std::pair(a, b), t).second)
        fail(ExitCode::bad_input,
             "{}: two triangles run the same way along the edge at {}: faces are turned different ways, or more than "
             "two meet; orient them alike and split such edges",
             name, at(a, b));
    }
  std::vector<std::array<std::uint32_t, 3>> neighbours(surface.triangles.size());
  std::string where;
  std::vector<Vector3> middles; // of open edges
  for (const auto& [side, t] : sides) {
    const auto other = sides.find({side.second, side.first});
    if (other == sides.end()) {
      if (middles.empty())
        where = at(side.first, side.second);
      middles.emplace_back((surface.points[side.first] + surface.points[side.second]) / 2);
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (surface.triangles[t][i] == side.first)
        neighbours[t][i] = other->second;
  }
  refuse_open(middles, where, name);
  return neighbours;
}

// The connected parts of the surface.
std::vector<Triangles> parts_of(const std::vector<std::array<std::uint32_t, 3>>& neighbours) {
  std::vector<Triangles> parts;
  std::vector<bool> seen(neighbours.size(), false);
  for (std::uint32_t first = 0; first < neighbours.size(); ++first) {
    if (seen[first])
      continue;
    Triangles part{first};
    seen[first] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const std::uint32_t next : neighbours[part[i]])
        if (!seen[next]) {
          seen[next] = true;
          part.push_back(next);
        }
    parts.push_back(std::move(part));
  }
  return parts;
}

double volume_of(const SolidSurface& surface, const Triangles& part) {
  const Vector3 origin = surface.points[surface.triangles[part.front()][0]];
  double sum = 0;
  for (const std::uint32_t t : part) {
    const auto& [a, b, c] = surface.triangles[t];
    sum += (surface.points[a] - origin).dot((surface.points[b] - origin).cross(surface.points[c] - origin));
  }
  return sum / 6;
}

// How often a part's surface winds round x [Van Oosterom, Strackee 1983].
double winding(const SolidSurface& surface, const Triangles& part, const Vector3& x) {
  double sum = 0;
  for (const std::uint32_t t : part) {
    const Vector3 a = surface.points[surface.triangles[t][0]] - x, b = surface.points[surface.triangles[t][1]] - x,
                  c = surface.points[surface.triangles[t][2]] - x;
    const double p = a.norm(), q = b.norm(), r = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), p * q * r + a.dot(b) * r + b.dot(c) * p + c.dot(a) * q);
  }
  return sum / (2 * std::numbers::pi);
}

std::vector<double> check_volumes(const SolidSurface& surface, const std::vector<Triangles>& parts,
                                  const std::string& name) {
  Box3 box;
  for (const Vector3& x : surface.points)
    box.extend(x);
  std::vector<double> volumes;
  for (const Triangles& part : parts) {
    volumes.push_back(volume_of(surface, part));
    if (std::abs(volumes.back()) <= 1e-12 * std::pow(box.diagonal().norm(), 3))
      fail(ExitCode::bad_input, "{}: the surface at {} encloses no volume; give it some, or take it away", name,
           written(surface.points[surface.triangles[part.front()][0]]));
  }
  return volumes;
}

// Parts face outward, those inside another one inward: the walls of hollows. What is wrong with that; "" if nothing is.
std::string fault_of_sides(const SolidSurface& surface, const std::vector<Triangles>& parts,
                           const std::vector<double>& volumes) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Vector3& x = surface.points[surface.triangles[parts[i].front()][0]];
    double around = 0; // of the others, whichever way they face
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (k != i)
        around += std::abs(winding(surface, parts[k], x));
    const bool hollow = std::lround(around) % 2 == 1;
    if (hollow && volumes[i] > 0)
      return fmt::format("the part at {} lies inside another one and faces outward, as it does; take it away, or turn "
                         "its triangles round if it is the wall of a hollow",
                         written(x));
    if (hollow != (volumes[i] < 0))
      return fmt::format("the surface at {} is inside out; turn its triangles round", written(x));
  }
  return {};
}

void check_simple(const SolidSurface& surface, const std::string& name) {
  std::vector<Box> boxes(surface.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t])
      boxes[t].add(surface.points[v], 0);
  BoxTree tree;
  tree.build(std::vector<QuickBox>(boxes.begin(), boxes.end()));
  struct Found {
    std::size_t pairs = 0;
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  };
  std::vector<Found> chunks(tree.chunks());
  tree.for_overlaps({}, [&](std::size_t chunk, std::uint32_t i, std::uint32_t j) {
    if (!triangles_intersect(surface.points, surface.triangles[i], surface.triangles[j]))
      return;
    ++chunks[chunk].pairs;
    chunks[chunk].first = std::min({chunks[chunk].first, i, j});
  });
  Found found;
  for (const Found& chunk : chunks)
    found = {found.pairs + chunk.pairs, std::min(found.first, chunk.first)};
  if (found.pairs > 0)
    fail(ExitCode::bad_input,
         "{}: the surface intersects itself, {} pairs of triangles, the first at {}; unite its parts or repair it",
         name, found.pairs, written(surface.points[surface.triangles[found.first][0]]));
}

} // namespace

void check_surface(const SolidSurface& surface, const std::string& name, bool simple) {
  check_points(surface, name);
  const std::vector<Triangles> parts = parts_of(check_closed(surface, name));
  const std::vector<double> volumes = check_volumes(surface, parts, name);
  const std::string fault = fault_of_sides(surface, parts, volumes);
  if (!simple || !fault.empty()) // what intersects itself has no sides
    check_simple(surface, name);
  if (!fault.empty())
    fail(ExitCode::bad_input, "{}: {}", name, fault);
}

} // namespace sheet::solid
