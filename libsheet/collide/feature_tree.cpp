// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/feature_tree.h"

#include <bit>
#include <optional>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include "libsheet/base/each.h"

namespace sheet::collide {

namespace {

// work(lane) for each bit that is set.
template <class Work> void for_bits(unsigned bits, const Work& work) {
  for (; bits != 0; bits &= bits - 1)
    work(static_cast<std::size_t>(std::countr_zero(bits)));
}

} // namespace

// Which features of one leaf are joined to a vertex by an edge of the mesh.
class FeatureTree::Marks {
public:
  explicit Marks(const FeatureTree& tree) : tree_(tree), own_(tree.mesh_.vertices, 0), joined_(own_) {}

  void mark(std::size_t leaf) {
    if (leaf_ == leaf)
      return;
    for (const std::uint32_t v : vertices_)
      for_neighbours(v, [&](std::uint32_t w) { joined_[w] = 0; });
    vertices_.clear();
    leaf_ = leaf;
    std::uint64_t bit = 1;
    for (const OwnEdges& edges : tree_.edges_of(leaf))
      for (std::size_t lane = 0; lane < edges.count; ++lane, bit <<= 1U) {
        add(edges.ends[0][lane], bit);
        add(edges.ends[1][lane], bit);
      }
    bit = first_vertex;
    for (const OwnVertex& vertex : tree_.vertices_of(leaf)) {
      add(vertex.index, bit);
      bit <<= 1U;
    }
    for (std::size_t lane = 0; lane < tree_.tree_.indices(leaf).size(); ++lane)
      for (const IndexLanes& corners : tree_.leaves_[leaf].corners)
        add(corners[lane], first_triangle << lane);
    for (const std::uint32_t v : vertices_) {
      for_neighbours(v, [&](std::uint32_t w) { joined_[w] |= own_[v]; });
      own_[v] = 0;
    }
  }
  // For each of these edges, which of the leaf's edges it is joined to, as bits.
  [[nodiscard]] IndexLanes joined_to(const OwnEdges& edges) const {
    IndexLanes lanes;
    for (std::size_t lane = 0; lane < edges.count; ++lane)
      lanes.put(lane, static_cast<std::uint32_t>(joined_[edges.ends[0][lane]] | joined_[edges.ends[1][lane]]));
    return lanes;
  }
  // Whether the leaf's vertex or triangle of that number is joined to this vertex.
  [[nodiscard]] bool vertex(std::size_t number, std::uint32_t to) const {
    return (joined_[to] >> number & first_vertex) != 0;
  }
  [[nodiscard]] bool triangle(std::size_t number, std::uint32_t to) const {
    return (joined_[to] >> number & first_triangle) != 0;
  }

private:
  // Eight triangles have at most 24 edges and 24 vertices of their own.
  static constexpr std::uint64_t first_vertex = 1U << 24U, first_triangle = first_vertex << 24U;

  void add(std::uint32_t vertex, std::uint64_t bit) {
    if (own_[vertex] == 0)
      vertices_.push_back(vertex);
    own_[vertex] |= bit;
  }
  template <class Work> void for_neighbours(std::uint32_t vertex, const Work& work) const {
    for (std::uint32_t i = tree_.first_neighbour_[vertex]; i < tree_.first_neighbour_[vertex + 1]; ++i)
      work(tree_.neighbours_[i]);
  }

  const FeatureTree& tree_;
  std::vector<std::uint64_t> own_, joined_; // a bit a feature, at each vertex
  std::vector<std::uint32_t> vertices_;     // of the leaf
  std::size_t leaf_ = no_index;
};

// What a chunk of leaves finds.
class FeatureTree::Visitor {
public:
  Visitor(const FeatureTree& tree, bool beside, tbb::enumerable_thread_specific<Marks>& marks, Candidates& found)
      : tree_(tree), beside_(beside), all_marks_(marks), found_(found) {}

  void visit(std::size_t a, std::size_t b) {
    marks_ = nullptr;
    compare_edges(a, b);
    compare_vertices(a, b);
    if (a != b)
      compare_triangles(a, b);
  }

private:
  // The edges of leaf a with those of b.
  void compare_edges(std::size_t a, std::size_t b) {
    const std::span<const OwnEdges> edges = tree_.edges_of(a), others = tree_.edges_of(b);
    const QuickBox& around = tree_.leaves_[b].around_edges;
    for (std::size_t q = 0; q < others.size(); ++q) {
      joined_edges_.reset();
      for (std::size_t p = 0; p < (a == b ? q + 1 : edges.size()); ++p)
        for_bits(edges[p].reaching.may_overlap(around), [&](std::size_t lane) {
          const unsigned wanted = (edges[p].chosen >> lane & 1U) != 0 ? all_lanes : others[q].chosen;
          if (wanted == 0)
            return;
          unsigned bits = others[q].reaching.may_overlap(edges[p].reaching[lane]) & wanted;
          if (a == b && p == q)
            bits &= ~1U << lane; // those behind it
          if (bits != 0)
            sort_edges(a, p, lane, others[q], bits);
        });
    }
  }
  void sort_edges(std::size_t leaf, std::size_t block, std::size_t lane, const OwnEdges& others, unsigned bits) {
    const OwnEdges& own = tree_.edges_of(leaf)[block];
    const std::uint32_t a = own.ends[0][lane], b = own.ends[1][lane], e = own.index[lane];
    const auto& [c, d] = others.ends;
    const auto put = [&](std::vector<FeaturePairs::Pair>& pairs, unsigned which) {
      for_bits(which, [&](std::size_t other) {
        const std::uint32_t f = others.index[other];
        pairs.push_back({std::min(e, f), std::max(e, f)});
      });
    };
    bits &= ~(c.equal(a) | c.equal(b) | d.equal(a) | d.equal(b)).bits();
    const unsigned on_way = bits & others.on_way.may_overlap(own.on_way[lane]);
    put(found_.on_way.edge_edge, on_way);
    if (!beside_ || bits == on_way)
      return;
    if (!joined_edges_)
      joined_edges_ = marks_of(leaf).joined_to(others);
    put(found_.beside.edge_edge, bits & ~on_way & ~joined_edges_->having(BoxLanes::count * block + lane).bits());
  }

  // The vertices of leaf a with the triangles of b.
  void compare_vertices(std::size_t a, std::size_t b) {
    const std::span<const OwnVertex> vertices = tree_.vertices_of(a);
    const std::array<IndexLanes, 3>& corners = tree_.leaves_[b].corners;
    for (std::size_t number = 0; number < vertices.size(); ++number)
      sort_triangles(vertices[number], b, [&](std::size_t triangle) {
        const Marks& joined = marks_of(a);
        return std::ranges::any_of(corners, [&](const IndexLanes& c) { return joined.vertex(number, c[triangle]); });
      });
  }
  // The triangles of leaf a with the vertices of b.
  void compare_triangles(std::size_t a, std::size_t b) {
    for (const OwnVertex& vertex : tree_.vertices_of(b))
      sort_triangles(vertex, a, [&](std::size_t triangle) { return marks_of(a).triangle(triangle, vertex.index); });
  }
  template <class Joined> void sort_triangles(const OwnVertex& vertex, std::size_t leaf, const Joined& joined) {
    const BoxTree& tree = tree_.tree_;
    if (!tree.around(leaf).may_overlap(vertex.boxes.reaching))
      return;
    const std::uint32_t v = vertex.index;
    const auto& [a, b, c] = tree_.leaves_[leaf].corners;
    const unsigned wanted = vertex.chosen ? all_lanes : tree_.leaves_[leaf].chosen;
    const unsigned bits =
        tree.boxes(leaf).may_overlap(vertex.boxes.reaching) & wanted & ~(a.equal(v) | b.equal(v) | c.equal(v)).bits();
    if (bits == 0)
      return;
    const std::span<const std::uint32_t> triangles = tree.indices(leaf);
    const unsigned on_way = bits & tree_.leaves_[leaf].on_way.may_overlap(vertex.boxes.on_way);
    for_bits(on_way, [&](std::size_t t) { found_.on_way.vertex_triangle.push_back({v, triangles[t]}); });
    if (beside_)
      for_bits(bits & ~on_way, [&](std::size_t t) {
        (joined(t) ? found_.joined : found_.beside.vertex_triangle).push_back({v, triangles[t]});
      });
  }

  const Marks& marks_of(std::size_t leaf) {
    if (marks_ == nullptr) {
      marks_ = &all_marks_.local();
      marks_->mark(leaf);
    }
    return *marks_;
  }

  const FeatureTree& tree_;
  bool beside_;
  tbb::enumerable_thread_specific<Marks>& all_marks_;
  Marks* marks_ = nullptr;                 // once they are of the leaf that is compared with another one
  std::optional<IndexLanes> joined_edges_; // of the edges that it is compared with
  Candidates& found_;
};

FeatureTree::FeatureTree(const Connectivity& mesh) : mesh_(mesh), first_neighbour_(mesh.vertices + 1, 0) {
  for (const Edge& e : mesh.edges)
    for (const std::uint32_t v : e)
      ++first_neighbour_[v + 1];
  for (std::size_t v = 0; v < mesh.vertices; ++v)
    first_neighbour_[v + 1] += first_neighbour_[v];
  neighbours_.resize(2 * mesh.edges.size());
  std::vector<std::uint32_t> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
  for (const auto& [a, b] : mesh.edges) {
    neighbours_[next[a]++] = b;
    neighbours_[next[b]++] = a;
  }
}

std::span<const FeatureTree::OwnEdges> FeatureTree::edges_of(std::size_t leaf) const {
  return std::span(edges_).subspan(leaves_[leaf].first_edges,
                                   leaves_[leaf + 1].first_edges - leaves_[leaf].first_edges);
}

std::span<const FeatureTree::OwnVertex> FeatureTree::vertices_of(std::size_t leaf) const {
  return std::span(vertices_).subspan(leaves_[leaf].first_vertex,
                                      leaves_[leaf + 1].first_vertex - leaves_[leaf].first_vertex);
}

// Sorts the tree once; where it is sorted, the boxes may have moved since, which costs speed only.
void FeatureTree::place_tree() {
  if (leaves_.empty()) {
    tree_.build(boxes_);
    own_features();
  } else {
    tree_.refit(boxes_);
  }
}

void FeatureTree::own_features() {
  std::vector<std::uint8_t> vertex(mesh_.vertices, 0), edge(mesh_.edges.size(), 0);
  leaves_.resize(tree_.leaves() + 1);
  edges_.reserve(mesh_.edges.size() / BoxLanes::count + tree_.leaves());
  vertices_.reserve(mesh_.vertices);
  const auto put_edge = [&](const Leaf& leaf, std::uint32_t index) {
    if (edges_.size() == leaf.first_edges || edges_.back().count == BoxLanes::count)
      edges_.emplace_back();
    OwnEdges& edges = edges_.back();
    edges.index.put(edges.count, index);
    for (std::size_t i = 0; i < 2; ++i)
      edges.ends[i].put(edges.count, mesh_.edges[index][i]);
    ++edges.count;
  };
  for (std::size_t k = 0; k < tree_.leaves(); ++k) {
    Leaf& leaf = leaves_[k];
    leaf.first_edges = static_cast<std::uint32_t>(edges_.size());
    leaf.first_vertex = static_cast<std::uint32_t>(vertices_.size());
    std::size_t lane = 0;
    for (const std::uint32_t t : tree_.indices(k)) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh_.triangles[t][i], e = mesh_.triangle_edges[t][i];
        leaf.corners[i].put(lane, v);
        if (std::exchange(vertex[v], 1) == 0)
          vertices_.push_back({{}, v});
        if (std::exchange(edge[e], 1) == 0)
          put_edge(leaf, e);
      }
      ++lane;
    }
  }
  leaves_.back().first_edges = static_cast<std::uint32_t>(edges_.size());
  leaves_.back().first_vertex = static_cast<std::uint32_t>(vertices_.size());
}

FeatureTree::Grown FeatureTree::grown(std::span<const std::uint32_t> feature) const {
  QuickBox places;
  float most = 0;
  for (const std::uint32_t v : feature) {
    places.add(ways_[v]);
    most = std::max(most, reach_[v]);
  }
  return {places.grown(growth_.reaching * most), places.grown(growth_.on_way * most)};
}

// Notes which vertices move, in other ways or with another reach than before; all, if `anew`.
void FeatureTree::place_vertices(const Ways& ways, bool anew) {
  ways_.resize(mesh_.vertices);
  reach_.resize(mesh_.vertices);
  moved_.resize(mesh_.vertices);
  each_in_parallel(mesh_.vertices, [&](std::size_t v) {
    Box exact;
    exact.add(ways.start[v]);
    exact.add(ways.end[v]);
    const QuickBox way(exact);
    const float reach = static_cast<float>(ways.reach[v]) * (1 + 0x1p-22F);
    moved_[v] = anew || way != ways_[v] || reach != reach_[v];
    ways_[v] = way;
    reach_[v] = reach;
  });
}

void FeatureTree::place(const Ways& ways, Growth growth) {
  const bool anew = growth != growth_;
  growth_ = growth;
  place_vertices(ways, anew);
  boxes_.resize(mesh_.triangles.size());
  changed_.resize(boxes_.size());
  each_in_parallel(boxes_.size(), [&](std::size_t t) {
    const Corners& c = mesh_.triangles[t];
    changed_[t] = moved_[c[0]] | moved_[c[1]] | moved_[c[2]];
    if (changed_[t] != 0)
      boxes_[t] = grown(c).reaching;
  });
  place_tree();
  each_in_parallel(tree_.leaves(), [&](std::size_t k) {
    if (std::ranges::any_of(tree_.indices(k), [&](std::uint32_t t) { return changed_[t] != 0; }))
      place_features(leaves_[k], k);
  });
}

void FeatureTree::place_features(Leaf& leaf, std::size_t number) {
  for (std::uint32_t i = leaf.first_vertex; i < leaves_[number + 1].first_vertex; ++i)
    vertices_[i].boxes = grown({&vertices_[i].index, 1});
  leaf.around_edges = {};
  for (std::uint32_t i = leaf.first_edges; i < leaves_[number + 1].first_edges; ++i) {
    OwnEdges& edges = edges_[i];
    for (std::size_t lane = 0; lane < edges.count; ++lane) {
      const Grown boxes = grown(mesh_.edges[edges.index[lane]]);
      edges.reaching.put(lane, boxes.reaching);
      edges.on_way.put(lane, boxes.on_way);
      leaf.around_edges.add(boxes.reaching);
    }
  }
  std::size_t lane = 0;
  for (const std::uint32_t t : tree_.indices(number))
    leaf.on_way.put(lane++, grown(mesh_.triangles[t]).on_way);
}

// Marks the features that have a vertex among these; all, if there are none.
void FeatureTree::choose(Flags vertices) {
  if (vertices.empty() && chosen_.empty())
    return; // as before
  const auto has = [&](std::span<const std::uint32_t> feature) {
    return vertices.empty() || std::ranges::any_of(feature, [&](std::uint32_t v) { return vertices[v] != 0; });
  };
  chosen_.resize(vertices.empty() ? 0 : mesh_.triangles.size());
  each_in_parallel(chosen_.size(), [&](std::size_t t) { chosen_[t] = has(mesh_.triangles[t]); });
  each_in_parallel(tree_.leaves(), [&](std::size_t k) {
    Leaf& leaf = leaves_[k];
    leaf.chosen = tree_.chosen_in(k, chosen_);
    for (std::uint32_t i = leaf.first_vertex; i < leaves_[k + 1].first_vertex; ++i)
      vertices_[i].chosen = leaf.chosen != 0 && has({&vertices_[i].index, 1});
    for (std::uint32_t i = leaf.first_edges; i < leaves_[k + 1].first_edges; ++i) {
      OwnEdges& edges = edges_[i];
      edges.chosen = 0;
      for (std::size_t lane = 0; lane < edges.count && leaf.chosen != 0; ++lane)
        edges.chosen |= static_cast<unsigned>(has(mesh_.edges[edges.index[lane]])) << lane;
    }
  });
}

std::vector<Candidates> FeatureTree::candidates(const Ways& ways, double on_way, bool beside, Flags chosen) {
  constexpr float rounded_up = 0.5F * (1 + 0x1p-22F);
  const float half_on_way = rounded_up * static_cast<float>(on_way);
  place(ways, {beside ? rounded_up : half_on_way, half_on_way});
  choose(chosen);
  std::vector<Candidates> found(tree_.chunks());
  tbb::enumerable_thread_specific<Marks> marks([&] { return Marks(*this); });
  tree_.for_leaves(chosen_, [&](std::size_t chunk, std::size_t a, std::size_t b) {
    Visitor(*this, beside, marks, found[chunk]).visit(a, b);
  });
  return found;
}

const BoxTree& FeatureTree::triangles_at(std::span<const Vector3> positions) {
  growth_ = {};
  boxes_.resize(mesh_.triangles.size());
  each_in_parallel(boxes_.size(), [&](std::size_t t) { boxes_[t] = QuickBox(box_of(positions, mesh_.triangles[t])); });
  place_tree();
  return tree_;
}

} // namespace sheet::collide
