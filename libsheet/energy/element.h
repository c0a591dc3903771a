// SPDX-License-Identifier: GPL-3.0-or-later
// What an energy term looks like. A term is a class of elements that all have the same stencil:
//   static constexpr Stencil stencil;                         the nodes of an element, see below
//   const char* name() const;
//   std::size_t size() const;                                 number of elements
//   std::array<std::uint32_t, 4> nodes(i) const;              the vertices; only where the stencil is hinge or four
//   static constexpr Kind kind = Kind::...;                   optional: inertial or elastic; else dissipative or a load
//   bool has(Kind) const;  void hessians_of(Kind, ...) const; optional: of a term of several kinds, see term.h
//   static constexpr bool linear = true;                      optional: the Hessian is zero and need not be added
//   void begin(const Stage&);                                 before each solve, and where the stage has changed: the
//     term keeps what it needs of it, and no reference
//   void prepare(const Unknowns&);                            optional: what is global (an enclosed volume)
//   void follow(const Unknowns&, const Unknowns& step);       optional: see term.h
//   void rest_at(std::span<const double> rates);              optional: see term.h
//   void add_wall_forces(const Unknowns&, span<Vector3>) const;   optional: what walls do along themselves, see term.h
//   void add_gap_forces(const Unknowns&, GapForces&) const;   optional: what two walls do, see term.h
//   void add_dissipated(const Unknowns&, span<double>) const; optional: of each triangle, see term.h
//   void finish(const Unknowns&, State&);                     optional: what a step leaves in the state, see term.h
//   double rank_one(const Unknowns&, VectorXd&) const;        optional: what couples all unknowns, see term.h
//   double value(i, u) const;                                 [J]
//   double derivatives(i, u, gradient, hessian, definite) const;   value, [N] and [N/m]; overwrites both. If definite,
//     the Hessian is a positive semidefinite approximation in closed form, otherwise it is exact
//   double gradient(i, u, gradient) const;                    optional: the same without the Hessian, where that is
//     much cheaper
//   bool idle(i) const;                                       optional: whether the element has no part in this solve
// u holds the unknowns of the element: its vertices' coordinates, then its edges' angles.
#pragma once
#include <array>
#include <cstdint>

#include "libsheet/energy/stage.h"

namespace sheet {

// What a term's Hessian stands for in the equations of motion M x'' + D x' + K x = f.
enum class Kind {
  inertial,    // M
  dissipative, // D, or nothing
  elastic      // K
};

enum class Stencil {
  vertex,         // itself: element i is vertex i
  triangle,       // its three vertices
  triangle_edges, // its three vertices, then its three edges (edge i opposite vertex i)
  hinge,          // four vertices: an interior edge, then the two apices
  four            // any four vertices
};

constexpr int stencil_vertices(Stencil s) {
  return s == Stencil::vertex ? 1 : s == Stencil::hinge || s == Stencil::four ? 4 : 3;
}
constexpr int stencil_edges(Stencil s) { return s == Stencil::triangle_edges ? 3 : 0; }
constexpr int stencil_unknowns(Stencil s) { return 3 * stencil_vertices(s) + stencil_edges(s); }

} // namespace sheet
