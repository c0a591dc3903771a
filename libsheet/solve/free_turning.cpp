// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/free_turning.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <Eigen/Cholesky>

namespace sheet {

namespace {

// Of each vertex the least one of its piece; layers that touch are one.
std::vector<std::uint32_t> pieces_of(const Connectivity& mesh, std::span<const ContactSpring> contacts = {}) {
  std::vector<std::uint32_t> piece(mesh.vertices);
  std::iota(piece.begin(), piece.end(), 0U);
  const auto first = [&](std::uint32_t v) {
    while (piece[v] != v)
      v = piece[v] = piece[piece[v]];
    return v;
  };
  const auto join = [&](std::uint32_t one, std::uint32_t other) {
    const std::uint32_t a = first(one), b = first(other);
    piece[std::max(a, b)] = std::min(a, b);
  };
  for (const Edge& edge : mesh.edges)
    join(edge[0], edge[1]);
  for (const ContactSpring& spring : contacts)
    for (const std::uint32_t v : spring.vertices)
      join(spring.vertices[0], v);
  for (std::uint32_t v = 0; v < piece.size(); ++v)
    piece[v] = first(v);
  return piece;
}

// Of a mean velocity, or way, what is left of it: all, or what resistance that can only slow it leaves.
Vector3 steady(const Vector3& before, const Vector3& now, bool resisted) {
  if (!resisted || before.isZero(0))
    return before;
  return std::clamp(now.dot(before) / before.squaredNorm(), 0.0, 1.0) * before;
}

} // namespace

FreePieces free_pieces(const Model& model, const Connectivity& mesh) {
  FreePieces pieces;
  if (!model.bath || model.has_inertia() || model.air)
    return pieces;
  const std::vector<std::uint32_t> piece_of = pieces_of(mesh, model.contacts);
  std::vector<bool> bound(mesh.vertices, false);
  pieces.resisted.assign(mesh.vertices, model.bath->drag > 0);
  for (const Hold& hold : model.holds)
    for (const std::uint32_t v : hold.vertices)
      bound[piece_of[v]] = true;
  for (const Wall& wall : model.walls)
    for (const std::uint32_t v : wall.vertices)
      bound[piece_of[v]] = true;
  for (std::size_t v = 0; v < model.bath_reach.size(); ++v)
    if (model.bath_reach[v] == BathReach::around)
      pieces.resisted[piece_of[v]] = true;
  pieces.of_vertex.resize(mesh.vertices);
  for (std::uint32_t v = 0; v < mesh.vertices; ++v)
    pieces.of_vertex[v] = bound[piece_of[v]] ? no_index : piece_of[v];
  if (std::ranges::all_of(pieces.of_vertex, [](std::uint32_t piece) { return piece == no_index; }))
    pieces.of_vertex.clear();
  return pieces;
}

bool turns_about_holds(const Model& model) {
  const auto pins = [](const Hold& hold) { return hold.axes == all_axes && hold.clamped_edges.empty(); };
  return !model.has_inertia() && !model.has_weight() && !model.bath && !model.air && model.walls.empty() &&
         model.contacts.empty() && !model.holds.empty() && std::ranges::all_of(model.holds, pins);
}

void stop_turning(const FreePieces& free, std::span<const Vector3> positions, const Vector3& axis,
                  std::span<Vector3> velocities) {
  struct Piece {
    double vertices = 0, moment = 0, turning = 0; // the last two: sums over tangents t of t² [m²] and t·v [m²/s]
    Vector3 middle = Vector3::Zero();
  };
  const Vector3 about = axis.normalized();
  std::vector<Piece> pieces(positions.size());
  const auto each = [&](auto&& visit) {
    for (std::size_t v = 0; v < free.of_vertex.size(); ++v)
      if (free.of_vertex[v] != no_index)
        visit(v, pieces[free.of_vertex[v]]);
  };
  each([&](std::size_t v, Piece& piece) {
    piece.vertices += 1;
    piece.middle += positions[v];
  });
  for (Piece& piece : pieces)
    if (piece.vertices > 0)
      piece.middle /= piece.vertices;
  const auto tangent = [&](std::size_t v, const Piece& piece) -> Vector3 {
    return about.cross(positions[v] - piece.middle);
  };
  each([&](std::size_t v, Piece& piece) {
    piece.moment += tangent(v, piece).squaredNorm();
    piece.turning += tangent(v, piece).dot(velocities[v]);
  });
  each([&](std::size_t v, const Piece& piece) {
    if (piece.moment > 0)
      velocities[v] -= piece.turning / piece.moment * tangent(v, piece);
  });
}

void drift_steadily(const FreePieces& free, const DriftStart& start, double dt, const Vector3& axis,
                    std::span<Vector3> positions, std::span<Vector3> velocities) {
  struct Piece {
    double volume = 0;
    Vector3 before = Vector3::Zero(), way = Vector3::Zero(), now = Vector3::Zero(); // sums by volume
    Vector3 excess_way = Vector3::Zero(), excess = Vector3::Zero();
  };
  const Vector3 up = axis.normalized();
  const auto along = [&](const Vector3& way) -> Vector3 { return way - way.dot(up) * up; };
  std::vector<Piece> pieces(positions.size());
  for (std::size_t v = 0; v < free.of_vertex.size(); ++v)
    if (free.of_vertex[v] != no_index) {
      Piece& piece = pieces[free.of_vertex[v]];
      piece.volume += start.volumes[v];
      piece.before += start.volumes[v] * along(start.velocities[v]);
      piece.way += start.volumes[v] * along(positions[v] - start.positions[v]);
      piece.now += start.volumes[v] * along(velocities[v]);
    }
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (Piece& piece = pieces[p]; piece.volume > 0) {
      piece.excess_way = (piece.way - steady(dt * piece.before, piece.way, free.resisted[p])) / piece.volume;
      piece.excess = (piece.now - steady(piece.before, piece.now, free.resisted[p])) / piece.volume;
    }
  for (std::size_t v = 0; v < free.of_vertex.size(); ++v)
    if (free.of_vertex[v] != no_index) {
      positions[v] -= pieces[free.of_vertex[v]].excess_way;
      velocities[v] -= pieces[free.of_vertex[v]].excess;
    }
}

void stop_turning_about(const std::vector<Hold>& holds, double t, const Connectivity& mesh,
                        std::span<const Vector3> positions, std::span<Vector3> velocities) {
  struct Piece {
    const Hold* hold = nullptr;
    std::vector<std::uint32_t> held;
    Matrix3 moment = Matrix3::Zero();  // sum over the vertices of r² - r rᵀ [m²]
    Vector3 turning = Vector3::Zero(); // and of r x v [m²/s]
    Vector3 rate = Vector3::Zero();    // [rad/s]
  };
  const std::vector<std::uint32_t> piece_of = pieces_of(mesh);
  std::vector<Piece> pieces(positions.size());
  for (const Hold& hold : holds)
    for (const std::uint32_t v : hold.vertices) {
      Piece& piece = pieces[piece_of[v]];
      piece.hold = &hold;
      if (std::ranges::find(piece.held, v) == piece.held.end())
        piece.held.push_back(v);
    }
  const auto turns = [](const Piece& piece) { return !piece.held.empty() && piece.held.size() <= 2; };
  const auto arm = [&](const Piece& piece, std::size_t v) -> Vector3 {
    return positions[v] - positions[piece.held.front()];
  };
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (Piece& piece = pieces[piece_of[v]]; turns(piece)) {
      const Vector3 r = arm(piece, v);
      piece.moment += r.squaredNorm() * Matrix3::Identity() - r * r.transpose();
      piece.turning += r.cross(velocities[v] - piece.hold->velocity_at(t, positions[v]));
    }
  for (Piece& piece : pieces)
    if (turns(piece)) {
      if (piece.held.size() == 1) {
        piece.rate = piece.moment.ldlt().solve(piece.turning);
      } else {
        const Vector3 axis = arm(piece, piece.held.back()).normalized();
        piece.rate = axis.dot(piece.turning) / axis.dot(piece.moment * axis) * axis;
      }
    }
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (const Piece& piece = pieces[piece_of[v]]; turns(piece))
      velocities[v] -= piece.rate.cross(arm(piece, v));
}

} // namespace sheet
