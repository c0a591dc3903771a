// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/tear_cuts.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace sheet::flow {

namespace {

class Tearing {
public:
  explicit Tearing(const TearInput& input) : in_(input), mesh_(input.mesh) {
    cuts_.cut.assign(mesh_.edges.size(), false);
    cuts_.dropped.assign(mesh_.triangles.size(), false);
    on_border_.assign(mesh_.vertices, false);
    open_.assign(mesh_.triangles.size(), 0);
    thickness_.assign(mesh_.edges.size(), 0);
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e)
      if (mesh_.on_rim(e))
        open(e);
  }

  TearCuts run() {
    find_candidates();
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e)
      if (is_candidate(e))
        waiting_.emplace(thickness_[e], e);
    while (!waiting_.empty()) {
      const std::uint32_t e = waiting_.begin()->second;
      waiting_.erase(waiting_.begin());
      try_edge(e);
    }
    cuts_.vetoed = static_cast<std::size_t>(std::ranges::count(vetoed_, true));
    return std::move(cuts_);
  }

private:
  using Path = std::span<const std::uint32_t>; // one edge, or two that meet

  [[nodiscard]] bool is_candidate(std::uint32_t e) const { return thickness_[e] > 0; }

  void find_candidates() {
    std::vector<std::size_t> count(mesh_.vertices + 1, 0);
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e) {
      const auto [a, b] = mesh_.edges[e];
      const auto [s, t] = mesh_.edge_triangles[e];
      if (mesh_.on_rim(e) || !is_thin(s) || !is_thin(t) || stays_whole(a, b))
        continue;
      thickness_[e] = (in_.volumes[s] + in_.volumes[t]) / (in_.areas[s] + in_.areas[t]);
      ++count[a + 1];
      ++count[b + 1];
    }
    for (std::size_t v = 0; v < mesh_.vertices; ++v)
      count[v + 1] += count[v];
    first_at_ = count;
    at_.resize(count.back());
    for (std::uint32_t e = 0; e < mesh_.edges.size(); ++e)
      if (is_candidate(e))
        for (const std::uint32_t v : mesh_.edges[e])
          at_[count[v]++] = e;
    for (std::size_t v = 0; v < mesh_.vertices; ++v)
      std::sort(at_.begin() + static_cast<std::ptrdiff_t>(first_at_[v]),
                at_.begin() + static_cast<std::ptrdiff_t>(first_at_[v + 1]),
                [&](std::uint32_t e, std::uint32_t f) { return key(e) < key(f); });
    vetoed_.assign(mesh_.edges.size(), false);
  }

  [[nodiscard]] bool is_thin(std::uint32_t t) const {
    return in_.volumes[t] < in_.below * in_.areas[t] || (!in_.pierced.empty() && in_.pierced[t]);
  }
  [[nodiscard]] bool stays_whole(std::uint32_t a, std::uint32_t b) const {
    return (!in_.whole.empty() && (in_.whole[a] || in_.whole[b])) ||
           std::ranges::any_of(in_.grips, [&](const auto& bits) { return (bits[a] & bits[b]) != 0; });
  }
  [[nodiscard]] std::pair<double, std::uint32_t> key(std::uint32_t e) const { return {thickness_[e], e}; }
  // Candidates at a vertex, the thinnest first.
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t v) const {
    return std::span(at_).subspan(first_at_[v], first_at_[v + 1] - first_at_[v]);
  }
  [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    return mesh_.edges[e][0] == v ? mesh_.edges[e][1] : mesh_.edges[e][0];
  }

  void try_edge(std::uint32_t e) {
    const auto [a, b] = mesh_.edges[e];
    if (on_border_[a] || on_border_[b]) {
      const std::array path{e};
      if (may_part(path, on_border_[a] && on_border_[b]))
        return try_path(path);
    }
    // With the thinnest other edge that goes on from an end inside the sheet.
    std::optional<std::array<std::uint32_t, 2>> best;
    for (const std::uint32_t middle : {a, b}) {
      if (on_border_[middle])
        continue;
      for (const std::uint32_t f : at(middle)) {
        const std::array path{e, f};
        if (f == e || (best && key(f) > key((*best)[1])) ||
            !may_part(path, on_border_[other_end(e, middle)] && on_border_[other_end(f, middle)]))
          continue;
        best = path;
        break;
      }
    }
    if (best)
      try_path(*best);
  }

  // The rule of open sides.
  [[nodiscard]] bool may_part(Path path, bool joins_borders) const {
    std::array<std::uint32_t, 4> met{};
    std::size_t count = 0;
    for (const std::uint32_t e : path)
      for (const std::uint32_t t : mesh_.edge_triangles[e]) {
        if (cuts_.cut[e] || cuts_.dropped[t] || open_[t] > (joins_borders ? 1 : 0) ||
            std::find(met.begin(), met.begin() + count, t) != met.begin() + count)
          return false;
        met[count++] = t;
      }
    return true;
  }

  void try_path(Path path) {
    for (const std::uint32_t e : path)
      cuts_.cut[e] = true;
    if (!part_from_crumbs(path)) {
      for (const std::uint32_t e : path) {
        cuts_.cut[e] = false;
        vetoed_[e] = true;
      }
      return;
    }
    for (const std::uint32_t e : path) {
      vetoed_[e] = false;
      ++cuts_.edges;
      open(e);
    }
    // What reaches the new border may part now.
    for (const std::uint32_t e : path)
      for (const std::uint32_t v : mesh_.edges[e])
        for (const std::uint32_t f : at(v))
          if (!cuts_.cut[f])
            waiting_.insert(key(f));
  }

  void open(std::uint32_t e) {
    for (const std::uint32_t t : mesh_.edge_triangles[e])
      if (t != no_index)
        ++open_[t];
    for (const std::uint32_t v : mesh_.edges[e])
      on_border_[v] = true;
  }

  // The piece that the triangle belongs to, or some `crumb` triangles of it.
  [[nodiscard]] std::vector<std::uint32_t> piece(std::uint32_t start) const {
    std::vector<std::uint32_t> found{start};
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const std::uint32_t e : mesh_.triangle_edges[found[i]])
        for (const std::uint32_t t : mesh_.edge_triangles[e])
          if (found.size() < crumb && t != no_index && !cuts_.cut[e] &&
              std::find(found.begin(), found.end(), t) == found.end())
            found.push_back(t);
    return found;
  }

  // False if the cut makes a crumb that may not be; crumbs that may be are dropped.
  bool part_from_crumbs(Path path) {
    std::vector<std::uint32_t> dropped;
    bool something_stays = false;
    for (const std::uint32_t e : path)
      for (const std::uint32_t t : mesh_.edge_triangles[e]) {
        const std::vector<std::uint32_t> p = piece(t);
        if (p.size() >= crumb) {
          something_stays = true;
          continue;
        }
        if (!in_.drop_crumbs || std::ranges::any_of(p, [&](std::uint32_t s) { return is_held(s); }))
          return false;
        dropped.insert(dropped.end(), p.begin(), p.end());
      }
    if (!something_stays)
      return false;
    for (const std::uint32_t t : dropped)
      cuts_.dropped[t] = true;
    return true;
  }

  [[nodiscard]] bool is_held(std::uint32_t t) const {
    return std::ranges::any_of(mesh_.triangles[t], [&](std::uint32_t v) {
      return (!in_.whole.empty() && in_.whole[v]) ||
             std::ranges::any_of(in_.grips, [&](const auto& bits) { return bits[v] != 0; });
    });
  }

  const TearInput& in_;
  const Connectivity& mesh_;
  TearCuts cuts_;
  std::vector<double> thickness_;     // of candidates, 0 for other edges
  std::vector<std::size_t> first_at_; // of each vertex, in at_
  std::vector<std::uint32_t> at_;     // candidates
  std::vector<bool> on_border_;       // vertices
  std::vector<std::uint8_t> open_;    // sides of each triangle that are on a border
  std::vector<bool> vetoed_;          // edges
  std::set<std::pair<double, std::uint32_t>> waiting_;
};

} // namespace

TearCuts find_cuts(const TearInput& input) { return Tearing(input).run(); }

} // namespace sheet::flow
