// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/strand_width.h"

#include <algorithm>
#include <limits>

#include "libsheet/geometry/area.h"

namespace sheet::flow {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double opposite = 0.5; // less the cosine of the angle between ways to two sides

class Strands {
public:
  Strands(const Connectivity& mesh, std::span<const Vector3> x) : mesh_(mesh), x_(x), on_rim_(mesh.vertices, false) {
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e)
      if (mesh.on_rim(e))
        on_rim_[mesh.edges[e][0]] = on_rim_[mesh.edges[e][1]] = true;
    ways_.resize(mesh.vertices);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t])
        if (const auto rim = rim_opposite(t, v); !on_rim_[v] && rim != no_index)
          ways_[v].push_back(way_to_line(x[v], x[mesh.edges[rim][0]], x[mesh.edges[rim][1]]));
  }

  [[nodiscard]] double width(std::uint32_t t) const {
    const Corners& c = mesh_.triangles[t];
    double most = 0;
    for (const std::uint32_t v : c)
      if (!on_rim_[v])
        most = std::max(most, width_across(ways_[v]));
    return most > 0 ? most : height(t);
  }

private:
  // The triangle's side without v, if it is on a rim.
  [[nodiscard]] std::uint32_t rim_opposite(std::uint32_t t, std::uint32_t v) const {
    for (const std::uint32_t e : mesh_.triangle_edges[t])
      if (mesh_.on_rim(e) && mesh_.edges[e][0] != v && mesh_.edges[e][1] != v)
        return e;
    return no_index;
  }
  // Of a triangle all of whose corners are on rims.
  [[nodiscard]] double height(std::uint32_t t) const {
    const Corners& c = mesh_.triangles[t];
    double side = 0;
    int rims = 0;
    for (const std::uint32_t e : mesh_.triangle_edges[t])
      if (mesh_.on_rim(e)) {
        ++rims;
        side = length(e);
      }
    if (rims > 1)
      return endless;
    if (rims == 0)
      for (const std::uint32_t e : mesh_.triangle_edges[t])
        side = std::max(side, length(e));
    return 2 * TriangleArea(x_[c[0]], x_[c[1]], x_[c[2]]).area / side;
  }
  [[nodiscard]] double length(std::uint32_t e) const { return (x_[mesh_.edges[e][1]] - x_[mesh_.edges[e][0]]).norm(); }

  const Connectivity& mesh_;
  std::span<const Vector3> x_;
  std::vector<bool> on_rim_;               // vertices
  std::vector<std::vector<Vector3>> ways_; // from each inner vertex to the rims beside it
};

} // namespace

Vector3 way_to_line(const Vector3& x, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).stableNormalized();
  return a - x - along.dot(a - x) * along;
}

double width_across(std::span<const Vector3> ways) {
  if (ways.empty())
    return endless;
  const auto shortest = std::ranges::min_element(ways, {}, [](const Vector3& w) { return w.squaredNorm(); });
  double back = endless;
  for (const Vector3& way : ways)
    if (way.dot(*shortest) < -opposite * way.norm() * shortest->norm())
      back = std::min(back, way.norm());
  return shortest->norm() + back;
}

std::vector<double> strand_widths(const Connectivity& mesh, std::span<const Vector3> x) {
  const Strands strands(mesh, x);
  std::vector<double> widths;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    widths.push_back(strands.width(t));
  return widths;
}

} // namespace sheet::flow
