// SPDX-License-Identifier: GPL-3.0-or-later
// What a triangle of a sheet lies on: another layer of it. SI units.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::flow {

// A part of a triangle that lies on another one.
struct Lying {
  std::uint32_t upper, lower;        // triangles
  double part;                       // of the upper one's volume; those of one triangle sum to 1
  double gap;                        // from the middle of the part to the lower one, along its normal [m]
  Vector3 normal = Vector3::UnitZ(); // of the lower one, to the side of the upper one
};

// A triangle over the nearest layer on one of its sides.
struct LyingOn {
  std::vector<Lying> parts; // none: nothing is there
  double covered = 0;       // area of the parts over that of the triangle; above 1 where the layer is folded there
};

// A layer are triangles that hang together, within 1.5 mean thicknesses, with normals within 45 degrees of the
// triangle's own, and which lie on the same spot, seen along that normal (geometry/overlap.h).
class LayersBelow {
public:
  // The spans outlive it. areas, thickness [m]: of the triangles; asked: those that will be asked for, a flag each.
  LayersBelow(const Connectivity& mesh, std::span<const Vector3> positions, std::span<const TriangleArea> areas,
              std::span<const double> thickness, std::span<const std::uint8_t> asked);

  // side: 1 or -1, towards the positive face or the other one. Precondition: triangle t has an area and was asked for.
  [[nodiscard]] LyingOn nearest(std::uint32_t t, double side) const;
  // Triangle t, which juts out over the rim of what its neighbour lies on, as if it lay on the same. Nothing if it is
  // beyond the reach of that, 1.5 mean thicknesses.
  [[nodiscard]] LyingOn beside(std::uint32_t t, const LyingOn& neighbour) const;

private:
  [[nodiscard]] std::vector<Lying> all(std::uint32_t t, double side) const;
  [[nodiscard]] std::vector<Lying> nearest_of(const std::vector<Lying>& all) const;
  [[nodiscard]] bool share_corner(std::uint32_t a, std::uint32_t b) const;

  const Connectivity& mesh_;
  std::span<const Vector3> x_;
  std::span<const TriangleArea> areas_;
  std::span<const double> thickness_;
  std::vector<std::vector<std::uint32_t>> near_; // of each triangle that was asked for, ascending
};

} // namespace sheet::flow
