// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a step made safe from the sheet itself.
//
// Four means, one after the other, for pairs of features that come too near to each other (hit.h):
// 1. Impulses [Bridson et al. 2002]. Each pair that was found adds an inequality n·Σ w_i x_i ≥ g, with normal n and
//    weights w from the moment of the hit; the ends move as little as possible, measured by their masses, for all
//    inequalities to hold (projected Gauss-Seidel). g is the distance at the start or half the contact distance, the
//    less of them. Vertices that are held or touch a solid have infinite mass, those held along some axes along these.
//    A pair that the one vertex that is free would have to leave by more than 4 times the way wanted, because only a
//    small weight is its own, is left to the other means; so is, with all that is in a pair with it, what they move
//    farther than twice what any pair of its island (vertices joined by hits) can want.
// 2. Holding. What still hits in an island of which something is prescribed along all axes has no room. It goes 1/2,
//    1/4, then none of its way (below), first what flows along a solid, and has infinite mass from then on, and
//    impulses move what is beside. Without this the next two means hold back a whole pile for the sake of a few of its
//    vertices: what lies on a vertex that is pulled back, and comes nearer to it than it may, is pulled back, too.
// 3. Rigid groups [Provot 1997; Bridson et al. 2002]. Vertices of pairs that still hit are joined to groups, which move
//    as rigid bodies with the momentum and angular momentum of their vertices, or with those of their vertices that are
//    fixed, if these move as a rigid body does; where some are fixed along some axes only, as what shifts but does not
//    turn. (A straight path between two places of a rigid body is an affine map that keeps what is apart apart, for
//    turns by less than half a circle.)
// 4. Pull-back. What still hits ends at 1/2, 1/4, then none of its way; free vertices and those at rest first, then,
//    because nothing else is left, those whose motion is prescribed. Where an island touches one solid and nothing else
//    is prescribed to it, this is its way in the solid's frame: without any it goes on with the solid, which else would
//    go through what stays behind. Along axes along which nothing in an island is fixed, as along a level floor on
//    which it flows, it is the way against the island's mean: without any it goes on as one.
//
// It ends: the first three have a number of rounds; each round of the last shortens the way of at least one vertex of
// each hit, three times at most, and four vertices without any way do not hit: one rigid motion takes them all, or
// if round-off is too much for that, they stay where they started.
// It guarantees, because the search for hits never misses one: if no triangles intersect at the start, none does at any
// time of the step, whatever is prescribed to held vertices or by solids. Where what they prescribe cannot be had
// without an intersection, they stay behind; the report counts them. What touches a solid may then be inside of it; the
// next step pushes it out.
//
// Velocities change by the displacement over the step's length, but not along axes along which they are prescribed:
// what a solid carries or brings out and this leaves behind still has the solid's velocity, and springs to it do not
// throw what is free. Then each island (vertices joined by hits) without fixed vertices gets the rigid motion that
// gives its momentum and angular momentum back (of nearly collinear islands the part about their line is left out),
// others the momentum along the axes along which none is fixed.
// Last, an island's changes are made less until they give it no kinetic energy, as seen by an observer who moves with
// what is prescribed in it, along the axes along which it is, as far as that moves as one rigid body: impulses of what
// rests do no work. Where that is one moving solid, which a vertex or two of the island touch or are kept out of, he
// moves and turns with it.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/rigid_group.h"
#include "libsheet/collide/self_search.h"
#include "libsheet/collide/step_path.h"

namespace sheet::collide {

// How a moving solid goes on in the step, and its velocity at the end.
struct SolidMotion {
  RigidStep step;
  RigidVelocity velocity;
};

// Solids that move: the motion of each that path.touch names, none if all stand still; and of each vertex that is fixed
// though it touches none, since it must not come nearer to one, that one (else no_solid; empty: there is none).
struct MovingSolids {
  std::span<const SolidMotion> motions;
  std::span<const std::int32_t> kept_out_of;
};

struct SelfReport {
  std::size_t hits = 0;              // pairs that hit on the way that was asked for
  std::size_t rounds = 0;            // of any of the means
  std::size_t by_impulses = 0;       // inequalities
  std::size_t in_groups = 0;         // vertices that moved in rigid groups
  std::size_t pulled_back = 0;       // vertices, all kinds, and held
  std::size_t held_back = 0;         // those whose motion is prescribed and misses a tenth of the contact distance
  Vector3 held_at = Vector3::Zero(); // the last of those, where held_back > 0
  double taken = 0;                  // of kinetic energy less what was given, seen by the observer above [J]

  SelfReport& operator+=(const SelfReport& later); // all adds up; the place is the later one's
};

enum class Means { all, pull_back }; // the four above, or the last one alone, which brings nothing off its way

// Corrects end and velocity of the path. `reach`: contact distance at each vertex [m]; `prescribed`: axes along which
// each vertex has a prescribed velocity, those of path.fixed if not given.
SelfReport resolve_self(StepPath& path, SelfSearch& search, std::span<const double> reach,
                        std::optional<std::vector<Axes>> prescribed = std::nullopt, MovingSolids solids = {},
                        Means means = Means::all);

} // namespace sheet::collide
