// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of features of a sheet that boxes do not tell apart: a vertex and a triangle, or two edges, that share no
// vertex. Each feature belongs to the first leaf of a tree of triangles that has one with it, and leaves compare eight
// features at once, so that each pair is found once [Curtis et al. 2008, representative triangles].
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/box_tree.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

// Each a vertex and a triangle, or two edges, the lower first.
struct FeaturePairs {
  using Pair = std::array<std::uint32_t, 2>;
  std::vector<Pair> vertex_triangle, edge_edge;
};

// By what may become of them; each pair stands in one of these.
struct Candidates {
  FeaturePairs on_way; // may come too near to each other in the step, or be near each other
  FeaturePairs beside; // may be near each other alone; edges that an edge of the mesh joins are left out
  std::vector<FeaturePairs::Pair> joined; // the same, a vertex and a triangle that an edge of the mesh joins
};

// Straight ways of vertices [m], and how far each reaches [m].
struct Ways {
  std::span<const Vector3> start, end;
  std::span<const double> reach;

  // That of a feature.
  struct Way {
    Box places;
    double most = 0; // that a vertex of it reaches

    // Grown by half of a part of that.
    [[nodiscard]] Box box(double part) const {
      const double margin = 0.5 * part * most;
      return {(places.low.array() - margin).matrix(), (places.high.array() + margin).matrix()};
    }
  };
  [[nodiscard]] Way way(std::span<const std::uint32_t> vertices) const {
    Way way;
    for (const std::uint32_t v : vertices) {
      way.places.add(start[v]);
      way.places.add(end[v]);
      way.most = std::max(way.most, reach[v]);
    }
    return way;
  }
};

class FeatureTree {
public:
  using Flags = std::span<const std::uint8_t>;

  // `mesh` must outlive it.
  explicit FeatureTree(const Connectivity& mesh);

  // All pairs with a vertex in `chosen` (a flag a vertex; empty: all) whose boxes (Way::box) overlap, and perhaps a few
  // more: Candidates::on_way those with the part `on_way`; the others, sought if `beside` is true, those with the part
  // 1. In parts; these and their order depend on what is given alone. Asked again, only what has moved is placed anew.
  [[nodiscard]] std::vector<Candidates> candidates(const Ways& ways, double on_way, bool beside, Flags chosen);

  // Puts the triangles where their vertices are, for BoxTree::for_overlaps.
  [[nodiscard]] const BoxTree& triangles_at(std::span<const Vector3> positions);

private:
  // Boxes on the way, grown by half the reach, and by half of a part of it.
  struct Grown {
    QuickBox reaching, on_way;
  };
  struct OwnVertex {
    Grown boxes;
    std::uint32_t index;
    bool chosen = true;
  };
  struct OwnEdges { // up to eight
    BoxLanes reaching, on_way;
    IndexLanes index;
    std::array<IndexLanes, 2> ends;
    std::uint32_t count = 0;
    unsigned chosen = all_lanes; // as bits
  };
  struct Leaf {
    std::uint32_t first_edges = 0, first_vertex = 0;
    std::array<IndexLanes, 3> corners; // of its triangles
    BoxLanes on_way;                   // of its triangles
    QuickBox around_edges;
    unsigned chosen = all_lanes; // of its triangles, as bits
  };
  struct Growth { // of boxes, times what their features reach
    float reaching = -1, on_way = -1;
    bool operator==(const Growth&) const = default;
  };
  static constexpr unsigned all_lanes = ~0U;
  class Marks;
  class Visitor;

  void place_tree();
  void own_features();
  void place(const Ways& ways, Growth growth);
  void place_vertices(const Ways& ways, bool anew);
  void place_features(Leaf& leaf, std::size_t number);
  void choose(Flags vertices);
  [[nodiscard]] Grown grown(std::span<const std::uint32_t> feature) const;
  [[nodiscard]] std::span<const OwnEdges> edges_of(std::size_t leaf) const;
  [[nodiscard]] std::span<const OwnVertex> vertices_of(std::size_t leaf) const;

  const Connectivity& mesh_;
  std::vector<std::uint32_t> first_neighbour_, neighbours_; // of each vertex: those that an edge joins to it
  BoxTree tree_;
  std::vector<Leaf> leaves_; // and one more, at which what the last one owns ends
  std::vector<OwnEdges> edges_;
  std::vector<OwnVertex> vertices_;
  std::vector<QuickBox> boxes_;               // of triangles
  std::vector<QuickBox> ways_;                // of vertices
  std::vector<float> reach_;                  // of vertices, rounded up
  Growth growth_;                             // with which all is placed; of triangles_at none
  std::vector<std::uint8_t> moved_, changed_; // since the last placing: vertices, triangles
  std::vector<std::uint8_t> chosen_;          // triangles with a chosen vertex; empty: all
};

} // namespace sheet::collide
