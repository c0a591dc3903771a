// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit solve within a time step: everything that an energy term may refer to. A backward-Euler step is one
// stage; SDIRK2 has two, the second of which refers to quantities extrapolated from the first:
//   reference = start + ratio (previous - start), for positions and for the metric and curvature of each triangle.
// The unknowns are one vector: three coordinates [m] a vertex, then, if the sheet bends by directors, one angle [rad]
// an edge.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/energy/state.h"
#include "libsheet/geometry/director.h"
#include "libsheet/geometry/metric.h"
#include "libsheet/material/flow_curve.h"
#include "libsheet/material/wall_flow.h"

namespace sheet {

using Unknowns = Eigen::VectorXd;

// A vertex that touches a solid and may flow along it (walls.h), at the predicted end of the stage.
struct WallSite {
  std::uint32_t vertex = 0, wall = 0;
  std::uint32_t channel = no_index;  // its number, where another wall faces the own one
  Vector3 normal = Vector3::Zero();  // of the wall
  std::optional<Vector3> force;      // of solids on it at the end of the step before, if that is known [N]
  Vector3 stuck = Vector3::Zero();   // where it would be had it stuck to the wall from the start of the step on [m]
  Vector3 carried = Vector3::Zero(); // the same, in a second stage extrapolated from the first: not dragged there [m]
  double slip_length = 0;            // [m]
  double wetting = 2;                // 1 - cos of the contact angle
  std::uint32_t second_wall = no_index; // another one that holds it, of this normal, if there is one
  Vector3 second_normal = Vector3::Zero();
  std::uint32_t rounded_with = no_index; // on which it goes on, or from which it comes, be it a face of its own one:
  double rounding = 0;                   // their corner is rounded with this radius (rounded_corner.h) [m]
  Vector3 rim = Vector3::Zero(); // out of the sheet at the start of the step, if its rim does not retreat, or zero
  bool in_corner = false;        // another wall, or another face of its own one, holds it, too
  bool beside_upright = false;   // another wall that stands upright on its own one, or pushes, holds it; and no third
  std::vector<Vector3>
      across; // orthonormal: the directions in which its place is given, along its own wall's normal first
  std::vector<double> place; // that place along each of them [m]
};

// A site that lies between two walls (channels.h), at the predicted end of the stage.
struct Channel {
  std::uint32_t vertex = 0, facing = 0; // the wall that faces the site's own one
  double gap = 0, gap_before = 0;       // between the two; at the start of the step [m]
  double gap_first = 0;                 // at the end of the first stage, if this is a second one [m]
  double filled = 0;                    // the part in which the layer touches both
  double diameter = 0;                  // hydraulic, of all that lies between walls around it [m]
  double depth = 0;                     // of the drag of both [m]
  double facing_part = 0;               // of that drag that the facing wall bears (channels.h)
  Vector3 place = Vector3::Zero();      // predicted, of the vertex [m]
  Vector3 slope = Vector3::Zero();      // of the gap along the wall
  Vector3 carried = Vector3::Zero();    // as WallSite::carried, by both walls [m]
};

// One of the liquids that the sheet is of.
struct StageLiquid {
  Liquid liquid;
  FlowCurve flow, lagged;                         // of it; for Stage::viscosity
  std::shared_ptr<const WallFlow> wall_flow = {}; // along walls, where anything touches; null: Newtonian, or none
};

struct Stage {
  const State* start = nullptr;
  double duration = 0;                // of the implicit solve: dt, or gamma dt [s]
  double inertial_time = 0;           // in which inertia gives way to force: the duration; longer in an instant [s]
  double left_over = 0;               // of the start's overshoot, at the end of the stage: the part not yet made up for
  double end_time = 0;                // at which time-dependent forces act [s]
  double ratio = 0;                   // 0 in a first stage, (1 - gamma)/gamma in a second
  Unknowns begin;                     // the unknowns at the start of the step
  const Unknowns* previous = nullptr; // the first stage's result, null in a first stage
  std::vector<EdgeFrame> frames;      // of the directors, at the start of the step; empty without directors
  std::vector<char> clamped;          // of each edge: whether its director is held; empty where none is
  std::vector<RaisedMetric> raised;   // for each triangle: the metric that raises indices and weighs by area
  std::vector<StageLiquid> liquids = {{}};   // one or more, by their numbers
  std::vector<std::uint32_t> vertex_liquids; // of each vertex its number; empty: all 0. Layers of two share no vertex.
  std::vector<double> viscosity;             // of each triangle, strained as the stage predicts, lagged [Pa s]
  std::vector<double> temperatures;          // of each triangle, predicted for the end of the stage [K]; or none
  std::vector<double> shift;                 // of each triangle: a_T there (temperature_law.h); empty: 1
  std::vector<double> crusts;                // of each triangle: by what bending is stiffer for cold faces; empty: 1
  std::vector<double> stiffened;             // of each triangle: by how much its viscosity is raised (films.h), or none
  std::vector<double> vertex_volumes;        // of each vertex: a third of the volume of each triangle there [m³]
  std::vector<Vector3> inertial;             // where the vertices would go without force [m]
  std::vector<Vector3> predicted;            // the extrapolated end of the stage, for what is lagged [m]
  std::vector<WallSite> sites;               // of what touches walls, ascending
  std::vector<std::uint32_t> site_of;        // of each vertex, or no_index; empty without sites
  std::vector<Channel> channels;             // of sites between two walls, ascending
  double channel_rate = 0;                   // at which what is too thick there gives way [1/s]
  std::vector<std::uint32_t> wall_edges;     // whose directors stand as the wall lets them, ascending
  std::vector<double> wall_turns;            // of these directors, by the predicted end of the stage [rad]
  std::vector<double> wall_bending;          // of each triangle: the part of its bending that walls leave; empty: all
  // Of each triangle: by what a wall on its upper or its lower face (heat::Face) is dragged less, or more, than by that
  // mean viscosity, as liquid flows where it is warm (stage_setup.h); empty: 1.
  std::vector<std::array<double, 2>> wall_shifts;

  [[nodiscard]] std::size_t vertices() const { return start->positions.size(); }
  [[nodiscard]] const StageLiquid& liquid_of(std::size_t triangle) const {
    return liquids.size() == 1 ? liquids[0] : liquids[start->liquids[triangle]];
  }
  [[nodiscard]] const StageLiquid& liquid_at(std::size_t vertex) const {
    return liquids.size() == 1 ? liquids[0] : liquids[vertex_liquids[vertex]];
  }
  // These are true of all liquids, or of none.
  [[nodiscard]] bool viscous() const { return liquids[0].liquid.viscous(); }
  [[nodiscard]] double stiffening(std::size_t triangle) const { return stiffened.empty() ? 1 : stiffened[triangle]; }
  [[nodiscard]] double shift_of(std::size_t triangle) const { return shift.empty() ? 1 : shift[triangle]; }
  // The one place where flow depends on temperature: as all of a flow curve is shifted, τ(γ̇, T) = τ(a_T γ̇, T_r), what
  // is strained at T in the stage's duration is what is strained at T_r in this time [s] [Morland and Lee 1960].
  [[nodiscard]] double reduced_time(std::size_t triangle) const {
    return shift.empty() ? duration : duration / shift[triangle];
  }
  [[nodiscard]] double crust(std::size_t triangle) const { return crusts.empty() ? 1 : crusts[triangle]; }
  // By what its resistance to bending differs from that of a free sheet.
  [[nodiscard]] double bending(std::size_t triangle) const {
    return wall_bending.empty() ? crust(triangle) : wall_bending[triangle] * crust(triangle);
  }
  [[nodiscard]] double surface_tension(std::size_t triangle) const { // [N/m]
    const Liquid& liquid = liquid_of(triangle).liquid;
    return temperatures.empty() || liquid.surface_tension_slope == 0
               ? liquid.surface_tension
               : liquid.surface_tension_at(temperatures[triangle]);
  }
  [[nodiscard]] bool director_held(std::uint32_t edge) const { return !clamped.empty() && clamped[edge] != 0; }
  [[nodiscard]] static Vector3 position(const Unknowns& u, std::uint32_t v) { return u.segment<3>(3 * v); }
};

// Where strain is measured from: the start of the step, in a second stage extrapolated from the first [m].
[[nodiscard]] inline Vector3 reference_position(const Stage& stage, std::uint32_t v) {
  const Vector3& start = stage.start->positions[v];
  return stage.previous == nullptr ? start
                                   : Vector3(start + stage.ratio * (stage.position(*stage.previous, v) - start));
}

} // namespace sheet
