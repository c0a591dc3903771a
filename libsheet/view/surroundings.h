// SPDX-License-Identifier: GPL-3.0-or-later
// What stands around the sheet in a scene, as the page draws it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "libsheet/scene/scene.h"

namespace sheet::view {

// A finite solid: whole numbers of steps, packed (packed_numbers.h): positions (all x, then y, z), triangles.
struct PackedSolid {
  std::size_t solid = 0; // number in the scene
  std::size_t vertices = 0, triangles = 0;
  double step = 0; // [m], at most 2^-16 of the solid's size
  std::string text;
};
[[nodiscard]] std::vector<PackedSolid> pack_solids(const Scene& scene);

struct FlatSurface { // without end
  std::string kind;  // "plane", "belt" (it stands and its surface moves), "bath" or, with a shore, "sea"
  std::array<double, 3> point, normal;
};

// What of it depends on time [s].
struct Placement {
  std::vector<std::array<double, 12>> motions; // of the packed solids: x becomes R x + t; R row by row, then t [m]
  std::vector<FlatSurface> surfaces;
  bool operator==(const Placement&) const;
};
[[nodiscard]] Placement place_surroundings(const Scene& scene, const std::vector<PackedSolid>& solids, double time);

} // namespace sheet::view
