// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "libsheet/solid/triangle_distance.h"

namespace sheet::solid {
namespace {

constexpr std::uint32_t leaf = 4;

Triangle3 face_of(const SolidSurface& surface, std::uint32_t t) {
  const Corners& c = surface.triangles[t];
  return {surface.points[c[0]], surface.points[c[1]], surface.points[c[2]]};
}

// What Eigen's squaredExteriorDistance says, bit for bit, without branches.
double squared_gap(const Box3& box, const Vector3& x) {
  const Vector3 gap = (box.min() - x).cwiseMax(x - box.max()).cwiseMax(0.0);
  return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
}

double squared_gap(const Box3& a, const Box3& b) {
  return (a.min() - b.max()).cwiseMax(b.min() - a.max()).cwiseMax(0.0).squaredNorm();
}

// Nodes yet to be looked at, with a lower bound of the squared distance.
struct Pending {
  std::uint32_t node;
  double squared;
};

} // namespace

TriangleTree::TriangleTree(SolidSurface surface) : surface_(std::move(surface)) {
  const auto count = static_cast<std::uint32_t>(surface_.triangles.size());
  std::vector<Vector3> centers(count);
  face_normals_.resize(count);
  edge_normals_.resize(count);
  vertex_normals_.assign(surface_.points.size(), Vector3::Zero());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vector3> edges; // sums of the two faces' normals
  for (std::uint32_t t = 0; t < count; ++t) {
    const Triangle3 x = face_of(surface_, t);
    const Corners& c = surface_.triangles[t];
    centers[t] = (x[0] + x[1] + x[2]) / 3;
    face_normals_[t] = (x[1] - x[0]).cross(x[2] - x[0]).stableNormalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 u = x[(i + 1) % 3] - x[i], v = x[(i + 2) % 3] - x[i];
      vertex_normals_[c[i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * face_normals_[t];
      const auto edge = std::minmax(c[(i + 1) % 3], c[(i + 2) % 3]);
      edges.try_emplace(edge, Vector3::Zero()).first->second += face_normals_[t];
    }
  }
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      edge_normals_[t][i] =
          edges.at(std::minmax(surface_.triangles[t][(i + 1) % 3], surface_.triangles[t][(i + 2) % 3]));
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * (count / leaf + 1));
  build(0, count, centers);
  corners_.reserve(count);
  for (const std::uint32_t t : order_)
    corners_.push_back(face_of(surface_, t));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t last, std::vector<Vector3>& centers) {
  Box3 box, middles;
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Vector3& x : face_of(surface_, order_[i]))
      box.extend(x);
    middles.extend(centers[order_[i]]);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, first, last - first});
  if (last - first <= leaf)
    return;
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
                   });
  build(first, middle, centers);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[self].count = 0;
  build(middle, last, centers);
}

std::optional<Near> TriangleTree::nearest(const Vector3& x, double within) const {
  double best = within * within;
  bool found = false;
  std::uint32_t face = 0;
  std::array<Pending, 64> stack;
  std::size_t height = 0;
  stack[height++] = {0, squared_gap(nodes_.front().box, x)};
  while (height > 0) {
    const Pending top = stack[--height];
    if (top.squared >= best)
      continue;
    const Node& node = nodes_[top.node];
    if (node.count == 0) {
      Pending a{top.node + 1, squared_gap(nodes_[top.node + 1].box, x)};
      Pending b{node.first, squared_gap(nodes_[node.first].box, x)};
      if (a.squared < b.squared)
        std::swap(a, b);
      stack[height++] = a; // the nearer one is looked at first
      stack[height++] = b;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const NearestOnTriangle candidate = nearest_on_triangle(x, corners_[i]);
      if (const double squared = (x - candidate.point).squaredNorm(); squared < best) {
        best = squared;
        found = true;
        face = order_[i];
      }
    }
  }
  if (!found)
    return std::nullopt;
  const NearestOnTriangle at = nearest_on_triangle(x, face_of(surface_, face));
  const Vector3& pseudo = at.part == NearestOnTriangle::Part::face ? face_normals_[face]
                          : at.part == NearestOnTriangle::Part::edge
                              ? edge_normals_[face][at.index]
                              : vertex_normals_[surface_.triangles[face][at.index]];
  const Vector3 from = x - at.point;
  const double distance = std::sqrt(best);
  const double sign = from.dot(pseudo) < 0 ? -1.0 : 1.0;
  // So near the surface, the direction would be made of round-off.
  const double noise = 1e-12 * (nodes_.front().box.diagonal().norm() + x.norm());
  return Near{sign * distance, distance > noise ? Vector3(sign / distance * from) : pseudo.stableNormalized()};
}

TriangleTree::Pair TriangleTree::nearest(const Triangle3& triangle, double within) const {
  Pair result{within, {}};
  Box3 box;
  for (const Vector3& x : triangle)
    box.extend(x);
  const Vector3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
  // Along the triangle's normal, how far a box or another triangle stays from its plane.
  const auto above = [&](const Vector3& x) { return normal.dot(x - triangle[0]); };
  const auto box_gap = [&](const Box3& b) {
    return std::abs(above(b.center())) - normal.cwiseAbs().dot(b.sizes()) / 2;
  };
  const auto span_gap = [](double a, double b, double c) {
    return std::max(std::min({a, b, c}), -std::max({a, b, c}));
  };
  std::array<Pending, 64> stack;
  std::size_t height = 0;
  stack[height++] = {0, squared_gap(box, nodes_.front().box)};
  while (height > 0 && result.distance > 0) {
    const Pending top = stack[--height];
    const Node& node = nodes_[top.node];
    if (top.squared >= result.distance * result.distance || box_gap(node.box) >= result.distance)
      continue;
    if (node.count == 0) {
      Pending a{top.node + 1, squared_gap(box, nodes_[top.node + 1].box)};
      Pending b{node.first, squared_gap(box, nodes_[node.first].box)};
      if (a.squared < b.squared)
        std::swap(a, b);
      stack[height++] = a;
      stack[height++] = b;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle3& other = corners_[i];
      if (span_gap(above(other[0]), above(other[1]), above(other[2])) >= result.distance)
        continue;
      const Vector3& face = face_normals_[order_[i]];
      if (span_gap(face.dot(triangle[0] - other[0]), face.dot(triangle[1] - other[0]),
                   face.dot(triangle[2] - other[0])) >= result.distance)
        continue;
      const TrianglePair pair = nearest_points(triangle, other);
      if (pair.distance < result.distance)
        result = {pair.distance,
                  {pair.weights,
                   {pair.distance, pair.distance > 0 ? Vector3((pair.first - pair.second) / pair.distance) : face}}};
    }
  }
  return result;
}

} // namespace sheet::solid
