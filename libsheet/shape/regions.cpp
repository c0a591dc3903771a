// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/base/error.h"
#include "libsheet/geometry/types.h"
#include "libsheet/shape/mesh_measure.h"

namespace sheet {

namespace {

template <class Inside> VertexSet vertices_where(const TriangleMesh& mesh, Inside inside) {
  VertexSet set;
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
    if (inside(mesh.positions[i]))
      set.push_back(i);
  return set;
}

double loop_length(const TriangleMesh& mesh, const std::vector<std::uint32_t>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (mesh.positions[loop[i]] - mesh.positions[loop[(i + 1) % loop.size()]]).norm();
  return length;
}

// The only loop that is shortest (sign = 1) or longest (sign = -1).
VertexSet extreme_loop(const TriangleMesh& mesh, double sign, const char* name) {
  const auto loops = boundary_loops(mesh);
  if (loops.size() < 2)
    fail(ExitCode::bad_input,
         "region \"{}\": the mesh has {} boundary loop(s), so inner and outer make no sense; use \"rim\"", name,
         loops.size());
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < loops.size(); ++i)
    order.emplace_back(sign * loop_length(mesh, loops[i]), i);
  std::sort(order.begin(), order.end());
  if (order[1].first - order[0].first < 1e-6 * std::abs(order[0].first))
    fail(ExitCode::bad_input,
         "region \"{}\": two boundary loops are equally long; use a side such as \"y_min\" or a box", name);
  VertexSet set = loops[order[0].second];
  std::sort(set.begin(), set.end());
  return set;
}

} // namespace

std::vector<std::vector<std::uint32_t>> boundary_loops(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> next(mesh.positions.size(), no_index);
  for (const MeshEdge& edge : mesh_edges(mesh.triangles)) {
    if (edge.up > 1 || edge.down > 1)
      fail(ExitCode::bad_input, "the mesh is no oriented manifold: {} triangles meet at the edge of vertices {} and {}",
           edge.up + edge.down, edge.a, edge.b);
    if (edge.up + edge.down == 2)
      continue;
    const std::uint32_t from = edge.up == 1 ? edge.a : edge.b, to = edge.up == 1 ? edge.b : edge.a;
    if (next[from] != no_index)
      fail(ExitCode::bad_input, "the mesh is pinched at vertex {}: it is on the boundary more than once", from);
    next[from] = to;
  }
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == no_index)
      continue;
    loops.emplace_back();
    for (std::uint32_t v = start; next[v] != no_index;) {
      loops.back().push_back(v);
      const std::uint32_t after = next[v];
      next[v] = no_index;
      v = after;
    }
  }
  return loops;
}

VertexSet rim(const TriangleMesh& mesh) {
  VertexSet set;
  for (const auto& loop : boundary_loops(mesh))
    set.insert(set.end(), loop.begin(), loop.end());
  if (set.empty())
    fail(ExitCode::bad_input, "region \"rim\": the mesh is closed and has no rim");
  std::sort(set.begin(), set.end());
  return set;
}

VertexSet inner_rim(const TriangleMesh& mesh) { return extreme_loop(mesh, 1.0, "inner_rim"); }
VertexSet outer_rim(const TriangleMesh& mesh) { return extreme_loop(mesh, -1.0, "outer_rim"); }

VertexSet side(const TriangleMesh& mesh, int axis, bool largest, double tolerance) {
  if (mesh.positions.empty())
    return {};
  Eigen::Vector3d low = mesh.positions[0], high = mesh.positions[0];
  for (const Eigen::Vector3d& x : mesh.positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double slack = tolerance * (high - low).norm();
  return vertices_where(mesh, [&](const Eigen::Vector3d& x) {
    return largest ? x[axis] >= high[axis] - slack : x[axis] <= low[axis] + slack;
  });
}

VertexSet in_box(const TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return vertices_where(mesh, [&](const Eigen::Vector3d& x) {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  });
}

VertexSet in_sphere(const TriangleMesh& mesh, const Eigen::Vector3d& center, double radius) {
  return vertices_where(mesh, [&](const Eigen::Vector3d& x) { return (x - center).norm() <= radius; });
}

VertexSet named_region(const TriangleMesh& mesh, std::string_view name) {
  if (name == "rim")
    return rim(mesh);
  if (name == "inner_rim")
    return inner_rim(mesh);
  if (name == "outer_rim")
    return outer_rim(mesh);
  if (name.size() == 5 && name[0] >= 'x' && name[0] <= 'z' && (name.substr(1) == "_min" || name.substr(1) == "_max"))
    return side(mesh, name[0] - 'x', name.substr(1) == "_max");
  fail(ExitCode::bad_input,
       "region \"{}\": known are rim, inner_rim, outer_rim, x_min, x_max, y_min, y_max, z_min and z_max", name);
}

} // namespace sheet
