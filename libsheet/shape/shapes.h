// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of simple shapes at a target edge length. Lengths in m, angles in rad.
//
// Local frame: rectangle, disk and annulus lie in the plane z = 0 around the origin, normal +z. Sphere and cap are
// centred at the origin; the cap's apex is (0, 0, radius). The tube's axis is z, its middle the origin. The curved ones
// face outward. place_mesh() puts them into the scene.
//
// Patterns; for all of them the mean length of the mesh's edges (diagonals included) approaches edge_length, so the
// squares of a structured grid have sides of 0.879 edge_length; give `segments` for other numbers:
//   structured   rectangle, annulus, tube: a grid whose squares are cut by diagonals of alternating direction (Union
//                Jack); disk: rings of 6, 12, 18, ... vertices; cap: rings as far apart as their vertices; sphere: six
//                grids of a cube with equal angles, pressed onto the sphere.
//   equilateral  rectangle, tube: rows shifted by half an edge (the rectangle's ends: half triangles); disk, annulus:
//                a hexagonal lattice fitted to the rims; cap: rings; sphere: icosahedron of any frequency.
//   irregular    blue noise, relaxed, Delaunay: no lattice is left, no angle below 25 degrees. The seed decides; the
//                same seed gives the same mesh. A shape one edge wide has room for rim vertices only, which are even.
// A structured annulus keeps its number of vertices around, so its angles get small if the radii differ much (30
// degrees at 0.4 : 1, 10 degrees at 0.1 : 1); the other two patterns do not have this.
// Vertices of rims lie on the rims, those of curved shapes on the sphere or cylinder.
// Throws Error (bad_input) if the shape is impossible, the edge length too large for it, or the mesh too large.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

enum class Pattern { structured, equilateral, irregular };

struct MeshOptions {
  Pattern pattern = Pattern::irregular;
  double edge_length = 0.0; // [m]
  std::uint64_t seed = 1;   // of the irregular pattern
  // Structured only; edge_length is not used then. Rectangle: along x and y; disk, annulus, cap: around and radially;
  // tube: around and along the axis; sphere: the first along each edge of the cube. A disk or a cap without opening
  // ends in a fan around its centre.
  std::optional<std::array<std::uint32_t, 2>> segments;
};

constexpr std::uint64_t most_triangles = 50'000'000;

[[nodiscard]] TriangleMesh make_rectangle(double size_x, double size_y, const MeshOptions& options);
[[nodiscard]] TriangleMesh make_disk(double radius, const MeshOptions& options);
[[nodiscard]] TriangleMesh make_annulus(double inner_radius, double outer_radius, const MeshOptions& options);
[[nodiscard]] TriangleMesh make_sphere(double radius, const MeshOptions& options);
// The part of the sphere up to `angle` from the axis, without that up to `opening` from it (0: closed at the apex).
[[nodiscard]] TriangleMesh make_cap(double radius, double angle, const MeshOptions& options, double opening = 0.0);
[[nodiscard]] TriangleMesh make_tube(double radius, double height, const MeshOptions& options);

} // namespace sheet
