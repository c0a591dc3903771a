// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/walls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libsheet/base/each.h"
#include "libsheet/energy/channels.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/geometry/facing_walls.h"
#include "libsheet/geometry/longest_edges.h"
#include "libsheet/geometry/rounded_corner.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/heat/surroundings.h"

namespace sheet {

namespace {

constexpr double in_reach = 1 + 1e-3;    // of the distance kept: another wall that is so near holds a vertex as well
constexpr double bluntest_corner = 0.9;  // cosine of the angle between two walls that make one: 26 degrees
constexpr double upright = 0.3;          // cosine of the angle between a wall and one beside it: 17 degrees off upright
constexpr double same_face = 0.95;       // cosine of the angle by which a face turns in a step at most: 18 degrees
constexpr double farthest_in_gap = 0.75; // of the gap between two walls: from its own wall
constexpr double part_of_an_edge = 0.5;  // that a vertex may move along its wall in a step

RigidMotion moved(const Wall& wall, double from, double to) {
  return wall.motion ? wall.motion(from, to) : RigidMotion{};
}

Vector3 velocity_at(const Wall& wall, double t, const Vector3& x) {
  return wall.velocity ? wall.velocity(t, x) : Vector3(Vector3::Zero());
}

// Gives a site the plane n·x = c, unless it has one nearly like it.
void add_plane(WallSite& site, const Vector3& n, double c) {
  Vector3 rest = n;
  for (std::size_t k = 0; k < site.across.size(); ++k) {
    const double along = rest.dot(site.across[k]);
    rest -= along * site.across[k];
    c -= along * site.place[k];
  }
  const double length = rest.norm();
  if (length < least_angle)
    return;
  site.across.emplace_back(rest / length);
  site.place.push_back(c / length);
}

// What is predicted to be at x, where its distance is that of `point`, shall keep `distance`.
void add_plane_of(WallSite& site, const WallPoint& point, const Vector3& x, double distance) {
  add_plane(site, point.normal, point.normal.dot(x) + distance - point.distance);
}

// Whether another wall holds a vertex that shall keep this distance from it: where it would come nearer, and where it
// rests as long as the wall pushes. In a corner a wall that had to pull lets go, so that what has come down one wall
// flows on along the other one.
bool holds(const WallSite& site, const WallPoint& other, double kept) {
  if (other.distance >= in_reach * kept)
    return false;
  return !site.force || other.distance < kept / in_reach || site.force->dot(other.normal) > 0;
}

// The distance from its own wall that a site keeps, at which it starts: in a gap between two walls one that is not too
// far from it. What is, where a gap has just been found, comes there at the rate at which what is too thick gives way
// (channels.h): put there at once it would be thrown, by as much however short the step.
double kept_distance(const Stage& stage, const WallSite& site, double own) {
  const Channel* channel = channel_of(stage, site);
  if (channel == nullptr)
    return own;
  const double nearer = own / (1 + stage.channel_rate * (stage.end_time - stage.start->time));
  return std::min(own, std::max(farthest_in_gap * channel->gap, nearer));
}

// See rounded_corner.h.
std::optional<WallPoint> other_face(const Wall& wall, double t, const Vector3& x, double height) {
  return face_beside([&](const Vector3& place) { return wall.nearest(t, place); }, x, height);
}

// Keeps a vertex from coming nearer to the other face of its wall's corner than it is, or than a layer so thick lies.
void keep_off_face_beside(const Wall& wall, const Stage& stage, double own, double thickness, WallSite& site) {
  const Vector3 &x0 = stage.start->positions[site.vertex], &x = stage.predicted[site.vertex];
  const std::optional<WallPoint> before = other_face(wall, stage.start->time, x0, thickness),
                                 beside = other_face(wall, stage.end_time, x, thickness);
  if (!before || !beside || before->normal.dot(beside->normal) < same_face)
    return;
  const double kept = std::min(std::max(own, thickness / 2), before->distance);
  if (holds(site, *beside, kept))
    add_plane_of(site, *beside, x, kept);
}

// Whether two walls stand still towards each other at a vertex, as the sides of a dish.
bool goes_with(const Wall& one, const Wall& other, const Stage& stage, std::uint32_t vertex) {
  const double t = stage.start->time;
  const Vector3 &x = stage.start->positions[vertex], of_one = velocity_at(one, t, x);
  return (of_one - velocity_at(other, t, x)).norm() <= 1e-9 * of_one.norm();
}

// At a vertex [m].
struct Around {
  double thickness, longest_edge;
};

// The wall that is the solid of this number, or no_index.
std::uint32_t wall_of_solid(const std::vector<Wall>& walls, std::int32_t solid) {
  for (std::uint32_t w = 0; w < walls.size(); ++w)
    if (static_cast<std::int32_t>(walls[w].solid) == solid)
      return w;
  return no_index;
}

// The radius with which corners are rounded at each site, as long as the longest edge there or half the layer's
// thickness, and nearly the same beside it: what is thicker would turn before what is ahead of it [m].
std::vector<double> roundings(const Stage& stage, std::span<const Around> around) {
  constexpr double steepest = 0.3;
  constexpr int most_rounds = 20;
  std::vector<double> radius(around.size(), 0);
  for (const WallSite& site : stage.sites)
    radius[site.vertex] = std::max(around[site.vertex].longest_edge, around[site.vertex].thickness / 2);
  bool raised = true;
  for (int pass = 0; pass < most_rounds && raised; ++pass) {
    raised = false;
    for (const auto& [a, b] : stage.start->mesh->edges) {
      if (radius[a] == 0 || radius[b] == 0)
        continue;
      const double least =
          std::max(radius[a], radius[b]) - steepest * (stage.start->positions[b] - stage.start->positions[a]).norm();
      double& smaller = radius[a] < radius[b] ? radius[a] : radius[b];
      raised = raised || smaller < least;
      smaller = std::max(smaller, least);
    }
  }
  return radius;
}

// The wall in whose corner with its own one a site turns, or the face beside of that, if it has one here.
std::optional<WallPoint> other_side(const std::vector<Wall>& walls, const WallSite& site, double t, const Vector3& x) {
  return site.rounded_with == site.wall ? other_face(walls[site.wall], t, x, 2 * site.rounding)
                                        : walls[site.rounded_with].nearest(t, x);
}

// A velocity whose part across what holds a site is that of the walls there: of its own one, or where it turns in a
// corner that which each of both has across itself, as belts run along them.
Vector3 across_velocity(const std::vector<Wall>& walls, const WallSite& site, double t, const Vector3& x) {
  const Vector3 own = velocity_at(walls[site.wall], t, x);
  if (site.rounded_with == no_index || site.rounded_with == site.wall)
    return own;
  const Wall& other = walls[site.rounded_with];
  const Vector3 n1 = walls[site.wall].nearest(t, x).normal, n2 = other.nearest(t, x).normal;
  const double cosine = n1.dot(n2), v1 = own.dot(n1), v2 = velocity_at(other, t, x).dot(n2);
  if (1 - cosine * cosine < least_angle * least_angle) // beyond an edge of one of them
    return own;
  return ((v1 - cosine * v2) * n1 + (v2 - cosine * v1) * n2) / (1 - cosine * cosine);
}

// Sets in which corners sites turn, and how those are rounded.
void round_corners(const std::vector<Wall>& walls, std::span<const Around> around, Stage& stage) {
  if (std::ranges::all_of(stage.sites, [](const WallSite& site) { return site.rounded_with == no_index; }))
    return;
  const std::vector<double> radius = roundings(stage, around);
  for (WallSite& site : stage.sites)
    if (site.rounded_with != no_index && channel_of(stage, site) != nullptr)
      site.rounded_with = no_index;
    else if (site.rounded_with != no_index) {
      const auto [t, x0] = std::pair(stage.start->time, stage.start->positions[site.vertex]);
      site.rounding = radius[site.vertex];
      const std::optional<WallPoint> other = other_side(walls, site, t, x0);
      if (other)
        site.rounding = rounding_at(walls[site.wall].nearest(t, x0), *other, radius[site.vertex]);
      else
        site.rounded_with = no_index;
    }
}

// Whether another wall that stands on the own one comes towards a vertex there, as a plough does, or turns beside it.
// What leaves a gap below it, as a blade, passes over the layer (channels.h).
bool pushes(const Wall& one, const Wall& other, const Stage& stage, std::uint32_t vertex, const Around& around) {
  const Vector3& x = stage.start->positions[vertex];
  const double t = stage.start->time;
  const auto at = [t](const Wall& of) { return [&of, t](const Vector3& y) { return of.nearest(t, y); }; };
  const WallPoint own = one.nearest(t, x), there = other.nearest(t, x);
  const Vector3 velocity = velocity_at(other, t, x) - velocity_at(one, t, x);
  const double facing = own.normal.dot(there.normal);
  if (facing <= -least_facing || facing > bluntest_corner || velocity.dot(there.normal) < -1e-9 * velocity.norm())
    return false;
  const Vector3 towards = (facing * own.normal - there.normal).normalized();
  return least_height(foot_on(own, x), (there.distance + around.longest_edge) * towards, at(one), at(other)) <
         least_gap * around.thickness;
}

// How another wall may hold the vertex of a site beside its own one. A tool that nothing touches yet may not, unless it
// pushes: what it comes to goes out of its way, or is caught as it meets it.
enum class Beside { not_at_all, as_a_side, as_a_plough };

Beside beside(const std::vector<Wall>& walls, const Stage& stage, const WallSite& site, std::uint32_t other,
              const Around& around) {
  const Channel* channel = channel_of(stage, site);
  if (other == site.wall || (channel != nullptr && other == channel->facing))
    return Beside::not_at_all;
  if (!walls[other].vertices.empty() || goes_with(walls[other], walls[site.wall], stage, site.vertex))
    return Beside::as_a_side;
  return pushes(walls[site.wall], walls[other], stage, site.vertex, around) ? Beside::as_a_plough : Beside::not_at_all;
}

// Keeps a rim where it is on its wall across itself, and in a corner along itself, too.
void keep_rim(const Wall& wall, const Stage& stage, WallSite& site) {
  const auto keep = [&](const Vector3& direction) { add_plane(site, direction, direction.dot(site.stuck)); };
  if (site.in_corner) {
    for (std::size_t k = 1; k < site.across.size(); ++k)
      site.place[k] = site.across[k].dot(site.stuck);
    keep(site.across[0].cross(site.across[1]));
    return;
  }
  const Vector3 out = moved(wall, stage.start->time, stage.end_time).rotation * site.rim;
  const Vector3 along_wall = out - out.dot(site.normal) * site.normal;
  if (along_wall.norm() > least_angle)
    keep(along_wall.normalized());
}

// The wall that a vertex touches, and others that it would come nearer to than it is, or than it is to its own: none
// moves it across, but one that faces its own and would come too near.
void keep_distances(const std::vector<Wall>& walls, const Stage& stage, const Around& around, WallSite& site) {
  const Vector3 &x0 = stage.start->positions[site.vertex], &x = stage.predicted[site.vertex];
  const double own = wall_point(walls, site, stage.start->time, x0).distance;
  const WallPoint point = wall_point(walls, site, stage.end_time, x);
  site.normal = point.normal;
  add_plane_of(site, point, x, kept_distance(stage, site, own));
  if (walls[site.wall].hollow && site.rounded_with != site.wall && channel_of(stage, site) == nullptr)
    keep_off_face_beside(walls[site.wall], stage, own, around.thickness, site);
  for (std::uint32_t w = 0; w < walls.size() && site.across.size() < 3; ++w) {
    if (w == site.wall || w == site.rounded_with ||
        (walls[w].beyond && walls[w].beyond(stage.end_time, x, in_reach * own)))
      continue;
    const WallPoint other = walls[w].nearest(stage.end_time, x);
    if (!(other.distance < in_reach * own))
      continue;
    const Beside holding = beside(walls, stage, site, w, around);
    const double kept = std::min(own, walls[w].nearest(stage.start->time, x0).distance);
    if (holding == Beside::not_at_all || !holds(site, other, kept))
      continue;
    add_plane_of(site, other, x, kept);
    const bool second = site.across.size() == 2;
    if (second) {
      site.second_wall = w;
      site.second_normal = other.normal;
    }
    site.beside_upright =
        second && (holding == Beside::as_a_plough || std::abs(other.normal.dot(point.normal)) < upright);
  }
  site.in_corner = site.across.size() > 1;
  if (!site.rim.isZero(0))
    keep_rim(walls[site.wall], stage, site);
}

// Where the wall takes a vertex that sticks to it from the start of the step on.
Vector3 stuck_to(const Wall& wall, const Stage& stage, std::uint32_t vertex) {
  return moved(wall, stage.start->time, stage.end_time)(stage.start->positions[vertex]);
}

// The same, in a second stage extrapolated from the first in the wall's frame.
Vector3 carried_by(const Wall& wall, const Stage& stage, std::uint32_t vertex) {
  const Vector3 stuck = stuck_to(wall, stage, vertex);
  if (stage.previous == nullptr)
    return stuck;
  const double from = stage.start->time;
  const RigidMotion to_first = moved(wall, from, from + stage.duration);
  const Vector3 slid = stage.position(*stage.previous, vertex) - to_first(stage.start->positions[vertex]);
  return stuck + stage.ratio * (moved(wall, from, stage.end_time).rotation * (to_first.rotation.transpose() * slid));
}

// Around each vertex, at the predicted end.
std::vector<double> predicted_around(const Stage& stage) {
  return thickness_around(stage.vertices(), stage.start->mesh->triangles, stage.start->volumes,
                          [&](std::uint32_t t) { return stage.raised[t].area(); });
}

// The sites that lie between two walls.
void find_channels(const std::vector<Wall>& walls, std::span<const double> thickness, Stage& stage) {
  if (walls.size() < 2)
    return;
  set_channels(
      walls, thickness, [&](const Wall& wall, std::uint32_t v) { return carried_by(wall, stage, v); }, stage);
}

} // namespace

Vector3 free_of(const Vector3& direction, std::span<const char> held, std::uint32_t v) {
  Vector3 free = direction;
  for (int a = 0; a < 3 && !held.empty(); ++a)
    if (held[3 * std::size_t{v} + static_cast<std::size_t>(a)] != 0)
      free[a] = 0;
  return free;
}

WallPoint wall_point(const std::vector<Wall>& walls, const WallSite& site, double t, const Vector3& x) {
  const WallPoint own = walls[site.wall].nearest(t, x);
  const std::optional<WallPoint> other = site.rounded_with == no_index ? std::nullopt : other_side(walls, site, t, x);
  if (!other)
    return own;
  const InCorner corner = in_corner(own, *other, site.rounding);
  return corner.rounded ? WallPoint{corner.distance, corner.normal} : own;
}

double wall_shift(const Stage& stage, std::size_t triangle, const WallSite& site) {
  if (stage.wall_shifts.empty())
    return 1;
  const auto& x = stage.start->positions;
  const auto& [a, b, c] = stage.start->mesh->triangles[triangle];
  const Vector3 upwards = (x[b] - x[a]).cross(x[c] - x[a]);
  return stage.wall_shifts[triangle][upwards.dot(site.normal) > 0 ? heat::lower : heat::upper];
}

namespace {

// Of the angle between a triangle, at the start of the step, and the wall of a site.
double squared_cosine(const Stage& stage, std::size_t triangle, const WallSite& site) {
  const Corners& c = stage.start->mesh->triangles[triangle];
  const auto& x = stage.start->positions;
  const Vector3 normal = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
  const double across = normal.dot(site.normal);
  return across * across / normal.squaredNorm();
}

} // namespace

double lying(const Stage& stage, std::size_t triangle, const WallSite& site) {
  constexpr double least = 1 / (1 + greatest_slope * greatest_slope);
  return std::min(1.0, squared_cosine(stage, triangle, site) / least);
}

namespace {

// Of a triangle that lies on the wall which all of its corners touch, the side that it turns away from it: 1 its
// positive one, -1 the other; else 0.
int side_on_wall(const Stage& stage, std::size_t triangle) {
  const Corners& c = stage.start->mesh->triangles[triangle];
  if (common_wall(stage, c) == no_index)
    return 0;
  const WallSite& site = *site_at(stage, c[0]);
  if (!(squared_cosine(stage, triangle, site) > least_lying_cosine * least_lying_cosine))
    return 0;
  const auto& x = stage.start->positions;
  return (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(site.normal) > 0 ? 1 : -1;
}

// What lies on a wall bends as a sheet that is no thicker than its triangles are long: (l/h)² of its bending, where
// that is below 1. As the directors there follow where the stage is predicted to end, triangles that a tool has crushed
// to a part of their thickness would be driven on by their own prediction, to any speed.
void ease_bending_on_walls(const std::vector<signed char>& sides, Stage& stage) {
  stage.wall_bending.assign(sides.size(), 1);
  bool any = false;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const double thickness = stage.start->volumes[t] / stage.raised[t].area();
    const double part = stage.raised[t].lengths.maxCoeff() / (thickness * thickness); // these are squared
    if (sides[t] == 0 || !(part < 1))
      continue;
    stage.wall_bending[t] = part;
    any = true;
  }
  if (!any)
    stage.wall_bending.clear();
}

// The directors of edges between triangles that lie on walls are not free to turn: they follow the sheet's normals. Not
// so where the sheet is folded back on itself within the wall's plane: there the mean of the normals is about nothing,
// and turns over as the fold passes 180 degrees.
void set_wall_turns(Stage& stage) {
  stage.wall_edges.clear();
  stage.wall_turns.clear();
  stage.wall_bending.clear();
  if (stage.frames.empty())
    return;
  const Connectivity& mesh = *stage.start->mesh;
  std::vector<signed char> sides(mesh.triangles.size());
  each_in_parallel(sides.size(), [&](std::size_t t) { sides[t] = static_cast<signed char>(side_on_wall(stage, t)); });
  ease_bending_on_walls(sides, stage);
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [left, right] = mesh.edge_triangles[e];
    const int one = sides[left == no_index ? right : left], other = sides[right == no_index ? left : right];
    if (one != 0 && one == other)
      stage.wall_edges.push_back(e);
  }
  if (stage.wall_edges.empty())
    return;
  Unknowns u = stage.begin;
  for (std::size_t v = 0; v < stage.vertices(); ++v)
    u.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
  place_on_walls(stage, {}, u);
  turn_with_normals(stage, u);
  for (const std::uint32_t e : stage.wall_edges)
    stage.wall_turns.push_back(u[static_cast<Eigen::Index>(3 * stage.vertices() + e)]);
}

} // namespace

void set_wall_sites(const std::vector<Wall>& walls, Stage& stage) {
  stage.sites.clear();
  stage.site_of.clear();
  stage.channels.clear();
  stage.wall_edges.clear();
  stage.wall_turns.clear();
  stage.wall_bending.clear();
  if (std::ranges::all_of(walls, [](const Wall& w) { return w.vertices.empty(); }))
    return;
  for (StageLiquid& of : stage.liquids)
    if (!of.liquid.law.newtonian() && !of.wall_flow)
      of.wall_flow = wall_flow_of(of.liquid);
  stage.site_of.assign(stage.vertices(), no_index);
  for (std::uint32_t w = 0; w < walls.size(); ++w)
    for (std::size_t i = 0; i < walls[w].vertices.size(); ++i) {
      const std::uint32_t v = walls[w].vertices[i];
      WallSite site;
      site.vertex = v;
      site.wall = w;
      if (!walls[w].forces.empty())
        site.force = walls[w].forces[i];
      if (!walls[w].turned_to.empty())
        site.rounded_with = wall_of_solid(walls, walls[w].turned_to[i]);
      if (!walls[w].rims.empty())
        site.rim = walls[w].rims[i];
      site.slip_length = walls[w].slip_length;
      site.wetting = walls[w].wetting;
      site.stuck = stuck_to(walls[w], stage, v);
      site.carried = carried_by(walls[w], stage, v);
      stage.sites.push_back(std::move(site));
    }
  std::ranges::sort(stage.sites, {}, &WallSite::vertex);
  for (std::uint32_t s = 0; s < stage.sites.size(); ++s)
    stage.site_of[stage.sites[s].vertex] = s;
  const std::vector<double> thickness = predicted_around(stage);
  find_channels(walls, thickness, stage);
  const std::vector<double> edges = longest_edges(stage.start->positions, stage.start->mesh->triangles);
  std::vector<Around> around(stage.vertices());
  for (std::size_t v = 0; v < around.size(); ++v)
    around[v] = {thickness[v], edges[v]};
  round_corners(walls, around, stage);
  for (WallSite& site : stage.sites)
    keep_distances(walls, stage, around[site.vertex], site);
  set_wall_turns(stage);
}

void place_on_walls(const Stage& stage, std::span<const char> held, Unknowns& u) {
  for (const WallSite& site : stage.sites) {
    auto x = u.segment<3>(3 * static_cast<Eigen::Index>(site.vertex));
    for (std::size_t k = 0; k < site.across.size(); ++k) {
      const Vector3 free = free_of(site.across[k], held, site.vertex);
      if (free.squaredNorm() > least_angle * least_angle)
        x += (site.place[k] - site.across[k].dot(x)) / free.squaredNorm() * free;
    }
  }
  for (std::size_t k = 0; k < stage.wall_turns.size(); ++k)
    u[static_cast<Eigen::Index>(3 * stage.vertices() + stage.wall_edges[k])] = stage.wall_turns[k];
}

Constraints constraints_of(const std::vector<Hold>& holds, const Stage& stage) {
  Constraints constraints;
  constraints.held = held_unknowns(holds, stage);
  if (!stage.wall_edges.empty())
    constraints.held.resize(static_cast<std::size_t>(stage.begin.size()), 0);
  for (const std::uint32_t e : stage.wall_edges)
    constraints.held[3 * stage.vertices() + e] = 1;
  turn_slides(stage, constraints);
  return constraints;
}

void turn_slides(const Stage& stage, Constraints& constraints) {
  std::vector<Slide> slides;
  for (const WallSite& site : stage.sites) {
    Slide slide{site.vertex, Matrix3::Identity()};
    for (const Vector3& direction : site.across) {
      const Vector3 free = slide.free * free_of(direction, constraints.held, site.vertex);
      if (free.squaredNorm() > least_angle * least_angle)
        slide.free -= free * free.transpose() / free.squaredNorm();
    }
    if (!slide.free.isIdentity(0))
      slides.push_back(slide);
  }
  constraints.let_slide(std::move(slides), stage.vertices());
}

void set_velocities_on_walls(const std::vector<Wall>& walls, const Stage& stage, double t, State& state) {
  for (const WallSite& site : stage.sites) {
    Vector3& v = state.velocities[site.vertex];
    const Vector3 relative = v - across_velocity(walls, site, t, state.positions[site.vertex]);
    for (const Vector3& direction : site.across)
      v -= relative.dot(direction) * direction;
  }
}

double longest_step_on_walls(const std::vector<Wall>& walls, const State& state) {
  double longest = std::numeric_limits<double>::infinity();
  if (walls.empty())
    return longest;
  const Eigen::VectorXd lengths = step_scale(state, static_cast<Eigen::Index>(3 * state.positions.size()));
  for (const Wall& wall : walls)
    for (const auto v : wall.vertices) {
      const double speed = (state.velocities[v] - velocity_at(wall, state.time, state.positions[v])).norm();
      longest = std::min(longest, part_of_an_edge * lengths[3 * static_cast<Eigen::Index>(v)] / speed);
    }
  return longest;
}

} // namespace sheet
