// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/side_directors.h"

#include <algorithm>

#include "libsheet/sheet/directors.h"

namespace sheet::remesh {

namespace {

constexpr double opposed = 0.1; // length of a mean of unit vectors that point to too different sides to have a meaning

double twice_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Of x in the triangle; all zero where it has no area.
Vector3 barycentric(const FlatTriangle& t, const Eigen::Vector2d& x) {
  const double area = twice_area(t[0], t[1], t[2]);
  if (area == 0)
    return Vector3::Zero();
  return Vector3(twice_area(x, t[1], t[2]), twice_area(t[0], x, t[2]), twice_area(t[0], t[1], x)) / area;
}

// The director `n` made a unit vector across an edge; zero where nothing of it is left.
Vector3 across(const Vector3& n, const Vector3& edge) {
  const Vector3 t = edge.normalized(), rest = n - n.dot(t) * t;
  const double length = rest.norm();
  return length > opposed ? Vector3(rest / length) : Vector3(Vector3::Zero());
}

// The removed triangle's side from one vertex to another that stays as it was; none where there is no such.
std::uint32_t kept_side(const Mesh& mesh, const Edit& edit, std::uint32_t from, std::uint32_t to) {
  if (from == edit.vertex || to == edit.vertex)
    return no_index;
  for (const std::uint32_t t : edit.removed)
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side)
      if (mesh.from(side) == from && mesh.to(side) == to)
        return side;
  return no_index;
}

} // namespace

SideDirectors::SideDirectors(const formats::Frame& frame) {
  if (frame.find("director_angle") == nullptr)
    return;
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const std::vector<Vector3> of_edges = directors_of(frame, mesh);
  directors_.reserve(3 * mesh.triangles.size());
  for (const auto& edges : mesh.triangle_edges) // edge i lies opposite corner i, side i runs on from corner i
    for (const std::size_t opposite : {2U, 0U, 1U})
      directors_.push_back(of_edges[edges[opposite]]);
}

Vector3 SideDirectors::interpolated(const Edit& edit, std::span<const FlatTriangle> old_flat,
                                    const Eigen::Vector2d& x) const {
  double best = 0;
  Vector3 weights = Vector3::Zero();
  std::size_t nearest = old_flat.size();
  for (std::size_t j = 0; j < old_flat.size(); ++j) {
    const Vector3 w = barycentric(old_flat[j], x);
    if (!w.isZero() && (nearest == old_flat.size() || w.minCoeff() > best)) {
      best = w.minCoeff();
      weights = w;
      nearest = j;
    }
  }
  if (nearest == old_flat.size())
    return Vector3::Zero();
  weights = weights.cwiseMax(0); // not beyond the patch
  weights /= weights.sum();
  Vector3 n = Vector3::Zero();
  for (std::uint32_t i = 0; i < 3; ++i)
    n += (1 - 2 * weights[(i + 2) % 3]) * directors_[3 * edit.removed[nearest] + i];
  return n;
}

void SideDirectors::prepare(const Mesh& mesh, const Edit& edit, std::span<const FlatTriangle> old_flat,
                            std::span<const FlatTriangle> new_flat, const std::vector<Vector3>& positions) {
  found_.clear();
  if (empty())
    return;
  for (std::size_t k = 0; k < edit.added.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      const std::uint32_t a = edit.added[k][i], b = edit.added[k][next];
      if (const std::uint32_t side = kept_side(mesh, edit, a, b); side != no_index)
        found_.push_back(directors_[side]);
      else
        found_.push_back(across(interpolated(edit, old_flat, 0.5 * (new_flat[k][i] + new_flat[k][next])),
                                positions[b] - positions[a]));
    }
}

void SideDirectors::commit(std::span<const std::uint32_t> slots) {
  if (empty())
    return;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    directors_.resize(std::max<std::size_t>(directors_.size(), 3 * slots[k] + 3), Vector3::Zero());
    std::copy_n(found_.begin() + static_cast<std::ptrdiff_t>(3 * k), 3,
                directors_.begin() + static_cast<std::ptrdiff_t>(3 * slots[k]));
  }
}

void SideDirectors::put(std::span<const std::uint32_t> kept, formats::Frame& frame) const {
  if (empty())
    return;
  const Connectivity mesh = connect(frame.vertices, triangles(static_cast<const formats::Frame&>(frame)));
  std::vector<Vector3> of_edges(mesh.edges.size(), Vector3::Zero());
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) // of the two sides of an edge the first triangle's counts
    for (std::size_t i = 0; i < 3; ++i)
      of_edges[mesh.triangle_edges[t][(i + 2) % 3]] = directors_[3 * std::size_t{kept[t]} + i];
  put_directors(of_edges, mesh, frame);
}

} // namespace sheet::remesh
