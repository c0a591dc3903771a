// SPDX-License-Identifier: GPL-3.0-or-later
// The middle surface of a sheet as it is drawn, and how it is made smooth.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::render {

struct Middle {
  std::vector<Vector3> positions;             // [m]
  std::vector<double> thickness;              // of each vertex: all volume around it / all area around it [m], but for
                                              // single ones that stand out: what they have beyond is around them
  std::vector<Corners> triangles;             // with area
  std::vector<std::uint32_t> source_triangle; // of the frame
  // The last vertices lie in the middles of edges of a coarser surface, with these ends,
  std::vector<std::array<std::uint32_t, 2>> of_edges{};
  double fineness = 1; // and are drawn back to them: 0 all the way, 1 not at all, normals likewise
};

// The frame's, flat between its vertices.
[[nodiscard]] Middle middle_of(const formats::Frame& frame);

// Of a triangle, as long as it is large [m²].
[[nodiscard]] Vector3 area_normal(std::span<const Vector3> x, const Corners& t);

// All volume around a vertex over all area around it [m]; 0 where there is no area.
[[nodiscard]] std::vector<double> vertex_thickness(const formats::Frame& frame);

// Where parting of triangles ends.
struct PartingLimits {
  std::size_t most_triangles;
  double flat = 0; // as soon as chords as long as the median edge are so near to the surface where it is sharpest [m]
};

// The same surface with finer triangles, curved between the vertices: that of Loop subdivision [Loop 1987], with
// control points from one round of progressive interpolation [Cheng, Fan, Lai, Huang, Wang, Yong 2009], so that it goes
// near to the vertices but follows the noise of single ones by half, and less near where folds are as tight as edges
// are long; rims are cubic splines but for corners below 135 degrees [Biermann, Levin, Zorin 2000]. Edges of other than
// two triangles stay as they are. Triangles are parted in four until 99 of 100 edges turn by less than 6 degrees, at
// most three times, and no farther than `until`; the last parts rise from the coarser surface where they begin to
// matter. The volume, area times thickness, is that of `volumes` [m³], of the frame's triangles.
[[nodiscard]] Middle smoothed(const Middle& middle, std::span<const double> volumes, const PartingLimits& until);

} // namespace sheet::render
