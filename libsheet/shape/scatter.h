// SPDX-License-Identifier: GPL-3.0-or-later
// The engine behind the irregular pattern (and the fitted lattices): points on a surface, spread evenly, Delaunay.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "libsheet/shape/random.h"
#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

using Points = std::vector<Eigen::Vector3d>;

// A surface as the engine sees it.
struct ScatterSurface {
  std::function<Eigen::Vector3d(Random&)> sample;                         // a point, uniform by area
  std::function<double(const Eigen::Vector3d&)> rim_distance;             // [m] to the nearest rim, large if none
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project;         // back onto the surface
  std::function<std::vector<TriangleIndices>(const Points&)> triangulate; // Delaunay, rims as boundary
  double area = 0.0;                                                      // [m²]
  long euler_characteristic = 1;
};

// Number of free vertices for which a mesh of that surface has the mean edge length.
[[nodiscard]] std::size_t free_vertex_count(const ScatterSurface& surface, std::size_t rim_vertices,
                                            double edge_length);

// Adds `count` points to `points` (rims and other fixed points), none close to another: Poisson disc sampling whose
// disc shrinks until all find room [after Dunbar, Humphreys 2006].
void scatter(const ScatterSurface& surface, std::size_t count, double edge_length, Random& random, Points& points);

// Moves the points from `fixed` on, if `may_move` agrees, to the mean of the centroids of their Delaunay triangles
// weighted by area, `rounds` times [Chen, Holst 2011: Efficient mesh optimization schemes based on optimal Delaunay
// triangulations].
void relax(const ScatterSurface& surface, std::size_t fixed, int rounds,
           const std::function<bool(const Eigen::Vector3d&)>& may_move, Points& points);

// The irregular mesh: scatter, relax, and where an angle is still below 26 degrees: remove or add a vertex there.
// Throws Error (bad_input) if that does not help, as on shapes of only a few edge lengths.
[[nodiscard]] TriangleMesh irregular_mesh(const ScatterSurface& surface, Points fixed, double edge_length,
                                          std::uint64_t seed);

} // namespace sheet
