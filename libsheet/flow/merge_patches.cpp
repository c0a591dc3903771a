// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/merge_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/overlap.h"
#include "libsheet/geometry/triangle_grid.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr std::size_t crumb = 8;                 // triangles
constexpr double reach = 1.5;                    // mean thicknesses
constexpr double facing = 0.7;                   // cosine
constexpr double all_of_it = 0.999;              // of a triangle's area
constexpr double most_of_it = 0.5;               // of one that juts out over the rim of what it lies on
constexpr std::array<double, 2> sides = {1, -1}; // towards the positive face, and the other one

using Dates = std::array<double, 2>; // since when something touches each side [s]

// A triangle that may be taken up by what is on one of its sides.
struct Candidate {
  std::uint32_t triangle;
  std::vector<Lying> on = {};
  bool juts_out = false; // over the rim of what it lies on
};

class PatchSearch {
public:
  PatchSearch(const Frame& frame, const Connectivity& mesh, const Scene& scene)
      : frame_(frame), mesh_(mesh), scene_(scene), x_(positions(frame)), volume_(volumes(frame)),
        up_(scene::up(scene.environment).value_or(Vector3::Zero())) {}

  MergePatches run() {
    MergePatches found{std::vector<bool>(mesh_.triangles.size(), false), {}, 0};
    measure();
    find_pieces();
    find_dates();
    const std::vector<Candidate> candidates = all_candidates(found.ripe); // not changed again: taker_ points there
    if (candidates.empty())
      return found;
    choose(candidates, found.taken);
    leave_crumbs(found.taken);
    for (const Candidate& c : candidates)
      if (found.taken[c.triangle] && taker_[c.triangle] == &c)
        found.lying.insert(found.lying.end(), c.on.begin(), c.on.end());
    return found;
  }

private:
  void measure() {
    for (const Corners& c : mesh_.triangles)
      area_.emplace_back(x_[c[0]], x_[c[1]], x_[c[2]]);
    held_.assign(x_.size(), false);
    on_solid_.assign(x_.size(), false);
    const std::vector<std::int32_t> touched = touched_solids(frame_);
    for (std::size_t v = 0; v < x_.size(); ++v)
      on_solid_[v] = touched[v] != no_solid;
    for (const std::string_view name : {"hold", "inlet"})
      for (std::size_t v = 0; const std::uint64_t bits : masks(frame_, name))
        held_[v] = held_[v] || bits != 0, ++v;
  }

  // Pieces that hang together, their volume, and whether they have a rim.
  void find_pieces() {
    DisjointSets sets(mesh_.triangles.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (!mesh_.on_rim(e))
        sets.join(mesh_.edge_triangles[e][0], mesh_.edge_triangles[e][1]);
    piece_ = sets.take();
    piece_volume_.assign(piece_.size(), 0);
    open_.assign(piece_.size(), false);
    for (std::size_t t = 0; t < piece_.size(); ++t) {
      piece_volume_[piece_[t]] += volume_[t];
      for (const std::uint32_t e : mesh_.triangle_edges[t])
        if (mesh_.on_rim(e))
          open_[piece_[t]] = true;
    }
  }

  // The oldest contact of each vertex on each side.
  void find_dates() {
    std::vector<Vector3> normal(x_.size(), Vector3::Zero());
    for (std::size_t t = 0; t < area_.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t])
        normal[v] += area_[t].area * area_[t].normal;
    dates_.assign(x_.size(), {ContactSpring::undated, ContactSpring::undated});
    for (const ContactSpring& s : read_springs(frame_)) {
      const double since = s.since == ContactSpring::undated ? frame_.time : s.since;
      for (std::size_t i = 0; i < 4; ++i) {
        if (s.weights[i] == 0)
          continue;
        const bool first = i < s.second_feature(); // the spring's normal points from the second feature to it
        const bool above = (s.normal.dot(normal[s.vertices[i]]) > 0) != first;
        double& date = dates_[s.vertices[i]][above ? 0 : 1];
        date = std::min(date, since);
      }
    }
  }

  [[nodiscard]] double thickness(std::uint32_t t) const { return volume_[t] / area_[t].area; }

  [[nodiscard]] bool ripe(std::uint32_t t, std::size_t side) const {
    const double after =
        scene_.merge->after.value_or(scene_.material.viscosity * thickness(t) / scene_.material.surface_tension);
    return std::ranges::all_of(mesh_.triangles[t],
                               [&](std::uint32_t v) { return frame_.time - dates_[v][side] >= after; });
  }

  [[nodiscard]] bool any_corner(std::uint32_t t, const std::vector<bool>& is) const {
    return std::ranges::any_of(mesh_.triangles[t], [&](std::uint32_t v) { return is[v]; });
  }

  std::vector<Candidate> all_candidates(double& ripe_area) {
    std::vector<Candidate> candidates;
    std::optional<TriangleGrid> grid;
    for (std::uint32_t t = 0; t < area_.size(); ++t) {
      if (!open_[piece_[t]] || any_corner(t, on_solid_) || any_corner(t, held_))
        continue;
      bool any = false;
      for (std::size_t side = 0; side < sides.size(); ++side) {
        if (!(area_[t].area > 0) || !ripe(t, side))
          continue;
        any = true;
        if (!grid)
          grid.emplace(make_grid());
        Candidate c = candidate(t, sides[side], *grid);
        if (!c.on.empty() && std::ranges::all_of(c.on, [&](const Lying& l) { return yields(t, l); }))
          candidates.push_back(std::move(c));
      }
      ripe_area += any ? area_[t].area : 0;
    }
    return candidates;
  }

  [[nodiscard]] Box box_of(std::uint32_t t, double margin) const {
    Box box;
    for (const std::uint32_t v : mesh_.triangles[t])
      box.add(x_[v], margin);
    return box;
  }

  [[nodiscard]] TriangleGrid make_grid() const {
    double sizes = 0;
    for (std::uint32_t t = 0; t < area_.size(); ++t)
      sizes += box_of(t, 0).half_size();
    TriangleGrid grid(2 * sizes / static_cast<double>(area_.size()), area_.size());
    for (std::uint32_t t = 0; t < area_.size(); ++t)
      if (area_[t].area > 0)
        grid.add(t, box_of(t, reach / 2 * thickness(t)));
    return grid;
  }

  // What triangle t lies on towards one side; nothing if that is not enough of it.
  [[nodiscard]] Candidate candidate(std::uint32_t t, double side, const TriangleGrid& grid) const {
    const Vector3& normal = area_[t].normal;
    const PlaneFrame plane(normal);
    const auto flat = [&](std::uint32_t of) {
      const Corners& c = mesh_.triangles[of];
      return FlatTriangle{plane.flat(x_[c[0]]), plane.flat(x_[c[1]]), plane.flat(x_[c[2]])};
    };
    const FlatTriangle own = flat(t);
    const double level = normal.dot(x_[mesh_.triangles[t][0]]);
    std::vector<Lying> on;
    double covered = 0;
    std::vector<std::uint32_t> near;
    grid.for_meeting(box_of(t, reach / 2 * thickness(t)), [&](std::uint32_t other) { near.push_back(other); });
    std::ranges::sort(near);
    for (const std::uint32_t other : near) {
      const double cosine = normal.dot(area_[other].normal);
      if (std::abs(cosine) < facing || share_corner(t, other))
        continue;
      const Overlap overlap = overlap_of(own, flat(other));
      if (overlap.area == 0)
        continue;
      const Vector3 middle = level * normal + overlap.middle[0] * plane.first + overlap.middle[1] * plane.second;
      const double height = area_[other].normal.dot(x_[mesh_.triangles[other][0]] - middle); // of the other one
      const double way = side * height / cosine;                                             // to it, along the side
      if (!(way > 0) || std::abs(height) > reach / 2 * (thickness(t) + thickness(other)))
        continue;
      covered += overlap.area;
      on.push_back({t, other, overlap.area, std::abs(height), -std::copysign(1.0, height) * area_[other].normal});
    }
    const double part = covered / area_[t].area;
    if (part < most_of_it || part > 2 - all_of_it)
      return {t};
    for (Lying& l : on)
      l.part /= covered;
    return {t, std::move(on), part < all_of_it};
  }

  [[nodiscard]] bool share_corner(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(mesh_.triangles[a], [&](std::uint32_t v) {
      return std::ranges::find(mesh_.triangles[b], v) != mesh_.triangles[b].end();
    });
  }

  // Whether t, which touches no solid, is the one of the two that is taken up.
  [[nodiscard]] bool yields(std::uint32_t t, const Lying& l) const {
    if (any_corner(l.lower, held_))
      return false;
    const bool lower_on_solid =
        std::ranges::all_of(mesh_.triangles[l.lower], [&](std::uint32_t v) { return on_solid_[v]; });
    if (lower_on_solid || scene_.merge->on_solids)
      return lower_on_solid;
    if (any_corner(l.lower, on_solid_))
      return true;
    const double own = piece_volume_[piece_[t]], other = piece_volume_[piece_[l.lower]];
    if (piece_[t] != piece_[l.lower] && own != other)
      return own < other;
    const double rises = l.normal.dot(up_);
    return rises != 0 ? rises > 0 : t > l.lower;
  }

  [[nodiscard]] double height(std::uint32_t t) const {
    const Corners& c = mesh_.triangles[t];
    return up_.dot(x_[c[0]] + x_[c[1]] + x_[c[2]]);
  }

  // From below upwards, so that nothing is taken up by what is taken up.
  void choose(const std::vector<Candidate>& candidates, std::vector<bool>& taken) {
    std::vector<const Candidate*> order;
    for (const Candidate& c : candidates)
      order.push_back(&c);
    std::ranges::stable_sort(order, {}, [&](const Candidate* c) { return height(c->triangle); });
    std::vector<bool> takes(taken.size(), false);
    taker_.assign(taken.size(), nullptr);
    for (const Candidate* c : order) {
      if (takes[c->triangle] || taken[c->triangle] ||
          std::ranges::any_of(c->on, [&](const Lying& l) { return taken[l.lower]; }))
        continue;
      taken[c->triangle] = true;
      taker_[c->triangle] = c;
      for (const Lying& l : c->on)
        takes[l.lower] = true;
    }
  }

  // Gives back what would make small patches, leave small pieces, pinch vertices, or go with less than its whole area
  // on what it lies on and not as the last thing before a rim, until nothing does.
  void leave_crumbs(std::vector<bool>& taken) const {
    for (bool changed = true; changed;) {
      std::vector<bool> back = pinching(taken);
      const std::vector<std::size_t> size = sizes_of_parts(taken);
      std::vector<bool> at_crumb(x_.size(), false);
      for (std::uint32_t t = 0; t < taken.size(); ++t)
        if (!taken[t] && size[t] < crumb)
          for (const std::uint32_t v : mesh_.triangles[t])
            at_crumb[v] = true;
      changed = false;
      for (std::uint32_t t = 0; t < taken.size(); ++t)
        if (taken[t] && (back[t] || size[t] < crumb || any_corner(t, at_crumb) ||
                         (taker_[t]->juts_out && beside_staying(t, taken)))) {
          taken[t] = false;
          changed = true;
        }
    }
  }

  [[nodiscard]] bool beside_staying(std::uint32_t t, const std::vector<bool>& taken) const {
    return std::ranges::any_of(mesh_.triangle_edges[t], [&](std::uint32_t e) {
      return std::ranges::any_of(mesh_.edge_triangles[e], [&](std::uint32_t s) { return s != no_index && !taken[s]; });
    });
  }

  // For each triangle, how many hang together with it across edges and go or stay as it does.
  [[nodiscard]] std::vector<std::size_t> sizes_of_parts(const std::vector<bool>& taken) const {
    DisjointSets sets(taken.size());
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (const auto [s, t] = mesh_.edge_triangles[e]; !mesh_.on_rim(e) && taken[s] == taken[t])
        sets.join(s, t);
    const std::vector<std::uint64_t> part = sets.take();
    std::vector<std::size_t> count(taken.size(), 0), size;
    for (const std::uint64_t p : part)
      ++count[p];
    for (const std::uint64_t p : part)
      size.push_back(count[p]);
    return size;
  }

  // The triangles at vertices around which what stays would be more than one fan: as many as there are rims there.
  [[nodiscard]] std::vector<bool> pinching(const std::vector<bool>& taken) const {
    std::vector<int> rims(x_.size(), 0);
    const auto stays = [&](std::uint32_t t) { return t != no_index && !taken[t]; };
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
      if (stays(mesh_.edge_triangles[e][0]) != stays(mesh_.edge_triangles[e][1]))
        for (const std::uint32_t v : mesh_.edges[e])
          ++rims[v];
    std::vector<bool> back(taken.size(), false);
    for (std::uint32_t t = 0; t < taken.size(); ++t)
      back[t] = taken[t] && std::ranges::any_of(mesh_.triangles[t], [&](std::uint32_t v) { return rims[v] > 2; });
    return back;
  }

  const Frame& frame_;
  const Connectivity& mesh_;
  const Scene& scene_;
  std::span<const Vector3> x_;
  std::span<const double> volume_;
  Vector3 up_;
  std::vector<TriangleArea> area_;
  std::vector<bool> held_, on_solid_;   // vertices
  std::vector<std::uint64_t> piece_;    // of each triangle
  std::vector<double> piece_volume_;    // [m³]
  std::vector<bool> open_;              // pieces with a rim
  std::vector<Dates> dates_;            // of vertices
  std::vector<const Candidate*> taker_; // of taken triangles
};

} // namespace

MergePatches find_patches(const Frame& frame, const Connectivity& mesh, const Scene& scene) {
  return PatchSearch(frame, mesh, scene).run();
}

} // namespace sheet::flow
