// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/free_turning.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <Eigen/Cholesky>

namespace sheet {

namespace {

// Of each vertex the least one of its piece.
std::vector<std::uint32_t> pieces_of(const Connectivity& mesh) {
  std::vector<std::uint32_t> piece(mesh.vertices);
  std::iota(piece.begin(), piece.end(), 0U);
  const auto first = [&](std::uint32_t v) {
    while (piece[v] != v)
      v = piece[v] = piece[piece[v]];
    return v;
  };
  for (const Edge& edge : mesh.edges) {
    const std::uint32_t a = first(edge[0]), b = first(edge[1]);
    piece[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t v = 0; v < piece.size(); ++v)
    piece[v] = first(v);
  return piece;
}

} // namespace

bool turns_freely(const Model& model) {
  return model.bath && !model.has_inertia() && model.holds.empty() && model.walls.empty() && model.contacts.empty() &&
         !model.air;
}

bool turns_about_holds(const Model& model) {
  const auto pins = [](const Hold& hold) { return hold.axes == all_axes && hold.clamped_edges.empty(); };
  return !model.has_inertia() && !model.has_weight() && !model.bath && !model.air && model.walls.empty() &&
         model.contacts.empty() && !model.holds.empty() && std::ranges::all_of(model.holds, pins);
}

void stop_turning(const Connectivity& mesh, std::span<const Vector3> positions, const Vector3& axis,
                  std::span<Vector3> velocities) {
  struct Piece {
    double vertices = 0, moment = 0, turning = 0; // the last two: sums over tangents t of t² [m²] and t·v [m²/s]
    Vector3 middle = Vector3::Zero();
  };
  const std::vector<std::uint32_t> piece_of = pieces_of(mesh);
  const Vector3 about = axis.normalized();
  std::vector<Piece> pieces(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    pieces[piece_of[v]].vertices += 1;
    pieces[piece_of[v]].middle += positions[v];
  }
  for (Piece& piece : pieces)
    if (piece.vertices > 0)
      piece.middle /= piece.vertices;
  const auto tangent = [&](std::size_t v) -> Vector3 { return about.cross(positions[v] - pieces[piece_of[v]].middle); };
  for (std::size_t v = 0; v < positions.size(); ++v) {
    pieces[piece_of[v]].moment += tangent(v).squaredNorm();
    pieces[piece_of[v]].turning += tangent(v).dot(velocities[v]);
  }
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (const Piece& piece = pieces[piece_of[v]]; piece.moment > 0)
      velocities[v] -= piece.turning / piece.moment * tangent(v);
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
