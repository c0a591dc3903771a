// SPDX-License-Identifier: GPL-3.0-or-later
// The physics of a sheet as plain numbers. What terms follow from it says term_table.h: one exists only if it is asked
// for.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/contact.h"
#include "libsheet/energy/form_drag.h"
#include "libsheet/energy/heat_model.h"
#include "libsheet/energy/holds.h"
#include "libsheet/energy/inertia.h"
#include "libsheet/energy/pressure.h"
#include "libsheet/energy/state.h"
#include "libsheet/energy/walls.h"
#include "libsheet/geometry/faces.h"
#include "libsheet/material/bath_liquid.h"
#include "libsheet/material/liquid.h"

namespace sheet {

// Which forces of holds and walls are wanted: none, those in the implicit solve of a step's last stage, which cost next
// to nothing, or those at the step's end, which take a solve of their own.
enum class Reactions { none, of_stage, at_end };

// What tension sees besides the middle surface.
struct ModelFaces {
  std::vector<double> rims; // of each edge of the mesh the part of it that is a free rim
  std::vector<SlopedEdge> slopes;
};

enum class Bending { none, mid_edge, hinge, hinge_paper };

struct Model {
  Liquid liquid;
  std::vector<Liquid> other_liquids;  // numbers 1 and on of triangles (State::liquids); all viscous or none, all dense
  Vector3 gravity = Vector3::Zero();  // [m/s²]
  std::vector<PressureLaw> pressures; // one an enclosure
  std::optional<BathLiquid> bath;     // needs gravity
  std::vector<BathReach> bath_reach;  // of each vertex; empty: from below
  std::optional<OuterFlow> air;
  std::optional<OuterFlow> bath_flow; // past what moves in the bath
  bool inertia = true;
  std::optional<ModelFaces> faces; // needs tension; chosen for a step
  Bending bending = Bending::none;
  bool arcs = false;             // with mid-edge bending: edges are arcs in the membrane's strain
  std::optional<HeatModel> heat; // of states with temperatures
  std::vector<Hold> holds;       // of two that hold the same unknown, the later one
  std::vector<Wall> walls;       // along which liquid flows
  bool may_squeeze = false;      // several solids, which may leave liquid no room between them
  Reactions reactions = Reactions::none;
  bool external_reactions = false; // those, too, that hold external forces alone
  std::vector<ContactSpring> contacts;
  bool contacts_adhere = false;
  bool contacts_flow = false;           // they let layers flow along each other, and press them flat
  std::vector<double> inner_faces = {}; // of each vertex: how many of its faces, 0 to 2, tension does not see, as they
                                        // lie on other layers; empty: none

  // By their numbers.
  [[nodiscard]] std::vector<Liquid> liquids() const {
    std::vector<Liquid> all{liquid};
    all.insert(all.end(), other_liquids.begin(), other_liquids.end());
    return all;
  }
  [[nodiscard]] const Liquid& liquid_of(std::size_t number) const {
    return number == 0 ? liquid : other_liquids[number - 1];
  }
  [[nodiscard]] double density(const State& state, std::size_t triangle) const { // [kg/m³]
    return other_liquids.empty() ? liquid.density : liquid_of(state.liquids[triangle]).density;
  }
  [[nodiscard]] double greatest_tension() const { // [N/m]
    double greatest = liquid.surface_tension;
    for (const Liquid& other : other_liquids)
      greatest = std::max(greatest, other.surface_tension);
    return greatest;
  }
  [[nodiscard]] bool has_weight() const { return liquid.density > 0 && gravity.squaredNorm() > 0; }
  [[nodiscard]] bool has_inertia() const { return inertia && liquid.density > 0; }
  [[nodiscard]] bool has_angles() const { return bending == Bending::mid_edge && liquid.viscous(); }
};

} // namespace sheet
