// SPDX-License-Identifier: GPL-3.0-or-later
// Where a sheet meets itself: which of its features come too near to each other on their paths, and which are near each
// other where they stand. All pairs of a vertex and a triangle, and of two edges, that share no vertex are looked at;
// those whose boxes overlap come from a tree (feature_tree.h). On all threads; results are sorted, the same for any
// number.
//
// The tree is gone through once a step: the pairs of features whose boxes overlap, grown by the whole contact distance
// around the whole step, are candidates for all questions about places within these boxes; those that can only be near
// each other are told apart from those that may come too near on the way. Each question compares its own, tighter boxes
// first, so its answer does not depend on what the candidates were gathered for. Pairs with a vertex that is found
// elsewhere are looked up in the tree.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/feature_tree.h"
#include "libsheet/collide/hit.h"
#include "libsheet/collide/linked_vertices.h"
#include "libsheet/collide/pair_watch.h"
#include "libsheet/collide/sheet_layers.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

struct NearPair {
  FeaturePair pair;
  ClosestPoints closest;
};

class SelfSearch {
public:
  // `mesh` must outlive the search.
  explicit SelfSearch(const Connectivity& mesh);

  // The pairs that come too near to each other (hit.h) on the straight way from `start` to `end` [m], ascending.
  // `reach` [m], one a vertex: the contact distance of a pair is the mean of its features'.
  [[nodiscard]] std::vector<Hit> hits(std::span<const Vector3> start, std::span<const Vector3> end,
                                      std::span<const double> reach);

  // Where ends are corrected after that, again and again: asks for hits of what has moved. What is given and the search
  // must outlive it, and no other question be asked meanwhile.
  [[nodiscard]] PairWatch watch(std::span<const Vector3> start, std::span<const Vector3> end,
                                std::span<const double> reach) {
    return {mesh_, tree_, start, end, reach};
  }

  // Pairs within their contact distance of each other whose surfaces face each other, ascending: a vertex over a
  // triangle, or beside one by no more than 60 degrees off its normal, and edges that cross. Of features joined by an
  // edge of the mesh only vertices over triangles count, so that the sheet next to a vertex is no contact. Whether they
  // are two layers is not asked. Pairs that springs join already are left out (two edges of which one
  // is near by its first end alone count as that vertex and a triangle, as their spring would).
  [[nodiscard]] std::vector<NearPair> near(std::span<const Vector3> positions, std::span<const double> reach,
                                           const LinkedVertices& linked = LinkedVertices({}));

  // The first pair of triangles (lower, higher) that intersect, exactly; triangles without area are passed over. Only
  // pairs of which one is in `chosen` (a flag a triangle; empty: all) are looked at.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>>
  crossing(std::span<const Vector3> positions, std::span<const std::uint8_t> chosen = {});

  // Gathers the candidates for the way from `start` to `end` and all that is within `reach` of it, unless the last ones
  // do. The questions call it themselves; asked before, for the whole step, it spares them to.
  void gather(std::span<const Vector3> start, std::span<const Vector3> end, std::span<const double> reach);

  [[nodiscard]] const SheetLayers& layers() const { return layers_; }

private:
  using Positions = std::span<const Vector3>;
  using Flags = std::vector<std::uint8_t>;

  [[nodiscard]] Flags outside(const Ways& ways) const;
  template <class Found, class Test> class Collector;

  const Connectivity& mesh_;
  SheetLayers layers_;
  FeatureTree tree_;
  std::vector<Candidates> candidates_;
  std::vector<Box> around_;   // of each vertex: the places for which they were gathered
  std::vector<double> reach_; // and the contact distance
};

} // namespace sheet::collide
