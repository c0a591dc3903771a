// SPDX-License-Identifier: GPL-3.0-or-later
// The array director_angle: for each edge the angle [rad] of its director from the mean of the normals there
// (geometry/mean_normals.h). A stage that changes connectivity takes the directors out as vectors and puts them back as
// angles from the new normals; where it knows no director, the angle is 0.
#pragma once
#include <span>
#include <unordered_map>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/transfer.h"

namespace sheet {

// Adds or replaces the array; no angles: takes it away.
void put_director_angles(std::span<const double> angles, formats::Frame& frame);

// The unit vectors of the directors, one an edge of `mesh`, which must be the frame's; empty if it has none.
[[nodiscard]] std::vector<Vector3> directors_of(const formats::Frame& frame, const Connectivity& mesh);

// Puts directors, one an edge of `mesh`, which must be the frame's, as angles. A vector of length 0: unknown.
void put_directors(std::span<const Vector3> directors, const Connectivity& mesh, formats::Frame& frame);

// Directors on their way through tearing or inflow, where a new edge is an old one if its ends come from that one's.
class Directors {
public:
  // Takes note of the frame's; costs nothing where it has none.
  explicit Directors(const formats::Frame& frame);
  // Puts them into the frame with final positions and triangles. A vertex comes from its parent with most weight.
  void put(const Lineage& vertices, formats::Frame& frame) const;

private:
  std::unordered_map<std::uint64_t, Vector3> by_ends_; // the lower vertex in the upper half of the key
};

} // namespace sheet
