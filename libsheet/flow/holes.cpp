// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/holes.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "libsheet/flow/deposit.h"
#include "libsheet/flow/drop.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/area.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr double least_radius = 0.5; // of the thickness
constexpr int steps_away = 2;        // edges from a site's triangle to the vertex at which its hole opens

// Triangles around each vertex.
class Around {
public:
  Around(std::size_t vertices, std::span<const Corners> triangles) : first_(vertices + 1, 0) {
    for (const Corners& c : triangles)
      for (const std::uint32_t v : c)
        ++first_[v + 1];
    for (std::size_t v = 0; v < vertices; ++v)
      first_[v + 1] += first_[v];
    at_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (const std::uint32_t v : triangles[t])
        at_[next[v]++] = t;
  }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t v) const {
    return std::span(at_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> at_;
};

bool has(std::span<const std::uint32_t> list, std::uint32_t one) { return std::ranges::find(list, one) != list.end(); }

// What leaves for a hole, and who takes up its liquid.
struct Patch {
  std::vector<std::uint32_t> triangles, receivers;
  std::vector<std::uint32_t> vertices; // of the triangles, those on the hole's border, too
};

class HoleMaker {
public:
  HoleMaker(const Frame& frame, const std::vector<bool>& supported)
      : mesh_(connect(frame.vertices, sheet::triangles(frame))), around_(mesh_.vertices, mesh_.triangles),
        x_(positions(frame)), volumes_(sheet::volumes(frame)), supported_(supported), closed_(supported),
        leaves_(mesh_.triangles.size(), false) {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (mesh_.on_rim(e))
        closed_[mesh_.edges[e][0]] = closed_[mesh_.edges[e][1]] = true;
  }

  // False: there is no room, and what it pierces is among narrow().
  bool open(const Site& site) {
    const std::vector<std::uint32_t> vertices = near(site);
    for (const std::uint32_t v : vertices)
      if (const std::optional<Patch> patch = closed_[v] ? std::nullopt : patch_at(v)) {
        take(*patch);
        return true;
      }
    std::ranges::copy(around_[vertices.front()], std::back_inserter(narrow_));
    return false;
  }

  [[nodiscard]] const std::vector<bool>& leaves() const { return leaves_; }
  [[nodiscard]] std::span<const Lying> deposits() const { return deposits_; }
  // By their numbers when all that leaves is gone.
  [[nodiscard]] std::vector<std::uint32_t> narrow() const {
    std::vector<std::uint32_t> numbers;
    std::uint32_t next = 0;
    for (const bool gone : leaves_)
      numbers.push_back(gone ? no_index : next++);
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : narrow_)
      if (numbers[t] != no_index)
        found.push_back(numbers[t]);
    return found;
  }

private:
  [[nodiscard]] double area(std::uint32_t t) const {
    const Corners& c = mesh_.triangles[t];
    return TriangleArea(x_[c[0]], x_[c[1]], x_[c[2]]).area;
  }

  // Vertices within reach of the site, the nearest first.
  [[nodiscard]] std::vector<std::uint32_t> near(const Site& site) const {
    const Corners& c = mesh_.triangles[site.triangle];
    std::vector<std::uint32_t> found(c.begin(), c.end());
    for (std::size_t ring = 0, begin = 0; ring < steps_away; ++ring)
      for (const std::size_t end = found.size(); begin < end; ++begin)
        for (const std::uint32_t t : around_[found[begin]])
          for (const std::uint32_t v : mesh_.triangles[t])
            if (!has(found, v))
              found.push_back(v);
    std::ranges::sort(found, {}, [&](std::uint32_t v) { return std::pair((x_[v] - site.place).squaredNorm(), v); });
    return found;
  }

  // Triangles around the vertex, and around others near it, until they are as large as a hole must be; nothing if they
  // reach what is closed, are no disk, or leave nothing that could take up their liquid.
  [[nodiscard]] std::optional<Patch> patch_at(std::uint32_t center) const {
    Patch patch;
    std::vector<std::uint32_t> inner{center};
    for (double whole = 0, volume = 0;;) {
      for (const std::uint32_t t : around_[inner.back()])
        if (!has(patch.triangles, t)) {
          patch.triangles.push_back(t);
          whole += area(t);
          volume += volumes_[t];
          for (const std::uint32_t v : mesh_.triangles[t])
            if (!has(patch.vertices, v))
              patch.vertices.push_back(v);
        }
      if (std::ranges::any_of(patch.vertices, [&](std::uint32_t v) { return closed_[v]; }))
        return std::nullopt;
      const double radius = least_radius * volume / whole;
      if (whole >= std::numbers::pi * radius * radius)
        break;
      const std::uint32_t next = nearest_border(patch, inner, center);
      if (next == no_index)
        return std::nullopt;
      inner.push_back(next);
    }
    if (!is_disk(patch) || !find_receivers(patch))
      return std::nullopt;
    return patch;
  }

  [[nodiscard]] std::uint32_t nearest_border(const Patch& patch, std::span<const std::uint32_t> inner,
                                             std::uint32_t center) const {
    std::pair nearest(std::numeric_limits<double>::infinity(), no_index);
    for (const std::uint32_t v : patch.vertices)
      if (!has(inner, v))
        nearest = std::min(nearest, std::pair((x_[v] - x_[center]).squaredNorm(), v));
    return nearest.second;
  }

  // One border, which meets itself nowhere, and nothing but triangles in it.
  [[nodiscard]] bool is_disk(const Patch& patch) const {
    std::map<std::uint32_t, int> at; // sides of the border at each vertex
    std::size_t sides = 0;
    for (const std::uint32_t t : patch.triangles)
      for (const std::uint32_t e : mesh_.triangle_edges[t]) {
        const auto [one, other] = mesh_.edge_triangles[e];
        if (has(patch.triangles, one) && has(patch.triangles, other))
          continue;
        ++sides;
        for (const std::uint32_t v : mesh_.edges[e])
          ++at[v];
      }
    const std::size_t edges = (3 * patch.triangles.size() + sides) / 2;
    return std::ranges::all_of(at, [](const auto& of) { return of.second == 2; }) &&
           patch.vertices.size() + patch.triangles.size() == edges + 1;
  }

  // Triangles around the patch, none of whose corners is supported. False if there are none, or nearly nothing is left.
  bool find_receivers(Patch& patch) const {
    for (const std::uint32_t v : patch.vertices)
      for (const std::uint32_t t : around_[v])
        if (!has(patch.triangles, t) && !has(patch.receivers, t) &&
            std::ranges::none_of(mesh_.triangles[t], [&](std::uint32_t w) { return supported_[w]; }) && area(t) > 0)
          patch.receivers.push_back(t);
    std::ranges::sort(patch.receivers);
    if (patch.receivers.empty())
      return false;
    std::vector<std::uint32_t> left{patch.receivers.front()};
    for (std::size_t i = 0; i < left.size() && left.size() < crumb; ++i)
      for (const std::uint32_t e : mesh_.triangle_edges[left[i]])
        for (const std::uint32_t t : mesh_.edge_triangles[e])
          if (t != no_index && !leaves_[t] && !has(patch.triangles, t) && !has(left, t))
            left.push_back(t);
    return left.size() >= crumb;
  }

  void take(const Patch& patch) {
    double whole = 0;
    for (const std::uint32_t t : patch.receivers)
      whole += area(t);
    for (const std::uint32_t from : patch.triangles) {
      leaves_[from] = true;
      for (const std::uint32_t to : patch.receivers)
        deposits_.push_back({.upper = from, .lower = to, .part = area(to) / whole, .gap = 0});
    }
    for (const std::uint32_t v : patch.vertices)
      closed_[v] = true;
  }

  Connectivity mesh_;
  Around around_;
  std::span<const Vector3> x_;
  std::span<const double> volumes_;
  const std::vector<bool>& supported_;
  std::vector<bool> closed_; // vertices that no hole may have
  std::vector<bool> leaves_; // triangles
  std::vector<Lying> deposits_;
  std::vector<std::uint32_t> narrow_; // triangles
};

} // namespace

Holes open_holes(Frame& frame, std::span<const Site> sites, const std::vector<bool>& supported) {
  Holes holes;
  if (sites.empty())
    return holes;
  HoleMaker maker(std::as_const(frame), supported);
  for (const Site& site : sites)
    ++(maker.open(site) ? holes.opened : holes.without_room);
  holes.pierced = maker.narrow();
  if (holes.opened == 0)
    return holes;
  (void)deposit(frame, maker.deposits()); // nothing lies above anything, so nothing moves
  (void)drop(frame, maker.leaves(), {});  // what leaves has nothing left, whatever its density
  return holes;
}

} // namespace sheet::flow
