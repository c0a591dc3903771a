// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/self_response.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace sheet::collide {

namespace {

constexpr std::size_t impulse_rounds = 10, sweeps_of_round = 30, group_rounds = 5, hold_rounds = 12, rounds_of_hold = 3;
constexpr std::array<double, 4> parts_of_way = {1, 0.5, 0.25, 0}; // held, pulled back
constexpr double impulse_part = 0.5;                              // of the contact distance, that impulses want
constexpr double least_missed = 0.1;                              // of the contact distance, that is told of
constexpr double longest_throw = 2; // by impulses, times what brings features apart: their ways and their distance

// n·Σ w_i x_i ≥ distance
struct Inequality {
  std::array<std::uint32_t, 4> vertices{};
  std::array<double, 4> weights{};
  Vector3 normal = Vector3::Zero();
  double distance = 0;
  double impulse = 0; // what it has given so far [kg m], not negative
};

class Response {
public:
  Response(StepPath& path, SelfSearch& search, std::span<const double> reach, std::vector<Axes> prescribed,
           MovingSolids solids)
      : path_(path), search_(search), reach_(reach), prescribed_(std::move(prescribed)), solids_(solids),
        islands_(path.start.size()), mobility_(path.start.size()), shortened_(path.start.size(), 0) {
    for (std::size_t v = 0; v < mobility_.size(); ++v)
      mobility_[v] = free_part(path.fixed[v]) / path.mass[v];
  }

  SelfReport run(Means means) {
    std::vector<Hit> hits = search_.hits(path_.start, path_.end, reach_);
    report_.hits = hits.size();
    if (hits.empty())
      return report_;
    watch_.emplace(search_.watch(path_.start, path_.end, reach_));
    const std::vector<Vector3> asked = path_.end, velocity = path_.velocity;
    note(hits);
    if (means == Means::all) {
      hits = take_back_throws(give_impulses(std::move(hits), impulse_rounds), asked);
      hits = hold_some(std::move(hits), asked);
      hits = move_groups(std::move(hits));
    }
    pull_back(std::move(hits));
    count_shortened(asked);
    set_velocities(asked, velocity);
    return report_;
  }

private:
  void note(std::span<const Hit> hits) {
    for (const Hit& hit : hits)
      for (std::size_t i = 1; i < 4; ++i)
        islands_.join(hit.pair.vertices[0], hit.pair.vertices[i]);
  }

  void add_inequality(const Hit& hit) {
    std::array<Vector3, 4> x;
    double contact = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t v = hit.pair.vertices[i];
      x[i] = (1 - hit.time) * path_.start[v] + hit.time * path_.end[v];
      contact = std::min(contact, reach_[v]);
    }
    const ClosestPoints closest = closest_points(hit.pair.features, x);
    const double length = closest.offset.norm();
    if (!(length > 0))
      return; // no direction: left to the other means
    inequalities_.push_back({hit.pair.vertices, closest.weights, closest.offset / length,
                             std::min(hit.distance, impulse_part * contact), 0});
    if (lever(inequalities_.back()) > longest_lever)
      inequalities_.pop_back(); // nearly all of the contact is fixed: left to the other means
    else
      ++report_.by_impulses;
  }

  // How far the vertex that moves farthest moves, over what that changes the distance of the features.
  [[nodiscard]] double lever(const Inequality& q) const {
    double farthest = 0, compliance = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3 way = q.weights[i] * mobility_[q.vertices[i]].cwiseProduct(q.normal);
      farthest = std::max(farthest, way.norm());
      compliance += q.weights[i] * q.normal.dot(way);
    }
    return compliance > 0 ? farthest / compliance : 0;
  }

  void sweep() {
    for (Inequality& q : inequalities_) {
      double gap = -q.distance, compliance = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        gap += q.weights[i] * q.normal.dot(path_.end[q.vertices[i]]);
        compliance += q.weights[i] * q.weights[i] * q.normal.dot(mobility_[q.vertices[i]].cwiseProduct(q.normal));
      }
      if (!(compliance > 0))
        continue; // all fixed
      const double impulse = std::max(0.0, q.impulse - gap / compliance), change = impulse - q.impulse;
      q.impulse = impulse;
      if (change != 0)
        for (std::size_t i = 0; i < 4; ++i)
          path_.end[q.vertices[i]] += change * q.weights[i] * mobility_[q.vertices[i]].cwiseProduct(q.normal);
    }
  }

  std::vector<Hit> give_impulses(std::vector<Hit> hits, std::size_t rounds) {
    for (std::size_t round = 0; round < rounds && !hits.empty(); ++round) {
      for (const Hit& hit : hits)
        add_inequality(hit);
      const std::vector<Vector3> before = path_.end;
      for (std::size_t i = 0; i < sweeps_of_round; ++i)
        sweep();
      hits = remaining(std::move(hits), before);
    }
    return hits;
  }

  // What impulses leave: vertices that have no room between others, of which some are prescribed. They go 1/2, 1/4,
  // then none of their way and are as fixed; impulses take what is beside round them.
  std::vector<Hit> hold_some(std::vector<Hit> hits, const std::vector<Vector3>& asked) {
    const std::vector<std::uint8_t> none(path_.end.size(), 0);
    std::vector<std::uint8_t> level = none;
    std::vector<Vector3> wanted = path_.end;
    for (std::size_t round = 0; round < hold_rounds && !hits.empty(); ++round) {
      const std::vector<std::uint8_t> next = held_more(hits, level);
      if (next == level)
        break;
      const std::vector<Vector3> before = path_.end, without = ends_without_way(before, none);
      for (std::size_t v = 0; v < level.size(); ++v)
        if (next[v] > 0) {
          wanted[v] = level[v] == 0 ? before[v] : wanted[v];
          path_.end[v] = without[v] + parts_of_way[next[v]] * (wanted[v] - without[v]);
          mobility_[v] = Vector3::Zero();
          shortened_[v] = 1;
        }
      level = next;
      std::erase_if(inequalities_, [&](const Inequality& q) { return lever(q) > longest_lever; });
      hits = take_back_throws(give_impulses(remaining(std::move(hits), before), rounds_of_hold), asked);
    }
    return hits;
  }

  // The next level for the vertices of hits that are not at their last: those that flow along a solid, if a hit has
  // any, else those that are not prescribed. Where nothing in an island is prescribed along all axes there is room.
  [[nodiscard]] std::vector<std::uint8_t> held_more(std::span<const Hit> hits,
                                                    const std::vector<std::uint8_t>& level) const {
    constexpr std::uint8_t last = parts_of_way.size() - 1;
    std::vector<std::uint8_t> next = level, between_prescribed(level.size(), 0);
    for (const auto& island : islands_.all())
      if (std::ranges::any_of(island, [&](std::uint32_t v) { return path_.fixed[v] == all_axes; }))
        for (const std::uint32_t v : island)
          between_prescribed[v] = 1;
    for (const Hit& hit : hits) {
      if (between_prescribed[hit.pair.vertices[0]] == 0)
        continue;
      const auto flows = [&](std::uint32_t v) { return path_.touch[v] != no_solid && level[v] < last; };
      const bool some_flow = std::ranges::any_of(hit.pair.vertices, flows);
      for (const std::uint32_t v : hit.pair.vertices)
        if (some_flow ? flows(v) : path_.fixed[v] != all_axes && level[v] < last)
          next[v] = static_cast<std::uint8_t>(level[v] + 1);
    }
    return next;
  }

  // Where many pairs want apart what has no room for it, their impulses drive each other on, without end. What they
  // move farther than any pair of its island can want, and what is in a pair with that, goes on from where it was asked
  // to go.
  std::vector<Hit> take_back_throws(std::vector<Hit> hits, const std::vector<Vector3>& asked) {
    std::vector<double> wanted(asked.size(), 0); // at each vertex [m]
    for (const Inequality& q : inequalities_) {
      double way = 0;
      for (const std::uint32_t v : q.vertices)
        way = std::max(way, (asked[v] - path_.start[v]).norm());
      for (const std::uint32_t v : q.vertices)
        wanted[v] = std::max(wanted[v], way + q.distance);
    }
    std::vector<std::uint8_t> thrown(asked.size(), 0);
    for (const auto& island : islands_.all()) {
      double most = 0;
      for (const std::uint32_t v : island)
        most = std::max(most, wanted[v]);
      for (const std::uint32_t v : island)
        thrown[v] = shortened_[v] == 0 && (path_.end[v] - asked[v]).norm() > longest_throw * most;
    }
    const std::vector<Vector3> before = path_.end;
    for (const Inequality& q : inequalities_)
      if (std::ranges::any_of(q.vertices, [&](std::uint32_t v) { return thrown[v] != 0; }))
        for (const std::uint32_t v : q.vertices)
          path_.end[v] = shortened_[v] == 0 ? asked[v] : path_.end[v];
    return path_.end == before ? std::move(hits) : remaining(std::move(hits), before);
  }

  // Hits of the path as it is now, when `hits` were those of the ends `before`.
  std::vector<Hit> remaining(std::vector<Hit> hits, const std::vector<Vector3>& before) {
    ++report_.rounds;
    std::vector<Hit> now = watch_->hits(path_.end);
    note(now);
    for (const Hit& hit : hits) // not looked at again, because none of its vertices moved
      if (std::all_of(hit.pair.vertices.begin(), hit.pair.vertices.end(),
                      [&](std::uint32_t v) { return path_.end[v] == before[v]; }))
        now.push_back(hit);
    return now;
  }

  std::vector<Hit> move_groups(std::vector<Hit> hits) {
    Sets groups(path_.start.size());
    const std::vector<Vector3> wanted = path_.end;
    std::vector<std::uint8_t> grouped(wanted.size(), 0);
    for (std::size_t round = 0; round < group_rounds && !hits.empty(); ++round) {
      for (const Hit& hit : hits)
        for (std::size_t i = 1; i < 4; ++i)
          groups.join(hit.pair.vertices[0], hit.pair.vertices[i]);
      const std::vector<Vector3> before = path_.end;
      for (const auto& group : groups.all())
        if (const auto motion = motion_of(group, wanted))
          for (const std::uint32_t v : group)
            if (path_.fixed[v] != all_axes) {
              path_.end[v] = with_fixed(path_.fixed[v], wanted[v], (*motion)(path_.start[v]));
              grouped[v] = 1;
            }
      hits = remaining(std::move(hits), before);
    }
    report_.in_groups = static_cast<std::size_t>(std::count(grouped.begin(), grouped.end(), 1));
    return hits;
  }

  std::optional<RigidStep> motion_of(const std::vector<std::uint32_t>& group,
                                     const std::vector<Vector3>& wanted) const {
    std::vector<std::uint32_t> fixed;
    bool partly = false;
    for (const std::uint32_t v : group) {
      if (path_.fixed[v] == all_axes)
        fixed.push_back(v);
      partly = partly || (path_.fixed[v] != 0 && path_.fixed[v] != all_axes);
    }
    if (partly)
      return common_shift(group, path_.fixed, path_.mass, path_.start, wanted);
    return fixed.empty() ? momentum_motion(group, path_.mass, path_.start, wanted)
                         : common_motion(fixed, path_.start, wanted);
  }

  // The solid that an island goes with where it cannot go its own way: the one that vertices of it touch or are kept
  // out of, if there is only one and nothing else is prescribed to any.
  [[nodiscard]] std::int32_t solid_of(const std::vector<std::uint32_t>& island) const {
    std::int32_t solid = no_solid;
    for (const std::uint32_t v : island) {
      const std::int32_t of = solid_beside(v);
      if ((of == no_solid && path_.fixed[v] != 0) || (of != no_solid && solid != no_solid && of != solid))
        return no_solid;
      solid = of != no_solid ? of : solid;
    }
    return solid;
  }

  // Where vertices end that have nothing left of their way: where their island's solid takes that, and all of it as far
  // along the axes along which nothing of it is fixed as `wanted` takes it in the mean of its masses; where they
  // started if round-off is too much for that. As one rigid motion takes a whole island, it keeps apart what is apart.
  [[nodiscard]] std::vector<Vector3> ends_without_way(const std::vector<Vector3>& wanted,
                                                      const std::vector<std::uint8_t>& stays) const {
    std::vector<Vector3> ends(path_.start.begin(), path_.start.end());
    for (const auto& island : islands_.all()) {
      if (std::ranges::any_of(island, [&](std::uint32_t v) { return stays[v] != 0; }))
        continue;
      if (const std::int32_t solid = solids_.motions.empty() ? no_solid : solid_of(island); solid != no_solid)
        for (const std::uint32_t v : island)
          ends[v] = solid_motion(solid).step(path_.start[v]);
      Axes fixed = 0;
      double mass = 0;
      Vector3 moment = Vector3::Zero();
      for (const std::uint32_t v : island) {
        fixed |= path_.fixed[v];
        mass += path_.mass[v];
        moment += path_.mass[v] * (wanted[v] - ends[v]);
      }
      if (fixed != all_axes)
        for (const std::uint32_t v : island)
          ends[v] += free_part(fixed).cwiseProduct(moment) / mass;
    }
    return ends;
  }

  void pull_back(std::vector<Hit> hits) {
    const std::vector<Vector3> wanted = path_.end;
    std::vector<std::uint8_t> level(wanted.size(), 0), driven(wanted.size(), 0), stays(wanted.size(), 0);
    for (std::size_t v = 0; v < driven.size(); ++v) // moved along an axis that is prescribed
      driven[v] = with_fixed(path_.fixed[v], wanted[v], path_.start[v]) != path_.start[v];
    constexpr std::uint8_t last = parts_of_way.size() - 1;
    while (!hits.empty()) {
      const std::vector<Vector3> without = ends_without_way(wanted, stays);
      std::vector<std::uint8_t> next = level;
      for (const Hit& hit : hits) {
        const auto& v = hit.pair.vertices;
        const bool some_free = std::any_of(v.begin(), v.end(), [&](auto i) { return !driven[i] && level[i] < last; });
        for (const std::uint32_t i : v)
          if (level[i] < last && (!some_free || !driven[i]))
            next[i] = static_cast<std::uint8_t>(level[i] + 1);
        if (std::all_of(v.begin(), v.end(), [&](auto i) { return level[i] == last && path_.end[i] == without[i]; }))
          stays[v[0]] = 1; // by round-off they come too near on the way with the solid
      }
      const std::vector<Vector3> before = path_.end;
      for (std::size_t v = 0; v < level.size(); ++v)
        if (next[v] > 0) {
          const double part = parts_of_way[next[v]];
          path_.end[v] = part == 0 ? without[v] : Vector3(without[v] + part * (wanted[v] - without[v]));
        }
      level = std::move(next);
      hits = remaining(std::move(hits), before);
    }
    for (std::size_t v = 0; v < level.size(); ++v)
      shortened_[v] |= static_cast<std::uint8_t>(level[v] > 0);
  }

  void count_shortened(const std::vector<Vector3>& asked) {
    for (std::size_t v = 0; v < shortened_.size(); ++v) {
      if (shortened_[v] == 0)
        continue;
      ++report_.pulled_back;
      const Vector3 prescribed = with_fixed(path_.fixed[v], asked[v], path_.end[v]);
      if ((prescribed - path_.end[v]).norm() > least_missed * reach_[v]) {
        ++report_.held_back;
        report_.held_at = path_.end[v];
      }
    }
  }

  void set_velocities(const std::vector<Vector3>& asked, const std::vector<Vector3>& before) {
    for (std::size_t v = 0; v < asked.size(); ++v)
      if (path_.end[v] != asked[v])
        path_.velocity[v] =
            with_fixed(prescribed_[v], before[v], before[v] + (path_.end[v] - asked[v]) / path_.length());
    std::vector<Vector3> prescribed(before.size());
    for (std::size_t v = 0; v < prescribed.size(); ++v)
      prescribed[v] = with_fixed(prescribed_[v], before[v], Vector3::Zero());
    for (const auto& island : islands_.all()) {
      restore_momentum(island, asked, before);
      take_gained_energy(island, asked, before, prescribed);
    }
  }

  void restore_momentum(const std::vector<std::uint32_t>& island, const std::vector<Vector3>& asked,
                        const std::vector<Vector3>& before) {
    Axes fixed = 0;
    double mass = 0;
    for (const std::uint32_t v : island) {
      fixed |= path_.fixed[v];
      mass += path_.mass[v];
    }
    if (fixed == all_axes)
      return;
    const Vector3& center = asked[island.front()];
    const Momentum was = momentum(island, path_.mass, asked, before, center);
    const Momentum is = momentum(island, path_.mass, path_.end, path_.velocity, center);
    const Momentum lost{was.linear - is.linear, was.angular - is.angular};
    if (fixed == 0)
      add_momentum(island, path_.mass, path_.end, path_.velocity, lost, center);
    else
      for (const std::uint32_t v : island)
        path_.velocity[v] += free_part(fixed).cwiseProduct(lost.linear) / mass;
  }

  [[nodiscard]] const SolidMotion& solid_motion(std::int32_t solid) const {
    return solids_.motions[static_cast<std::size_t>(solid)];
  }

  // The solid that a vertex touches or is kept out of.
  [[nodiscard]] std::int32_t solid_beside(std::uint32_t v) const {
    return path_.touch[v] != no_solid || solids_.kept_out_of.empty() ? path_.touch[v] : solids_.kept_out_of[v];
  }

  // The one moving solid that drives an island, if nothing else does.
  [[nodiscard]] std::int32_t driven_by(const std::vector<std::uint32_t>& island) const {
    std::int32_t solid = no_solid;
    for (const std::uint32_t v : island) {
      const std::int32_t of = solid_beside(v);
      if ((of == no_solid && prescribed_[v] != 0) || (of != no_solid && solid != no_solid && of != solid))
        return no_solid;
      solid = of != no_solid ? of : solid;
    }
    return solid;
  }

  // How what drives an island moves, as one rigid body: the solid that does, with its belt's mean velocity, else the
  // vertices whose velocity is prescribed, where that led them; at rest without any, and along axes along which none
  // is.
  [[nodiscard]] RigidVelocity velocity_of_drive(const std::vector<std::uint32_t>& island,
                                                const std::vector<Vector3>& asked,
                                                const std::vector<Vector3>& prescribed) const {
    std::vector<std::uint32_t> fixed;
    std::ranges::copy_if(island, std::back_inserter(fixed), [&](std::uint32_t v) { return prescribed_[v] != 0; });
    if (const std::int32_t solid = solids_.motions.empty() ? no_solid : driven_by(island); solid != no_solid) {
      RigidVelocity velocity = solid_motion(solid).velocity;
      velocity.shift +=
          mean_along_prescribed(fixed, [&](std::uint32_t v) -> Vector3 { return prescribed[v] - velocity(asked[v]); });
      return velocity;
    }
    if (fixed.empty())
      return {};
    const Vector3& center = asked[fixed.front()];
    return rigid_velocity(fixed, path_.mass, asked, momentum(fixed, path_.mass, asked, prescribed, center), center);
  }

  // Whether anything moves a vertex whose velocity is prescribed: not a solid where all of them stand still. What
  // slides along one that is aslant to the axes is prescribed along all of these, but slides by itself.
  [[nodiscard]] bool is_driven(std::uint32_t v) const {
    return prescribed_[v] != 0 && !(solids_.motions.empty() && path_.touch[v] != no_solid);
  }

  // Along each axis over the vertices whose velocity is prescribed along it; 0 without any.
  template <class Velocity>
  [[nodiscard]] Vector3 mean_along_prescribed(const std::vector<std::uint32_t>& vertices, Velocity&& velocity) const {
    Vector3 sum = Vector3::Zero(), count = Vector3::Zero();
    for (const std::uint32_t v : vertices) {
      sum += with_fixed(prescribed_[v], velocity(v), Vector3::Zero());
      count += with_fixed(prescribed_[v], Vector3::Ones(), Vector3::Zero());
    }
    return sum.cwiseQuotient(count.cwiseMax(1));
  }

  // Contacts take energy: where features are brought apart that were too near, in a short step at a high speed, or
  // moved by much to get round each other, the way is not a velocity. Of all changes in an island that part is kept
  // that gives it no more energy than it had, seen by an observer who moves with what is prescribed in it (impulses of
  // what rests do no work), and than it may have from what is prescribed against him. `prescribed`: the part of
  // `before` along prescribed axes; how something slides along a solid drives nothing.
  void take_gained_energy(const std::vector<std::uint32_t>& island, const std::vector<Vector3>& asked,
                          const std::vector<Vector3>& before, const std::vector<Vector3>& prescribed) {
    const RigidVelocity frame = velocity_of_drive(island, asked, prescribed);
    double mass = 0, along = 0, square = 0, fastest = 0;
    for (const std::uint32_t v : island) {
      const Vector3 change = path_.velocity[v] - before[v], seen = before[v] - frame(path_.end[v]);
      mass += path_.mass[v];
      along += path_.mass[v] * change.dot(seen);
      square += path_.mass[v] * change.squaredNorm() / 2;
      if (is_driven(v))
        fastest =
            std::max(fastest, with_fixed(prescribed_[v], prescribed[v] - frame(asked[v]), Vector3::Zero()).norm());
    }
    const double allowed = mass * fastest * fastest / 2;
    report_.taken -= std::min(along + square, allowed);
    if (along + square <= allowed)
      return;
    const double part = (std::sqrt(along * along + 4 * square * allowed) - along) / (2 * square);
    for (const std::uint32_t v : island)
      path_.velocity[v] = before[v] + part * (path_.velocity[v] - before[v]);
  }

  StepPath& path_;
  SelfSearch& search_;
  std::optional<PairWatch> watch_; // of the path, once there are hits
  std::span<const double> reach_;
  std::vector<Axes> prescribed_; // velocities
  MovingSolids solids_;
  Sets islands_;
  std::vector<Vector3> mobility_;       // inverse mass along each axis [1/kg]
  std::vector<std::uint8_t> shortened_; // vertices that go a part of their way, or none
  std::vector<Inequality> inequalities_;
  SelfReport report_;
};

} // namespace

SelfReport& SelfReport::operator+=(const SelfReport& later) {
  hits += later.hits;
  rounds += later.rounds;
  by_impulses += later.by_impulses;
  in_groups += later.in_groups;
  pulled_back += later.pulled_back;
  held_back += later.held_back;
  if (later.held_back > 0)
    held_at = later.held_at;
  taken += later.taken;
  return *this;
}

SelfReport resolve_self(StepPath& path, SelfSearch& search, std::span<const double> reach,
                        std::optional<std::vector<Axes>> prescribed, MovingSolids solids, Means means) {
  return Response(path, search, reach, std::move(prescribed).value_or(path.fixed), solids).run(means);
}

} // namespace sheet::collide
