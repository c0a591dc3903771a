// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/merge_patches.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "libsheet/flow/contact_dates.h"
#include "libsheet/flow/tear_cuts.h"
#include "libsheet/flow/whole_patches.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/material/driven_rate.h"
#include "libsheet/material/shifted_liquid.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

using formats::Frame;

namespace {

constexpr double all_of_it = 0.999; // of a triangle's area
constexpr double most_of_it = 0.5;  // of one that juts out over the rim of what it lies on
constexpr double most_edges = 2;
constexpr double much_less = 0.9;                // of a piece's volume
constexpr std::array<double, 2> sides = {1, -1}; // towards the positive face, and the other one

// Pieces of the sheet that hang together across edges.
struct Pieces {
  std::vector<std::uint64_t> of; // each triangle
  std::vector<double> volume;    // [m³]
  std::vector<bool> open;        // they have a rim

  Pieces(const Connectivity& mesh, std::span<const double> volumes) {
    DisjointSets sets(mesh.triangles.size());
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      if (!mesh.on_rim(e))
        sets.join(mesh.edge_triangles[e][0], mesh.edge_triangles[e][1]);
    of = sets.take();
    volume.assign(of.size(), 0);
    open.assign(of.size(), false);
    for (std::size_t t = 0; t < of.size(); ++t) {
      volume[of[t]] += volumes[t];
      for (const std::uint32_t e : mesh.triangle_edges[t])
        if (mesh.on_rim(e))
          open[of[t]] = true;
    }
  }
};

// Which of two layers is taken up, and what may not be: layers of two liquids stay two.
class Order {
public:
  Order(const Frame& frame, const Connectivity& mesh, const Scene& scene)
      : mesh_(mesh), liquids_(scene, frame), pieces_(mesh, volumes(frame)), held_(mesh.vertices, false),
        on_solid_(mesh.vertices, false), only_on_solids_(scene.merge->on_solids),
        up_(scene::up(scene.environment).value_or(Vector3::Zero())) {
    const std::vector<std::int32_t> touched = touched_solids(frame);
    for (std::size_t v = 0; v < touched.size(); ++v)
      on_solid_[v] = touched[v] != no_solid;
    for (const std::string_view name : {"hold", "inlet"}) {
      const auto bits = masks(frame, name);
      for (std::size_t v = 0; v < bits.size(); ++v)
        held_[v] = held_[v] || bits[v] != 0;
    }
  }

  [[nodiscard]] std::uint64_t piece(std::uint32_t t) const { return pieces_.of[t]; }

  [[nodiscard]] bool may_go(std::uint32_t t) const {
    return pieces_.open[pieces_.of[t]] && !any_corner(t, on_solid_) && !any_corner(t, held_);
  }

  // Whether the upper one, which may go, is the one of the two that does.
  [[nodiscard]] bool goes(const Lying& l) const {
    if (any_corner(l.lower, held_) || liquids_.number(l.upper) != liquids_.number(l.lower))
      return false;
    const bool on_solid = std::ranges::all_of(mesh_.triangles[l.lower], [&](std::uint32_t v) { return on_solid_[v]; });
    if (on_solid || only_on_solids_)
      return on_solid;
    if (any_corner(l.lower, on_solid_))
      return true;
    const std::uint64_t own = pieces_.of[l.upper], other = pieces_.of[l.lower];
    const double volume = pieces_.volume[own], others = pieces_.volume[other], rises = l.normal.dot(up_);
    if (rises != 0 && volume >= much_less * others && others >= much_less * volume)
      return rises > 0;
    return volume != others ? volume < others : l.upper > l.lower;
  }

private:
  [[nodiscard]] bool any_corner(std::uint32_t t, const std::vector<bool>& is) const {
    return std::ranges::any_of(mesh_.triangles[t], [&](std::uint32_t v) { return is[v]; });
  }

  const Connectivity& mesh_;
  FrameLiquids liquids_;
  Pieces pieces_;
  std::vector<bool> held_, on_solid_; // vertices
  bool only_on_solids_;
  Vector3 up_;
};

// What each triangle lies on that may go there.
class Candidates {
public:
  Candidates(const Frame& frame, const Connectivity& mesh, const Scene& scene)
      : frame_(frame), mesh_(mesh), scene_(scene), liquids_(scene, frame), laws_(laws_of(liquids_)),
        areas_(areas_of(frame, mesh)), thickness_(thickness_of(frame, areas_)),
        dates_(contact_dates(frame, mesh, areas_)), order_(frame, mesh, scene),
        layers_(mesh, positions(frame), areas_, thickness_, ripe_triangles()), on_(mesh.triangles.size()) {
    std::vector<std::uint32_t> not_enough;
    for (std::uint32_t t = 0; t < on_.size(); ++t)
      if (areas_[t].area > 0 && order_.may_go(t) && !look_below(t))
        not_enough.push_back(t);
    look_beside(not_enough);
    leave_one_way();
  }
  [[nodiscard]] const std::vector<LyingOn>& on() const { return on_; }
  [[nodiscard]] double ripe() const { return ripe_; } // volume of all that would go, enough or not [m³]

private:
  struct Law {
    FlowCurve curve;
    ViscosityShift shift;
  };
  static std::vector<Law> laws_of(const FrameLiquids& liquids) {
    std::vector<Law> laws;
    for (const Liquid& liquid : liquids.all())
      laws.push_back({FlowCurve(liquid), ViscosityShift(liquid.temperature_law)});
    return laws;
  }

  static std::vector<TriangleArea> areas_of(const Frame& frame, const Connectivity& mesh) {
    const auto x = positions(frame);
    std::vector<TriangleArea> areas;
    for (const Corners& c : mesh.triangles)
      areas.emplace_back(x[c[0]], x[c[1]], x[c[2]]);
    return areas;
  }

  // Where triangles are crushed that is beyond sense, so no more than two edges, as for contacts (collide_stage.cpp).
  static std::vector<double> thickness_of(const Frame& frame, std::span<const TriangleArea> areas) {
    std::vector<double> thickness;
    for (const double volume : volumes(frame)) {
      const TriangleArea& a = areas[thickness.size()];
      const double around = a.edge[0].norm() + a.edge[1].norm() + a.edge[2].norm();
      thickness.push_back(std::min(volume / a.area, most_edges * around / 3));
    }
    return thickness;
  }

  // As it is strained, or as tension strains it, whichever is faster [1/s].
  [[nodiscard]] StrainRate rate(std::uint32_t t, double shift) const {
    const auto x = positions(frame_), v = velocities(frame_);
    const auto [a, b, c] = mesh_.triangles[t];
    const double drawn =
        driven_rate(liquids_.of(t), laws_[liquids_.number(t)].curve, tension(t) / thickness_[t]) / shift;
    return {std::max(drawn * drawn, v.empty() ? 0 : strain_rate({x[a], x[b], x[c]}, {v[a], v[b], v[c]}).squared)};
  }
  [[nodiscard]] double viscosity(std::uint32_t t) const {
    const auto temperature = temperatures(frame_);
    const Law& law = laws_[liquids_.number(t)];
    const double shift = temperature.empty() ? 1 : law.shift.factor(temperature[t]);
    return ShiftedCurve{law.curve, shift}.viscosity(law.curve.newtonian() ? StrainRate{} : rate(t, shift));
  }
  [[nodiscard]] double tension(std::uint32_t t) const {
    const auto temperature = temperatures(frame_);
    const Liquid& liquid = liquids_.of(t);
    return temperature.empty() ? liquid.surface_tension : liquid.surface_tension_at(temperature[t]);
  }

  [[nodiscard]] bool ripe(std::uint32_t t, std::size_t side) const {
    double since = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : mesh_.triangles[t])
      since = std::max(since, dates_[v][side]);
    return since <= frame_.time &&
           frame_.time - since >= scene_.merge->after.value_or(viscosity(t) * thickness_[t] / tension(t));
  }

  [[nodiscard]] std::vector<std::uint8_t> ripe_triangles() const {
    std::vector<std::uint8_t> flags;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      flags.push_back(order_.may_go(t) && (ripe(t, 0) || ripe(t, 1)));
    return flags;
  }

  [[nodiscard]] bool goes(const LyingOn& on) const {
    return !on.parts.empty() && std::ranges::all_of(on.parts, [&](const Lying& l) { return order_.goes(l); });
  }

  // False if t is not over what is on either side of it.
  bool look_below(std::uint32_t t) {
    bool counted = false;
    for (std::size_t side = 0; side < sides.size(); ++side) {
      if (!ripe(t, side))
        continue;
      LyingOn on = layers_.nearest(t, sides[side]);
      if (!goes(on))
        continue;
      ripe_ += counted ? 0 : volumes(frame_)[t];
      counted = true;
      if (on.covered >= most_of_it && on.covered <= 2 - all_of_it) {
        on_[t] = std::move(on);
        return true;
      }
    }
    return false;
  }

  // What juts out over the rim of what its neighbour lies on goes there as well.
  void look_beside(std::span<const std::uint32_t> triangles) {
    const std::vector<LyingOn> before = on_;
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t e : mesh_.triangle_edges[t])
        for (const std::uint32_t s : mesh_.edge_triangles[e])
          if (s != no_index && on_[t].parts.empty() && !before[s].parts.empty() && (ripe(t, 0) || ripe(t, 1)))
            if (LyingOn on = layers_.beside(t, before[s]); goes(on))
              on_[t] = std::move(on);
  }

  // Of two pieces that lie on each other one goes, and it takes up nothing meanwhile: else patches of many layers of a
  // pile would go here and there, as they happen to lie on what goes, and leave islands of each. The two of which most
  // triangles would go come first; crumbs decide nothing.
  void leave_one_way() {
    using Pair = std::pair<std::uint64_t, std::uint64_t>; // the upper piece, the lower one
    const auto each_pair = [&](std::uint32_t t, auto visit) {
      for (const Lying& l : on_[t].parts)
        if (const Pair pair{order_.piece(t), order_.piece(l.lower)}; pair.first != pair.second)
          visit(pair);
    };
    std::map<Pair, std::size_t> count;
    for (std::uint32_t t = 0; t < on_.size(); ++t)
      each_pair(t, [&](const Pair& pair) { ++count[pair]; });
    std::vector<std::pair<std::size_t, Pair>> pairs;
    for (const auto& [pair, triangles] : count)
      if (triangles >= crumb)
        pairs.emplace_back(triangles, pair);
    std::ranges::stable_sort(pairs, std::greater<>(), [](const auto& p) { return p.first; });
    std::set<std::uint64_t> go, take;
    for (const auto& [triangles, pair] : pairs)
      if (!take.contains(pair.first) && !go.contains(pair.second)) {
        go.insert(pair.first);
        take.insert(pair.second);
      }
    for (std::uint32_t t = 0; t < on_.size(); ++t) {
      bool other_way = false;
      each_pair(t, [&](const Pair& pair) { other_way |= take.contains(pair.first) || go.contains(pair.second); });
      if (other_way)
        on_[t] = {};
    }
  }

  const Frame& frame_;
  const Connectivity& mesh_;
  const Scene& scene_;
  FrameLiquids liquids_;
  std::vector<Law> laws_; // of each liquid
  std::vector<TriangleArea> areas_;
  std::vector<double> thickness_;
  std::vector<Dates> dates_;
  Order order_;
  LayersBelow layers_;
  std::vector<LyingOn> on_;
  double ripe_ = 0;
};

// What is below is decided first, so that nothing is taken up by what is taken up.
class Choice {
public:
  explicit Choice(const std::vector<LyingOn>& candidates)
      : candidates_(candidates), decided_(candidates.size(), false), takes_(candidates.size(), false),
        taken_(candidates.size(), false) {
    for (std::uint32_t t = 0; t < candidates.size(); ++t)
      decide(t);
  }
  [[nodiscard]] const std::vector<bool>& taken() const { return taken_; }

private:
  void decide(std::uint32_t t) {
    const std::vector<Lying>& on = candidates_[t].parts;
    if (decided_[t] || on.empty())
      return;
    decided_[t] = true;
    for (const Lying& l : on)
      decide(l.lower);
    if (takes_[t] || std::ranges::any_of(on, [&](const Lying& l) { return taken_[l.lower]; }))
      return;
    taken_[t] = true;
    for (const Lying& l : on)
      takes_[l.lower] = true;
  }

  const std::vector<LyingOn>& candidates_;
  std::vector<bool> decided_, takes_, taken_;
};

// Whether t juts out over what it lies on and is not the last thing before a rim or a bend down to that.
bool juts_out(const Connectivity& mesh, std::uint32_t t, const LyingOn& on, const std::vector<bool>& taken) {
  if (on.covered >= all_of_it)
    return false;
  for (const std::uint32_t e : mesh.triangle_edges[t])
    for (const std::uint32_t s : mesh.edge_triangles[e])
      if (s != no_index && !taken[s] && std::ranges::find(on.parts, s, &Lying::lower) == on.parts.end())
        return true;
  return false;
}

} // namespace

MergePatches find_patches(const Frame& frame, const Connectivity& mesh, const Scene& scene) {
  MergePatches found;
  const Candidates search(frame, mesh, scene);
  const std::vector<LyingOn>& candidates = search.on();
  found.ripe = search.ripe();
  found.taken = Choice(candidates).taken();
  leave_whole_patches(
      mesh, [&](std::uint32_t t) { return juts_out(mesh, t, candidates[t], found.taken); }, found.taken);
  for (std::uint32_t t = 0; t < candidates.size(); ++t)
    if (found.taken[t])
      found.lying.insert(found.lying.end(), candidates[t].parts.begin(), candidates[t].parts.end());
  return found;
}

} // namespace sheet::flow
