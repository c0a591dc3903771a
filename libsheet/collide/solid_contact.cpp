// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/solid_contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/base/error.h"
#include "libsheet/collide/solid_sweep.h"
#include "libsheet/collide/touch_distance.h"
#include "libsheet/geometry/facing_walls.h"
#include "libsheet/geometry/longest_edges.h"
#include "libsheet/solid/corners.h"

namespace sheet::collide {
namespace {

// Rounds of impulses before what still hits is carried.
constexpr int rounds = 10;
// Of two corners with masses m and M the lighter moves by up to sqrt(M/m)/2 times the way of the triangle's point, so
// lighter ones count as having a part of M.
constexpr double least_mass_part = 1 / (4 * longest_lever * longest_lever);
// Gaps between two solids that are narrow, over the thickness of the sheet there.
constexpr double narrow = 0.5;
// Corners between two solids, as cosines between their normals, and how much less of the weight the second one may
// carry than the first: in a groove both carry half.
constexpr double flattest_corner = 0.9, same_load = 0.9;
// What two hits may differ by that come together: of the step, and of the thickness.
constexpr double same = 1e-7;

// A point of the solid's frame brought to `offset` from its surface, along the normal. One turn where the surface is
// smooth; a hollow narrower than the offset has no such point, so the turns are counted.
Vector3 settle(const solid::SolidDistance& shape, Vector3 x, double offset) {
  for (int turn = 0; turn < 10; ++turn) {
    const solid::Near near = shape.nearest(x);
    const double error = offset - near.distance;
    if (std::abs(error) <= 1e-9 * offset)
      break;
    x += error * near.normal;
  }
  return x;
}

// The least thickness that is one; infinity if there is none.
double thinnest(const StepPath& path) {
  double result = std::numeric_limits<double>::infinity();
  for (const double thickness : path.thickness)
    if (thickness > 0)
      result = std::min(result, thickness);
  return result;
}

// How exactly paths beside solids that turn are followed [m]: to a hundredth of the thickness. What has been drawn out
// to next to nothing, which a real film is torn long before, asks for no more than a thousandth of the mean does.
double deviation_of_paths(const StepPath& path) {
  constexpr double part = 0.01, least = 1e-3;
  const double sum = std::accumulate(path.thickness.begin(), path.thickness.end(), 0.0);
  return part * std::max(thinnest(path), least * sum / static_cast<double>(path.thickness.size()));
}

std::vector<SolidView> views_of(const solid::Solids& solids, const StepPath& path) {
  std::vector<SolidView> views;
  for (std::size_t i = 0; i < solids.size(); ++i)
    views.emplace_back(solids, i, path, deviation_of_paths(path));
  return views;
}

class Resolution {
public:
  Resolution(StepPath& path, const solid::Solids& solids)
      : path_(path), solids_(solids), prescribed_(path.fixed), free_end_(path.end), views_(views_of(solids, path)) {
    // Vertices of no triangle have no thickness of their own.
    const double least = thinnest(path);
    for (double& thickness : path.thickness)
      thickness = std::max(thickness, least);
    if (std::ranges::any_of(views_, &SolidView::flows))
      path.facing = facings(path);
    edges_ = longest_edges(path.start, path.triangles);
    path.stand_off = chord_allowances(path, views_, edges_);
    rides_.resize(path.start.size());
    for (std::size_t v = 0; v < rides_.size(); ++v)
      rides_[v] = held(v) ? no_solid : path.touch[v];
    changed_.assign(path.start.size(), 0);
    caught_.assign(path.start.size(), 0);
    between_ = squeezed();
    passes_ = solid::passing(path.triangles, rides_);
    turns_ = turning();
    carried_.assign(path.start.size(), 0);
    active_.resize(path.triangles.size());
    std::iota(active_.begin(), active_.end(), 0U);
  }

  SolidReport run() {
    hold_vertices();
    const auto mends = [this](std::uint32_t t, std::uint32_t solid) { return !stands_beside(t, solid); };
    for (int round = 0; round < rounds && !active_.empty(); ++round) {
      auto hits = find_hits(path_, views_, rides_, active_, {.mends = mends});
      std::ranges::stable_sort(hits, earlier); // whatever the order of the triangles
      count_across(hits);
      push(hits);
      report_.pushed += hits.size();
      activate();
    }
    while (!active_.empty()) {
      for (const FoundHit& hit : find_hits(path_, views_, rides_, active_))
        carry(hit);
      activate();
    }
    finish();
    return report_;
  }

private:
  // What is hit first is pushed first; of what is too near all the time, the deepest.
  static bool earlier(const FoundHit& a, const FoundHit& b) {
    return std::pair(a.s, a.point.near.distance) < std::pair(b.s, b.point.near.distance);
  }

  // Whether two hits come at the same time and as deep, but for round-off.
  [[nodiscard]] bool together(const FoundHit& a, const FoundHit& b) const {
    const double thickness = path_.thickness[path_.triangles[a.triangle][0]];
    return std::abs(a.s - b.s) <= same && std::abs(a.point.near.distance - b.point.near.distance) <= same * thickness;
  }

  // One after the other; a vertex that several push together goes the mean of their ways: no order of them counts.
  void push(std::span<const FoundHit> hits) {
    for (std::size_t first = 0, last = 0; first < hits.size(); first = last) {
      for (last = first + 1; last < hits.size() && together(hits[last - 1], hits[last]);)
        ++last;
      std::map<std::uint32_t, Push> pushes;
      for (const FoundHit& hit : hits.subspan(first, last - first))
        push(hit, pushes);
      for (const auto& [v, push] : pushes) {
        path_.end[v] += push.way / push.count;
        path_.velocity[v] += push.change / push.count;
      }
    }
  }

  // By a [[hold]], along all axes.
  [[nodiscard]] bool held(std::size_t v) const { return prescribed_[v] == all_axes; }

  // Vertices that touch, or come to.
  void hold_vertices() {
    const std::size_t n = path_.start.size();
    std::vector<double> depth(n, 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 256), [&](const auto& range) {
      for (auto v = static_cast<std::uint32_t>(range.begin()); v < range.end(); ++v) {
        if (held(v))
          continue;
        if (turns_[v] != no_solid)
          turn(v);
        else if (rides_[v] != no_solid && is_off(v))
          rides_[v] = path_.touch[v] = no_solid;
        if (const auto floor = floor_below(v))
          come_to_touch(v, *floor);
        else if (rides_[v] != no_solid) {
          const SolidView& view = views_[static_cast<std::size_t>(rides_[v])];
          const Vector3 own = view.own(view.pieces(), path_.end[v]);
          hold(v, own, kept_distance(v, own));
        } else if (const auto hit = first_hit(path_, views_, v, depth[v])) {
          come_to_touch(v, *hit);
        }
      }
    });
    bring_out(depth);
    for (const std::uint8_t c : caught_)
      report_.caught += c;
  }

  void come_to_touch(std::uint32_t v, const VertexHit& hit) {
    rides_[v] = static_cast<std::int32_t>(hit.solid);
    caught_[v] = 1;
    hold(v, slides(v) ? slid(v, hit) : carried_on(hit), caught_distance(v, hit));
  }

  // Where what flows down one solid meets another one that carries at least as much of its weight, at an angle: from
  // then on it lies on that, and is free to flow on, away from the first one. Held by that still, it would be crushed
  // in the corner by all that follows.
  [[nodiscard]] std::optional<VertexHit> floor_below(std::uint32_t v) const {
    if (views_.size() < 2 || !slides(v) || between_[v] != 0)
      return std::nullopt;
    double deepest = 0;
    const auto hit = first_hit(path_, views_, v, deepest, rides_[v]);
    if (!hit)
      return std::nullopt;
    const auto normal_of = [&](std::size_t solid) {
      return solids_.at(solid, path_.start[v], path_.start_time).normal;
    };
    const Vector3 wall = normal_of(static_cast<std::size_t>(rides_[v])), floor = normal_of(hit->solid);
    const double angle = wall.dot(floor), load = -path_.gravity.dot(floor);
    const bool corner = angle < flattest_corner && angle > -least_facing;
    return corner && load > 0 && load >= -path_.gravity.dot(wall) * same_load ? hit : std::nullopt;
  }

  // Of each vertex, the solid in whose corner with its own one it turns, as sheet-step has it (walls.h), or no_solid.
  [[nodiscard]] std::vector<std::int32_t> turning() const {
    std::vector<std::int32_t> flowing(rides_.size(), no_solid);
    for (std::uint32_t v = 0; v < flowing.size(); ++v)
      if (slides(v) && between_[v] == 0)
        flowing[v] = rides_[v];
    return solid::turned_to(
        solids_, {path_.start, path_.triangles, path_.thickness, edges_, flowing, path_.start_time, path_.gravity});
  }

  // From then on such a vertex flows along the one of the two solids that is nearer at the end.
  void turn(std::uint32_t v) {
    const auto end = [&](std::int32_t solid) {
      return solids_.at(static_cast<std::size_t>(solid), path_.end[v], path_.end_time).distance;
    };
    if (end(turns_[v]) < end(rides_[v]))
      rides_[v] = turns_[v];
  }

  // Whether what touches the vertex' solid flows along it.
  [[nodiscard]] bool slides(std::uint32_t v) const {
    return rides_[v] != no_solid &&
           (between_[v] != 0 || solids_.scene(static_cast<std::size_t>(rides_[v])).contact != SolidContact::stick);
  }

  // The vertices that start between their solid and another one which leave them no room: those flow even where liquid
  // sticks, if any solid moves, as sheet-step has it (scene_model.h).
  [[nodiscard]] std::vector<std::uint8_t> squeezed() const {
    std::vector<std::uint8_t> between(rides_.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, solids_.may_squeeze() ? rides_.size() : 0, 256),
                      [&](const auto& range) {
                        for (auto v = static_cast<std::uint32_t>(range.begin()); v < range.end(); ++v)
                          between[v] = is_squeezed(v) ? 1 : 0;
                      });
    return between;
  }

  [[nodiscard]] bool is_squeezed(std::uint32_t v) const {
    return rides_[v] != no_solid && solids_.squeezed(static_cast<std::size_t>(rides_[v]), path_.start[v],
                                                     path_.start_time, path_.thickness[v], edges_[v]);
  }

  // Where a vertex goes that hits a solid and slides on: what is left of its path, along the surface.
  [[nodiscard]] Vector3 slid(std::uint32_t v, const VertexHit& hit) const {
    const SolidView& view = views_[hit.solid];
    const Vector3 normal = view.shape().nearest(hit.place).normal;
    const Vector3 rest = view.own(view.pieces(), path_.end[v]) - hit.place;
    return hit.place + rest - normal.dot(rest) * normal;
  }

  // Where a vertex is at the end that sticks to the solid from its hit on, in the solid's frame.
  [[nodiscard]] Vector3 carried_on(const VertexHit& hit) const {
    const SolidView& view = views_[hit.solid];
    return view.runs() ? Vector3(hit.place + view.belt(1 - hit.s, view.shape().nearest(hit.place).normal)) : hit.place;
  }

  [[nodiscard]] const SolidView& own_view(std::uint32_t v) const { return views_[static_cast<std::size_t>(rides_[v])]; }

  // Whether a vertex that touches is farther from its solid than the sheet is thick: a change of the mesh over a hollow
  // may have put it there. Not what flows and sheet-step has brought to its distance (wall_distance.h): beside a hold,
  // which keeps its distance while the layer thins, new vertices are put on chords above the layer.
  [[nodiscard]] bool is_off(std::uint32_t v) const {
    const double thickness = path_.thickness[v] + 2 * path_.stand_off[v];
    const SolidView& view = own_view(v);
    const auto far = [&](const Vector3& own) { return view.shape().distance(own, thickness) >= thickness; };
    return far(view.own(0, path_.start[v])) && !(slides(v) && !far(view.own(view.pieces(), path_.end[v])));
  }

  // The distance at which a vertex is held that is caught; one that starts nearer and flows is not lifted.
  [[nodiscard]] double caught_distance(std::uint32_t v, const VertexHit& hit) const {
    const SolidView& view = views_[hit.solid];
    const Vector3 start = view.own(0, path_.start[v]);
    const double half = path_.half_thickness(v), way = (path_.end[v] - path_.start[v]).norm();
    const double full = catching_distance(path_, view, v, start, half + way);
    return view.flows() ? std::clamp(view.shape().nearest(start).distance, std::min(half / 2, full), full) : full;
  }

  // The distance at which a vertex that touches ends from its solid. What flows keeps the one that sheet-step gave it
  // (wall_distance.h), what sticks that at which it starts: from a quarter of the thickness to nine tenths of it. Set
  // to half each time, it would sink as the sheet thins until a triangle beside it is too near and pushes it out, and
  // come back at once, at every few steps; and where a sheet stands on its rim the row that touches would rise as it
  // grows thicker, and grow thicker as it rises; likewise where a layer stands beside an upright face of the solid on
  // which it lies. Nor is it brought in when chords beside it become shallower, by up to a half: it would jump whenever
  // a triangle beside it is pushed.
  [[nodiscard]] double kept_distance(std::uint32_t v, const Vector3& own) const {
    const double half = path_.half_thickness(v), thickness = path_.thickness[v];
    const double quarter = half - thickness / 4;
    if (slides(v)) {
      const double distance = own_view(v).shape().nearest(own).distance;
      return distance < quarter ? std::max(distance, least_on_wall(v, quarter)) : distance;
    }
    const double start = own_view(v).shape().nearest(own_view(v).own(0, path_.start[v])).distance;
    return std::clamp(start, quarter, half + 0.4 * thickness + path_.stand_off[v]);
  }

  // Puts the vertex's end where it holds on to its solid: near that place of the solid's frame, at this distance from
  // it, out of the others.
  void hold(std::uint32_t v, Vector3 own, double distance) {
    const SolidView& view = own_view(v);
    own = settle(view.shape(), own, distance);
    Vector3 end = view.world_at_end(own);
    // Between solids that nearly meet, in turns: out of the others, back to the own one.
    for (int turn = 0; turn < 10; ++turn) {
      bool moved = false;
      for (const SolidView& other : views_) {
        const Vector3 there = other.own(other.pieces(), end);
        const double offset = &other == &view ? 0 : beside_distance(v, other);
        if (&other == &view || (slides(v) && faces(view, other, end)) ||
            other.shape().distance(there, offset) >= offset * (1 - 1e-6) ||
            (slides(v) && passes_below(v, static_cast<std::size_t>(&other - views_.data()), end)))
          continue;
        end = other.world_at_end(settle(other.shape(), there, offset));
        moved = true;
      }
      if (!moved)
        break;
      end = view.world_at_end(settle(view.shape(), view.own(view.pieces(), end), distance));
    }
    const bool between = prescribed_[v] != 0 && turns_[v] == no_solid;
    path_.end[v] = between ? beside_hold(v, end, distance) : with_fixed(prescribed_[v], path_.end[v], end);
  }

  // Whether another solid faces the own one across a point, at the end. What flows between two such solids sheet-step
  // keeps in the gap (channels.h).
  [[nodiscard]] static bool faces(const SolidView& own, const SolidView& other, const Vector3& end) {
    const auto normal = [&](const SolidView& view) {
      return view.turned_at_end(view.shape().nearest(view.own(view.pieces(), end)).normal);
    };
    return -normal(own).dot(normal(other)) > least_facing;
  }

  // Whether an edge of another solid is above what is at a place at the end: there, too, sheet-step keeps it in the
  // gap.
  [[nodiscard]] bool passes_below(std::uint32_t v, std::size_t other, const Vector3& end) const {
    const auto own = static_cast<std::size_t>(rides_[v]);
    const auto of = [&](std::size_t s) {
      return [this, s](const Vector3& x) { return solids_.at(s, x, path_.end_time); };
    };
    const double gap = gap_beside(end, of(own), of(other), edges_[v], least_gap * path_.thickness[v]).gap;
    return std::isfinite(gap) && solids_.at(own, end, path_.end_time).distance < gap;
  }

  // Whether a vertex flows beside a face of a solid that is upright, as the side of a dish, or that comes along its own
  // solid, as a scraper, which may lean. `normal`: of the face, in the solid's frame. Where the sheet goes on to
  // another solid it is to come away from the corner.
  [[nodiscard]] bool flows_beside(std::uint32_t v, const SolidView& view, const Vector3& normal) const {
    constexpr double upright = 0.3, leaning = 0.9; // cosine between the normal and gravity
    const Vector3 outward = view.turned_at_end(normal);
    const double steep = std::abs(path_.gravity.dot(outward)) / path_.gravity.norm();
    return slides(v) && passes_[v] == 0 && (steep < upright || (steep < leaning && comes_along(v, view, outward)));
  }

  // Whether a solid of that normal comes towards the vertex' own one, or slides past.
  [[nodiscard]] bool comes_along(std::uint32_t v, const SolidView& view, const Vector3& normal) const {
    const auto velocity = [&](std::size_t solid) {
      return solids_.at(solid, path_.start[v], path_.start_time).velocity;
    };
    const Vector3 relative =
        velocity(static_cast<std::size_t>(&view - views_.data())) - velocity(static_cast<std::size_t>(rides_[v]));
    return relative.norm() > 0 && relative.dot(normal) >= -1e-9 * relative.norm();
  }

  // How near a vertex that slides may end to its own solid: a quarter of the thickness, or as near as it starts, where
  // it stands with its rim beside an upright face of the solid, across the sheet, and lies on another one.
  [[nodiscard]] double least_on_wall(std::uint32_t v, double quarter) const {
    constexpr double least_lying = 0.5; // cosine between the normals of the face and the sheet
    if (path_.facing.empty())           // what sticks slides only where it is squeezed
      return quarter;
    const SolidView& view = own_view(v);
    const solid::Near start = view.shape().nearest(view.own(0, path_.start[v]));
    const Vector3 across = view.own(0, path_.facing[v]) - view.own(0, Vector3::Zero());
    const bool lies = std::abs(across.dot(start.normal)) >= least_lying;
    return start.distance > 0 && !lies && flows_beside(v, view, start.normal) ? std::min(start.distance, quarter)
                                                                              : quarter;
  }

  // Whether a triangle that is nearer to a solid than triangles may come is so with corners only that lie on another
  // one and stand beside this one: what piles up there gets thicker than it is far off, and would be put off by that.
  [[nodiscard]] bool stands_beside(std::uint32_t t, std::uint32_t solid) const {
    const SolidView& view = views_[solid];
    bool any = false;
    for (const std::uint32_t v : path_.triangles[t]) {
      const Vector3 start = view.own(0, path_.start[v]);
      const double within = clearance_part * path_.half_thickness(v);
      if (view.shape().distance(start, within) >= within)
        continue;
      if (rides_[v] == static_cast<std::int32_t>(solid) || !flows_beside(v, view, view.shape().nearest(start).normal))
        return false;
      any = true;
    }
    return any;
  }

  // The distance that a vertex on one solid keeps from another one: that at which it would touch it, unless it starts
  // nearer. Beside upright ones, which bear nothing, it may be as near as it starts: put farther off as the layer
  // grows thicker, its rim would make that thicker still.
  [[nodiscard]] double beside_distance(std::uint32_t v, const SolidView& other) const {
    const double half = path_.half_thickness(v);
    const Vector3 start = other.own(0, path_.start[v]);
    const double before = other.shape().distance(start, half);
    const double least = least_beside * half;
    if (before > -least && before < half / 2 && flows_beside(v, other, other.shape().nearest(start).normal))
      return std::max(before, least);
    return std::clamp(before, half / 2, catching_distance(path_, other, v, start, 2 * half));
  }

  // As near to `end` as the axes allow that a [[hold]] prescribes: along the others back to that distance from the own
  // solid, unless that is nearly along the prescribed ones.
  [[nodiscard]] Vector3 beside_hold(std::uint32_t v, const Vector3& end, double distance) const {
    const SolidView& view = views_[static_cast<std::size_t>(rides_[v])];
    const Vector3 free = free_part(prescribed_[v]);
    Vector3 x = with_fixed(prescribed_[v], path_.end[v], end);
    for (int turn = 0; turn < 10; ++turn) {
      const solid::Near near = view.shape().nearest(view.own(view.pieces(), x));
      const Vector3 along = free.cwiseProduct(view.turned_at_end(near.normal));
      const double error = distance - near.distance;
      if (std::abs(error) <= 1e-9 * path_.thickness[v] || along.squaredNorm() < 0.01)
        break;
      x += error / along.squaredNorm() * along;
    }
    return x;
  }

  // Vertices that start deeper than half the thickness. A change of the mesh on a curved solid may have put one there,
  // by no more than half an edge: it is caught where it is and ends outside. Deeper ones are an error.
  void bring_out(const std::vector<double>& depth) {
    std::vector<std::uint32_t> inside;
    for (std::uint32_t v = 0; v < depth.size(); ++v)
      if (depth[v] < -path_.thickness[v] / 2)
        inside.push_back(v);
    if (inside.empty())
      return;
    for (const std::uint32_t v : inside) {
      const Vector3& x = path_.start[v];
      for (std::size_t i = 0; i < views_.size(); ++i) {
        const double distance = views_[i].shape().nearest(views_[i].own(0, x)).distance;
        if (distance >= -path_.thickness[v] / 2)
          continue;
        if (distance < -edges_[v] / 2)
          fail(ExitCode::bad_input,
               "vertex {} at ({:.6g}, {:.6g}, {:.6g}) starts {:.3g} m inside {}; move the sheet or the solid so that "
               "they start apart; where solids close on the sheet, leave it room",
               v, x.x(), x.y(), x.z(), -distance, solids_.name(i));
        rides_[v] = static_cast<std::int32_t>(i);
        hold(v, views_[i].own(0, x), path_.half_thickness(v));
        ++report_.brought_out;
        break;
      }
    }
  }

  // A point of a triangle, and what an impulse there does: equal and opposite impulses at a point of weights w move the
  // corners by w_i / m_i in proportion.
  struct Lever {
    double half = std::numeric_limits<double>::infinity();     // the thickness
    Vector3 end = Vector3::Zero(), velocity = Vector3::Zero(); // of the point, in the solid's frame; in the world
    std::array<Vector3, 3> share;                              // of the point's way, of each corner, along each axis
    Vector3 compliance = Vector3::Zero();                      // along each axis
    double longest = 0;                                        // of the shares
  };

  [[nodiscard]] Lever lever_of(const FoundHit& hit) const {
    const SolidView& view = views_[hit.solid];
    const Corners& corners = path_.triangles[hit.triangle];
    const double least_mass =
        least_mass_part * std::max({path_.mass[corners[0]], path_.mass[corners[1]], path_.mass[corners[2]]});
    Lever lever;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = corners[c];
      const double weight = hit.point.weights[c];
      lever.half = std::min(lever.half, path_.half_thickness(v));
      lever.end += weight * view.own(view.pieces(), path_.end[v]);
      lever.velocity += weight * path_.velocity[v];
      lever.share[c] = weight / std::max(path_.mass[v], least_mass) * free_part(prescribed_[v]);
      lever.compliance += weight * lever.share[c];
    }
    for (Vector3& s : lever.share) {
      s = (lever.compliance.array() > 0).select(s.cwiseQuotient(lever.compliance), 0.0);
      lever.longest = std::max(lever.longest, s.maxCoeff());
    }
    return lever;
  }

  // What impulses do to a vertex: the sums over them.
  struct Push {
    Vector3 way = Vector3::Zero(), change = Vector3::Zero(); // of its place [m], its velocity [m/s]
    int count = 0;
  };

  // An inelastic impulse without slip: the point that hits first goes on with the solid.
  void push(const FoundHit& hit, std::map<std::uint32_t, Push>& pushes) {
    const SolidView& view = views_[hit.solid];
    const Corners& corners = path_.triangles[hit.triangle];
    const Lever lever = lever_of(hit);
    const bool meets = hit.kind == FoundHit::Kind::meeting;
    // Nearly all of the point is held: left to the other means; all of it, and driven into the solid: to be told.
    if (lever.longest > longest_lever || (lever.compliance.isZero(0) && meets)) {
      for (const std::uint32_t v : corners)
        changed_[v] = 1;
      return;
    }
    const solid::Near& near = hit.point.near;
    if (hit.kind == FoundHit::Kind::across && std::ranges::any_of(corners, [&](std::uint32_t v) { return held(v); }))
      return; // out of what a [[hold]] keeps in nothing comes
    // Out to what it keeps along the normal, without speed, what an impulse of this round at the same place (an edge
    // that two triangles share) has not yet brought it out.
    const double out = std::max(0.0, hit.keeps - near.distance);
    const double already = std::clamp((lever.end - hit.place).dot(near.normal), 0.0, out);
    const bool sticks = solids_.scene(hit.solid).contact == SolidContact::stick;
    Vector3 move = (out - already) * near.normal; // in the solid's frame
    if (meets) {
      const Vector3 back = view.belt(1 - hit.s, near.normal) + hit.place - lever.end + already * near.normal;
      move += sticks ? back : Vector3(near.normal.dot(back) * near.normal);
    }
    move = view.turned_at_end(move);
    const Vector3 normal = view.turned_at_end(near.normal);
    const auto outward = [&](const Vector3& x) { return Vector3(std::max(0.0, x.dot(normal)) * normal); };
    // To the surface's velocity at once: the part of the step after the hit would leave the other part of the speed.
    Vector3 change =
        solids_.surface_velocity(hit.solid, view.world_at_end(lever.end), normal, path_.end_time) - lever.velocity;
    if (!meets || !sticks)
      change = outward(change);
    for (std::size_t c = 0; c < 3; ++c) {
      if (lever.share[c].isZero(0))
        continue;
      const std::uint32_t v = corners[c];
      // A vertex that touches does not slide.
      const bool free = rides_[v] == no_solid;
      Push& sum = pushes[v];
      sum.way += lever.share[c].cwiseProduct(free ? move : outward(move));
      sum.change += lever.share[c].cwiseProduct(free ? change : outward(change));
      ++sum.count;
      changed_[v] = 1;
    }
  }

  void carry(const FoundHit& hit) {
    if (hit.kind == FoundHit::Kind::across) {
      leave_unresolved(hit);
      return;
    }
    bool any = false; // moved in this round, by this hit or another
    for (const std::uint32_t v : path_.triangles[hit.triangle]) {
      if (!held(v) && carried_[v] == 0) {
        rides_[v] = static_cast<std::int32_t>(hit.solid);
        path_.end[v] = with_fixed(prescribed_[v], path_.end[v], views_[hit.solid].carried(path_.start[v]));
        path_.velocity[v] =
            with_fixed(prescribed_[v], path_.velocity[v],
                       scene::velocity_at(solids_.scene(hit.solid).motion, path_.end_time, path_.end[v]));
        carried_[v] = changed_[v] = 1;
        ++report_.carried;
      }
      any = any || changed_[v] != 0;
    }
    if (!any)
      leave_unresolved(hit);
  }

  void leave_unresolved(const FoundHit& hit) {
    ++report_.unresolved;
    report_.unresolved_at = path_.end[path_.triangles[hit.triangle][0]];
  }

  // What the sheet itself may not move along a wall with this normal: rims that meet on a wall push each other along
  // it. Where it stands aslant to the axes, all.
  static Axes axes_across(const Vector3& normal) {
    constexpr double aligned = 1 - 1e-6;
    for (int a = 0; a < 3; ++a)
      if (std::abs(normal[a]) > aligned)
        return axis_bit(a);
    return all_axes;
  }

  void count_across(const std::vector<FoundHit>& hits) {
    if (counted_across_)
      return;
    counted_across_ = true;
    for (const FoundHit& hit : hits)
      report_.started_across += hit.kind == FoundHit::Kind::across ? 1 : 0;
  }

  // Triangles with a corner that has changed must be looked at again.
  void activate() {
    active_.clear();
    for (std::uint32_t t = 0; t < path_.triangles.size(); ++t) {
      const auto& [a, b, c] = path_.triangles[t];
      if (changed_[a] != 0 || changed_[b] != 0 || changed_[c] != 0)
        active_.push_back(t);
    }
    std::ranges::fill(changed_, std::uint8_t{0});
  }

  void finish() {
    path_.overshoot.assign(rides_.size(), Vector3::Zero());
    for (std::size_t v = 0; v < rides_.size(); ++v) {
      if (held(v) || rides_[v] == no_solid)
        continue;
      path_.fixed[v] = all_axes;
      if (carried_[v] != 0 && path_.touch[v] != rides_[v])
        continue; // for this step only
      const auto solid = static_cast<std::size_t>(rides_[v]);
      path_.touch[v] = rides_[v];
      if (caught_[v] != 0 && !slides(static_cast<std::uint32_t>(v)))
        path_.overshoot[v] = free_end_[v] - path_.end[v];
      const auto& [distance, normal, at_surface] = solids_.at(solid, path_.end[v], path_.end_time);
      Vector3 velocity = at_surface;
      if (slides(static_cast<std::uint32_t>(v))) {
        if (carried_[v] == 0)
          path_.fixed[v] = axes_across(normal) | prescribed_[v];
        velocity = turns_[v] != no_solid
                       ? path_.velocity[v]
                       : Vector3(path_.velocity[v] + normal.dot(velocity - path_.velocity[v]) * normal);
      }
      path_.velocity[v] = with_fixed(prescribed_[v], path_.velocity[v], velocity);
      ++report_.touching;
      count_between(static_cast<std::uint32_t>(v));
    }
  }

  // A vertex in a gap between two solids that is less than half as wide as the sheet is thick there: what is squeezed
  // has not got away.
  void count_between(std::uint32_t v) {
    const auto touched = static_cast<std::size_t>(rides_[v]);
    const double thickness = path_.thickness[v];
    const auto other = solids_.facing(touched, path_.end[v], path_.end_time, narrow * thickness);
    if (!other)
      return;
    if (report_.between == 0 || other->gap < report_.narrowest.gap)
      report_.narrowest = {path_.end[v], std::min(other->solid, touched), std::max(other->solid, touched), other->gap,
                           thickness};
    ++report_.between;
  }

  StepPath& path_;
  const solid::Solids& solids_;
  const std::vector<Axes> prescribed_;  // by [[hold]]s
  const std::vector<Vector3> free_end_; // without solids
  std::vector<SolidView> views_;
  std::vector<std::int32_t> rides_;                      // the solid that each vertex moves with, or none
  std::vector<std::uint8_t> changed_, carried_, caught_; // per vertex; bits would not be safe to write in parallel
  std::vector<std::int32_t> turns_;                      // per vertex: the solid in whose corner it turns, or none
  std::vector<std::uint8_t> passes_;                     // per vertex: beside one that touches another solid
  std::vector<std::uint8_t> between_;                    // per vertex: squeezed between two solids at the start
  std::vector<double> edges_;                            // the longest at each vertex [m]
  std::vector<std::uint32_t> active_;                    // triangles to be looked at
  SolidReport report_;
  bool counted_across_ = false;
};

} // namespace

SolidReport& SolidReport::operator+=(const SolidReport& later) {
  touching = std::max(touching, later.touching);
  caught += later.caught;
  pushed += later.pushed;
  carried += later.carried;
  started_across = std::max(started_across, later.started_across);
  brought_out += later.brought_out;
  between += later.between;
  if (later.between > 0)
    narrowest = later.narrowest;
  unresolved += later.unresolved;
  if (later.unresolved > 0)
    unresolved_at = later.unresolved_at;
  return *this;
}

SolidReport resolve_solids(StepPath& path, const solid::Solids& solids) {
  if (solids.empty() || path.triangles.empty())
    return {};
  return Resolution(path, solids).run();
}

std::vector<std::uint32_t> unsafe_triangles(const StepPath& path, const solid::Solids& solids) {
  if (solids.empty() || path.triangles.empty())
    return {};
  const std::vector<SolidView> views = views_of(solids, path);
  // What touches rides, and what ends where a solid has taken it.
  std::vector<std::int32_t> rides;
  for (std::size_t v = 0; v < path.start.size(); ++v) {
    rides.push_back(path.touch[v]);
    for (std::size_t i = 0; i < views.size() && rides[v] == no_solid; ++i)
      if ((views[i].carried(path.start[v]) - path.end[v]).norm() < 1e-9 * path.thickness[v])
        rides[v] = static_cast<std::int32_t>(i);
  }
  std::vector<std::uint32_t> all(path.triangles.size()), result;
  std::iota(all.begin(), all.end(), 0U);
  // A little less than what resolve_solids keeps, so that round-off raises no alarm.
  for (const FoundHit& hit : find_hits(path, views, rides, all, {0.8 * clearance_part, 0.1 * clearance_part, {}}))
    result.push_back(hit.triangle);
  return result;
}

} // namespace sheet::collide
