// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid that flows along the solids that it touches, as a thin layer on a wall [Oron, Davis and Bankoff 1997, section
// II]. Its vertices are free along the wall, and keep the distance from it that they have at the start of the step, or
// the wall would do work on what lies above them. What that distance is, half the layer's thickness, is set between
// steps (wall_distance.h). Where vertices may be is a plane, tangent to the wall at the predicted end of each stage, so
// that steps keep their order on curved walls.
//
// The wall acts on a triangle as far as it lies on it: drag and weight go with the square of the cosine of the angle
// between the two, as they do for a layer of the same volume on the triangle's projection onto the wall.
//
// A wall's site is one vertex on it in one stage. Lengths in metres, times in seconds.
#pragma once
#include <functional>
#include <limits>
#include <vector>

#include "libsheet/energy/constraints.h"
#include "libsheet/energy/holds.h"
#include "libsheet/energy/stage.h"

namespace sheet {

inline constexpr double least_angle = 0.1; // sine of, between directions that count as two
inline constexpr double free_slip = std::numeric_limits<double>::infinity();

struct WallPoint {
  double distance = 0; // signed, negative in the solid
  Vector3 normal;      // unit, out of the solid, at the nearest point of its surface
};

// One solid on which liquid flows.
struct Wall {
  std::vector<std::uint32_t> vertices; // those that touch it; none: it only faces another wall (channels.h)
  std::uint32_t solid = 0;             // the number of the scene's solid that it is
  std::vector<Vector3> forces;         // of solids on each of them at the end of the step before [N]; none: not known
  // Of each of them, the number of the solid in whose corner with this one it turns, be it this one's, or -1; none:
  // nothing does.
  std::vector<std::int32_t> turned_to;
  // Of each of them, out of the sheet, if its rim does not retreat, or zero; none: all may.
  std::vector<Vector3> rims;
  double slip_length = 0; // [m], or free_slip
  double wetting = 2;     // 1 - cos θ, θ the contact angle: of the tension γ, what wetted area costs
  std::function<WallPoint(double t, const Vector3& x)> nearest;
  bool hollow = false; // whether it may have corners of its own into which liquid flows, as the mesh of a dish has
  // Whether x is surely farther from it than `reach` [m], which is cheaper to know; absent: no one knows.
  std::function<bool(double t, const Vector3& x, double reach)> beyond;
  // Of what sticks to it, as for holds; absent: it rests.
  std::function<RigidMotion(double from, double to)> motion;
  std::function<Vector3(double t, const Vector3& x)> velocity;
};

// Where x is towards the wall of a site, or the rounding of the corner between that and another one.
[[nodiscard]] WallPoint wall_point(const std::vector<Wall>& walls, const WallSite& site, double t, const Vector3& x);

// Sets the stage's sites, from where it is predicted to end: predicted places, raised metrics, end time.
void set_wall_sites(const std::vector<Wall>& walls, Stage& stage);

// Puts what touches walls where it may be, by the least way; along the axes only that no hold prescribes. Directors on
// walls follow the normals of where the stage is predicted to end: a layer on a wall is not free to bend, and thin ones
// under tension or pressed together would buckle in their directors alone.
void place_on_walls(const Stage& stage, std::span<const char> held, Unknowns& u);

// The part of a direction of a vertex along the axes that are not held.
[[nodiscard]] Vector3 free_of(const Vector3& direction, std::span<const char> held, std::uint32_t v);

// What holds and walls leave free.
[[nodiscard]] Constraints constraints_of(const std::vector<Hold>& holds, const Stage& stage);
// The same with the sites of another stage, as long as the same vertices touch.
void turn_slides(const Stage& stage, Constraints& constraints);

// Takes away the velocities across the walls, relative to them, at the time t [s].
void set_velocities_on_walls(const std::vector<Wall>& walls, const Stage& stage, double t, State& state);

// The longest time in which nothing moves along its wall by more than half the mean length of its edges, at the
// velocities of the state [s]; infinity without walls.
[[nodiscard]] double longest_step_on_walls(const std::vector<Wall>& walls, const State& state);

// The part of the vertices' areas, a third of the triangle's each, that touches walls: per corner of a triangle its
// site or null.
[[nodiscard]] inline const WallSite* site_at(const Stage& stage, std::uint32_t vertex) {
  return stage.site_of.empty() || stage.site_of[vertex] == no_index ? nullptr : &stage.sites[stage.site_of[vertex]];
}

// The wall that all corners touch, or no_index.
[[nodiscard]] inline std::uint32_t common_wall(const Stage& stage, const Corners& corners) {
  const WallSite *one = site_at(stage, corners[0]), *two = site_at(stage, corners[1]),
                 *three = site_at(stage, corners[2]);
  const bool common =
      one != nullptr && two != nullptr && three != nullptr && one->wall == two->wall && one->wall == three->wall;
  return common ? one->wall : no_index;
}

// By what the drag of a site's wall on a triangle differs from that of its mean viscosity (Stage::wall_shifts).
[[nodiscard]] double wall_shift(const Stage& stage, std::size_t triangle, const WallSite& site);

// Between a wall and what lies on it: 60 degrees.
inline constexpr double least_lying_cosine = 0.5;

// Of the middle of a layer over its wall: what slopes less lies on it, however its thickness slopes.
inline constexpr double greatest_slope = 0.3;

// The part in which a triangle, at the start of the step, lies on the wall of one of its corners: 1 up to the greatest
// slope of a layer's middle, from there on in proportion to the squared cosine of the angle between them, 0 where it
// stands on the wall edge-on. (With the squared cosine alone the rim of a layer thicker than its edges are long counts
// as standing, dragged on a foot as wide as it is thick, and spreads ever more slowly the shorter edges are.)
[[nodiscard]] double lying(const Stage& stage, std::size_t triangle, const WallSite& site);

} // namespace sheet
