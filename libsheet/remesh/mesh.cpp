// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/mesh.h"

#include <algorithm>

#include "libsheet/base/error.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::remesh {

Mesh::Mesh(std::size_t vertices, std::span<const Corners> triangles)
    : corners_(triangles.begin(), triangles.end()), twin_(3 * triangles.size(), no_index), side_at_(vertices, no_index),
      lives_(vertices, true), triangles_(triangles.size()) {
  const Connectivity connected = connect(vertices, triangles);
  const auto side_of = [&](std::uint32_t t, const Edge& edge) {
    std::uint32_t i = 0;
    while (corners_[t][i] == edge[0] || corners_[t][i] == edge[1])
      ++i;
    return 3 * t + (i + 1) % 3; // opposite corner i
  };
  for (std::size_t e = 0; e < connected.edges.size(); ++e) {
    const auto [left, right] = connected.edge_triangles[e];
    if (left == no_index || right == no_index)
      continue;
    const std::uint32_t a = side_of(left, connected.edges[e]), b = side_of(right, connected.edges[e]);
    twin_[a] = b;
    twin_[b] = a;
  }
  std::vector<std::uint32_t> corner_count(vertices, 0);
  for (std::uint32_t side = 0; side < twin_.size(); ++side) {
    const std::uint32_t v = from(side);
    ++corner_count[v];
    if (side_at_[v] == no_index || twin_[side] == no_index)
      side_at_[v] = side;
  }
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (degree(v) != corner_count[v])
      fail(
          ExitCode::bad_input,
          "vertex {} joins parts of the sheet that meet in this point only: separate them by giving each part a vertex "
          "of its own (sheet-tear does)",
          v);
}

std::uint32_t Mesh::find_side(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t found = no_index;
  for_fan(a, [&](std::uint32_t side) {
    if (to(side) == b)
      found = side;
  });
  return found;
}

bool Mesh::adjacent(std::uint32_t a, std::uint32_t b) const {
  return find_side(a, b) != no_index || find_side(b, a) != no_index;
}

std::size_t Mesh::degree(std::uint32_t v) const {
  std::size_t count = 0;
  for_fan(v, [&](std::uint32_t) { ++count; });
  return count;
}

std::uint32_t Mesh::add_vertex() {
  side_at_.push_back(no_index);
  lives_.push_back(true);
  return static_cast<std::uint32_t>(side_at_.size() - 1);
}

void Mesh::remove_vertex(std::uint32_t v) {
  lives_[v] = false;
  side_at_[v] = no_index;
}

void Mesh::replace(std::span<const std::uint32_t> removed, std::span<const Corners> added,
                   std::vector<std::uint32_t>& slots) {
  open_.clear();
  for (const std::uint32_t t : removed)
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      const std::uint32_t twin = twin_[side];
      if (twin != no_index && std::find(removed.begin(), removed.end(), triangle_of(twin)) == removed.end())
        open_.push_back({from(side), to(side), twin});
      if (side_at_[from(side)] != no_index && triangle_of(side_at_[from(side)]) == t)
        side_at_[from(side)] = no_index;
    }
  for (const std::uint32_t t : removed) {
    corners_[t].fill(no_index);
    free_triangles_.push_back(t);
  }
  slots.clear();
  for (const Corners& corners : added) {
    std::uint32_t t = static_cast<std::uint32_t>(corners_.size());
    if (free_triangles_.empty()) {
      corners_.emplace_back();
      twin_.resize(twin_.size() + 3);
    } else {
      t = free_triangles_.back();
      free_triangles_.pop_back();
    }
    corners_[t] = corners;
    slots.push_back(t);
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      twin_[side] = no_index;
      const auto meets = [&](const Open& other) { return other.from == from(side) && other.to == to(side); };
      const auto it = std::find_if(open_.begin(), open_.end(), meets);
      if (it == open_.end()) {
        open_.push_back({to(side), from(side), side}); // waits for the neighbour that runs the other way
        continue;
      }
      twin_[side] = it->twin;
      twin_[it->twin] = side;
      *it = open_.back();
      open_.pop_back();
    }
  }
  // An old neighbour that found no new one is on the rim now.
  for (const Open& left : open_)
    twin_[left.twin] = no_index;
  triangles_ += added.size() - removed.size();
  const auto look_at = [&](std::uint32_t side) {
    std::uint32_t& at = side_at_[from(side)];
    if (at == no_index || twin_[side] == no_index)
      at = side;
  };
  for (const std::uint32_t t : slots)
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side)
      look_at(side);
  for (const Open& left : open_) {
    look_at(left.twin);
    // The vertex at its end has lost triangles; what is left of its fan still hangs on this side.
    if (side_at_[to(left.twin)] == no_index)
      side_at_[to(left.twin)] = next(left.twin);
  }
}

} // namespace sheet::remesh
