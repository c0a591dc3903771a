// SPDX-License-Identifier: GPL-3.0-or-later
// Where a sheet meets itself: which of its features come too near to each other on their paths, and which are near each
// other where they stand. All pairs of a vertex and a triangle, and of two edges, that share no vertex are looked at;
// each belongs to one triangle (its owner), so that pairs of triangles from a tree of boxes bring each pair of features
// once [Curtis et al. 2008, representative triangles]. On all threads; results are sorted, the same for any number.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/box_tree.h"
#include "libsheet/collide/swept_pair.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

// Vertex, then triangle; or edge, then edge.
struct FeaturePair {
  Features features = Features::vertex_triangle;
  std::array<std::uint32_t, 4> vertices{};
  auto operator<=>(const FeaturePair&) const = default;
};

// The pair comes nearer than `gap` [m] soon after `time` (0 start, 1 end of the step); `distance` [m]: at the start.
struct Hit {
  FeaturePair pair;
  double time = 0, gap = 0, distance = 0;
};

struct NearPair {
  FeaturePair pair;
  ClosestPoints closest;
};

class SelfSearch {
public:
  // `mesh` must outlive the search.
  explicit SelfSearch(const Connectivity& mesh);

  // The pairs that come too near to each other on the straight way from `start` to `end` [m], ascending. Too near is:
  // nearer than a tenth of their contact distance, or than half the distance that they start with, if that is less. So
  // what is apart at the start and not found here is apart all the time, and two that are pressed together lose
  // distance slowly. `reach` [m], one a vertex: the contact distance of a pair is the mean of its features'.
  // `moved` (a flag a vertex; empty: all): only pairs with such a vertex are looked at. They must lie in the boxes of
  // the last call without `moved`, which has to come first, or the tree is refitted to them.
  [[nodiscard]] std::vector<Hit> hits(std::span<const Vector3> start, std::span<const Vector3> end,
                                      std::span<const double> reach, std::span<const std::uint8_t> moved);

  // Pairs within their contact distance of each other whose surfaces face each other, ascending: a vertex over a
  // triangle, or beside one by no more than 60 degrees off its normal, and edges that cross. Of features joined by an
  // edge of the mesh only vertices over triangles count, so that the sheet next to a vertex is no contact.
  [[nodiscard]] std::vector<NearPair> near(std::span<const Vector3> positions, std::span<const double> reach);

  // The first pair of triangles (lower, higher) that intersect, exactly; triangles without area are passed over.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> crossing(std::span<const Vector3> positions);

private:
  template <class Found, class Test>
  std::vector<Found> collect(std::span<const std::uint8_t> chosen, Test&& test) const;
  void place_boxes(std::span<const Vector3> start, std::span<const Vector3> end, std::span<const double> reach,
                   double part);

  const Connectivity& mesh_;
  std::vector<std::uint8_t> owned_;                    // a triangle: bits 0 to 2 its vertices, bits 3 to 5 its edges
  std::vector<Box> vertex_boxes_, edge_boxes_, boxes_; // of vertices, edges, triangles
  BoxTree tree_;
};

} // namespace sheet::collide
