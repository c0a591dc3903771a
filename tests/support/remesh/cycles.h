// SPDX-License-Identifier: GPL-3.0-or-later
// Refining and coarsening over and over: what is kept, what drifts.
#pragma once
#include <functional>

#include "libsheet/remesh/remesh.h"
#include "libsheet/shape/triangle_mesh.h"

namespace sheet::test {

// Sums over a frame, with compensated summation where they are compared to round-off.
struct Account {
  double volume = 0, area = 0, enclosed = 0; // [m³], [m²], [m³]; an open sheet encloses what is below, down to z = 0
  Vector3 momentum = Vector3::Zero(), angular_momentum = Vector3::Zero(); // per density
  double speed_sum = 0;                                                   // Σ volume |u|: the scale of the momentum
  double kinetic_energy = 0;                                              // per density
  double thickness_min = 0, thickness_max = 0;
};
[[nodiscard]] Account account_of(const formats::Frame& frame);

// Meshes that the shapes of scenes do not have.
[[nodiscard]] TriangleMesh torus(double radius, double tube_radius, std::uint32_t around, std::uint32_t across);
// A square with waves of this height, four a unit length along x, seven along y.
[[nodiscard]] TriangleMesh wrinkled(double edge_length, double height, double side = 1);
// Both meshes as one, the second moved.
[[nodiscard]] TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other, const Vector3& shift);
// Two hemispherical caps, one this much above the other.
[[nodiscard]] TriangleMesh two_caps(double edge_length, double gap);
// A strip folded into a Z whose layers lie this far apart.
[[nodiscard]] TriangleMesh z_fold(double edge_length, double gap);

// One cycle: half the edge length, then the whole again. Returns the number of edits.
std::uint64_t cycle(formats::Frame& frame, remesh::Options options);

} // namespace sheet::test
