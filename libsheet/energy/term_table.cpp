// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/term_table.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/energy/area_loads.h"
#include "libsheet/energy/bath.h"
#include "libsheet/energy/bath_drag.h"
#include "libsheet/energy/bath_thrust.h"
#include "libsheet/energy/channel_pressure.h"
#include "libsheet/energy/contact_damping.h"
#include "libsheet/energy/contact_shear.h"
#include "libsheet/energy/form_drag.h"
#include "libsheet/energy/gravity.h"
#include "libsheet/energy/hinge.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/rim_tension.h"
#include "libsheet/energy/slope_tension.h"
#include "libsheet/energy/wall_drag.h"
#include "libsheet/energy/wall_weight.h"

namespace sheet {

class TermMaker {
public:
  TermMaker(const Model& model, const Connectivity& mesh) : mesh_(mesh), arcs_(model.has_angles() && model.arcs) {}

  [[nodiscard]] const Connectivity& mesh() const { return mesh_; }
  [[nodiscard]] bool arcs() const { return arcs_; }
  // Of the model's contacts, which outlive the terms.
  const std::shared_ptr<SpringRests>& spring_rests(const Model& model) {
    if (!spring_rests_)
      spring_rests_ = std::make_shared<SpringRests>(model.contacts, model.contacts_flow, mesh_);
    return spring_rests_;
  }
  template <class Element> void add(Element element) { terms_.push_back(make_term(std::move(element))); }
  // What works on area: the shell's, where it has arcs.
  template <class Load> void add_load(std::optional<Load> AreaLoads::*place, Load load) {
    if (arcs_)
      (loads_.*place) = std::move(load);
    else
      add(std::move(load));
  }

  [[nodiscard]] Terms made() && {
    if (arcs_)
      terms_.insert(terms_.begin(), make_term(MidEdgeShell(std::move(loads_))));
    return std::move(terms_);
  }

private:
  const Connectivity& mesh_;
  bool arcs_;
  std::shared_ptr<SpringRests> spring_rests_;
  AreaLoads loads_;
  Terms terms_;
};

namespace {

bool spreads(const Model& m) { return m.bath && m.bath->spreads; }
bool has_bath(const Model& m) { return m.bath && m.gravity.squaredNorm() > 0; }
bool has_faces(const Model& m) { return m.faces && m.greatest_tension() > 0; }
bool layers_flow(const Model& m) { return !m.contacts.empty() && m.contacts_flow; }

std::string no_contact(const Model&) { return "no [contact], or self = false: the sheet may pass through itself"; }
std::string no_layers(const Model& m) {
  return m.contacts.empty() ? no_contact(m) : "layers do not flow along each other";
}
std::string no_faces(const Model& m) {
  return m.greatest_tension() > 0 ? "tension pulls on the middle surface alone (faces = true in [model])"
                                  : "no surface_tension in [material]";
}
std::string inviscid(const Model&) { return "viscosity is 0"; }

void make_membrane(const Model&, TermMaker& maker) {
  if (!maker.arcs())
    maker.add(Membrane());
}

void make_bending(const Model& m, TermMaker& maker) {
  if (m.bending != Bending::mid_edge)
    maker.add(Hinge(m.bending == Bending::hinge_paper, maker.mesh()));
  else if (!maker.arcs())
    maker.add(MidEdgeShell(false));
}

constexpr std::array table = {
    TermEntry{"membrane", [](const Model& m) { return m.liquid.viscous(); },
              [](const Model&) -> std::string { return "viscosity resists stretching"; }, inviscid, make_membrane},
    TermEntry{
        "bending", [](const Model& m) { return m.liquid.viscous() && m.bending != Bending::none; },
        [](const Model&) -> std::string { return "viscosity resists bending (bending = false leaves a membrane)"; },
        [](const Model& m) { return m.liquid.viscous() ? "[model] bending = false" : inviscid(m); }, make_bending},
    TermEntry{
        "surface tension", [](const Model& m) { return m.greatest_tension() > 0; },
        [](const Model& m) { return fmt::format("{:.3g} N/m on each of the two surfaces", m.greatest_tension()); },
        [](const Model&) -> std::string { return "no surface_tension in [material]"; },
        [](const Model& m, TermMaker& maker) { maker.add_load(&AreaLoads::tension, SurfaceTension(m.inner_faces)); }},
    TermEntry{"rim tension", has_faces, [](const Model&) -> std::string { return "rims are round"; }, no_faces,
              [](const Model& m, TermMaker& maker) {
                if (std::ranges::any_of(m.faces->rims, [](double part) { return part > 0; }))
                  maker.add(RimTension(m.faces->rims, maker.mesh()));
              }},
    TermEntry{"slope tension", has_faces,
              [](const Model&) -> std::string { return "faces level where the thickness is uneven"; }, no_faces,
              [](const Model& m, TermMaker& maker) {
                if (!m.faces->slopes.empty())
                  maker.add(SlopeTension(m.faces->slopes));
              }},
    TermEntry{"inertia", [](const Model& m) { return m.has_inertia(); },
              [](const Model&) -> std::string { return "mass resists acceleration (inertia = false: creeping flow)"; },
              [](const Model&) -> std::string { return "[model] inertia = false"; },
              [](const Model&, TermMaker& maker) { maker.add(Inertia()); }},
    TermEntry{"gravity", [](const Model& m) { return m.has_weight(); },
              [](const Model& m) { return fmt::format("{:.3g} m/s²", m.gravity.norm()); },
              [](const Model&) -> std::string { return "no gravity in [environment]"; },
              [](const Model& m, TermMaker& maker) { maker.add(Gravity(m.gravity)); }},
    TermEntry{"drag of walls",
              [](const Model& m) {
                return m.liquid.viscous() &&
                       std::ranges::any_of(m.walls, [](const Wall& w) { return w.slip_length != free_slip; });
              },
              [](const Model&) -> std::string { return "solids drag what flows along them"; },
              [](const Model& m) { return m.liquid.viscous() ? "liquid flows along no [[solid]]" : inviscid(m); },
              [](const Model&, TermMaker& maker) { maker.add(WallDrag()); }},
    TermEntry{"gap pressure",
              [](const Model& m) { return m.liquid.viscous() && (m.may_squeeze || m.walls.size() > 1); },
              [](const Model&) -> std::string { return "what two solids close on flows out from between them"; },
              [](const Model& m) {
                return m.liquid.viscous() ? "no two [[solid]]s of which one moves or lets liquid flow" : inviscid(m);
              },
              [](const Model&, TermMaker& maker) { maker.add(ChannelPressure()); }},
    TermEntry{"weight on walls", [](const Model& m) { return !m.walls.empty() && m.has_weight(); },
              [](const Model&) -> std::string { return "thick parts of a layer flow to thin ones by their weight"; },
              [](const Model& m) -> std::string {
                return m.has_weight() ? "liquid flows along no [[solid]]" : "no gravity in [environment]";
              },
              [](const Model& m, TermMaker& maker) { maker.add_load(&AreaLoads::weight, WallWeight(m.gravity)); }},
    TermEntry{"pressure", [](const Model& m) { return !m.pressures.empty(); },
              [](const Model&) -> std::string { return "the two sides differ in it"; },
              [](const Model&) -> std::string { return "no pressure in [environment]"; },
              [](const Model& m, TermMaker& maker) {
                for (const PressureLaw& law : m.pressures)
                  maker.add(Pressure(law));
              }},
    TermEntry{"bath", has_bath,
              [](const Model& m) {
                const BathLiquid& bath = *m.bath;
                return fmt::format("liquid of {:.3g} kg/m³ below level {:.3g} m, which {}{}", bath.density, bath.level,
                                   bath.clings ? "clings to the sheet" : "carries what is under its surface",
                                   bath.spreads ? ", and on which it spreads" : "");
              },
              [](const Model&) -> std::string { return "no bath in [environment]"; },
              [](const Model& m, TermMaker& maker) {
                maker.add(Bath(m.bath->density, m.gravity, m.bath->level, m.bath->clings, m.bath_reach));
              }},
    TermEntry{"bath thrust", [](const Model& m) { return spreads(m) && m.has_weight(); },
              [](const Model&) -> std::string { return "what floats spreads by its own weight"; },
              [](const Model& m) -> std::string {
                return m.bath ? "no spreads = true in the bath" : "no bath in [environment]";
              },
              [](const Model& m, TermMaker& maker) { maker.add(BathThrust(m.gravity, m.bath->level, m.bath_reach)); }},
    TermEntry{"drag of a bath", [](const Model& m) { return has_bath(m) && m.bath->drag > 0; },
              [](const Model& m) { return fmt::format("{:.3g} Pa s/m on what slides", m.bath->drag); },
              [](const Model& m) -> std::string { return m.bath ? "no drag in the bath" : "no bath in [environment]"; },
              [](const Model& m, TermMaker& maker) {
                maker.add(BathDrag(m.bath->drag, m.gravity, m.bath->level, m.bath_reach));
              }},
    TermEntry{"bath resistance", [](const Model& m) { return m.bath_flow.has_value(); },
              [](const Model&) -> std::string { return "it holds back what moves in it"; },
              [](const Model& m) -> std::string { return m.bath ? "the bath clings" : "no bath in [environment]"; },
              [](const Model& m, TermMaker& maker) { maker.add(FormDrag(*m.bath_flow)); }},
    TermEntry{
        "drag of air", [](const Model& m) { return m.air.has_value(); },
        [](const Model& m) { return fmt::format("air of {:.3g} kg/m³ holds back what moves in it", m.air->density); },
        [](const Model&) -> std::string { return "no air in [environment]"; },
        [](const Model& m, TermMaker& maker) { maker.add(FormDrag(*m.air)); }},
    TermEntry{"contact", [](const Model& m) { return !m.contacts.empty(); },
              [](const Model&) -> std::string { return "the sheet cannot pass through itself"; }, no_contact,
              [](const Model& m, TermMaker& maker) { maker.add(Contact(maker.spring_rests(m), m.contacts_adhere)); }},
    TermEntry{"contact damping", [](const Model& m) { return !m.contacts.empty(); },
              [](const Model&) -> std::string { return "what comes to touch does not bounce"; }, no_contact,
              [](const Model& m, TermMaker& maker) {
                maker.add(ContactDamping(maker.spring_rests(m), m.has_inertia(), m.contacts_adhere));
              }},
    TermEntry{"squeezed layers", layers_flow,
              [](const Model&) -> std::string { return "what lies on a layer presses it flat"; }, no_layers,
              [](const Model& m, TermMaker& maker) {
                std::optional<BathSurface> bath;
                if (spreads(m) && m.has_weight())
                  bath.emplace(m.gravity, m.bath->level, m.bath_reach);
                maker.add_load(&AreaLoads::squeeze, ContactSqueeze(maker.spring_rests(m), std::move(bath)));
              }},
    TermEntry{"shear of layers", [](const Model& m) { return layers_flow(m) && m.liquid.viscous(); },
              [](const Model&) -> std::string { return "layers drag each other"; },
              [](const Model& m) { return m.liquid.viscous() ? no_layers(m) : inviscid(m); },
              [](const Model& m, TermMaker& maker) { maker.add(ContactShear(maker.spring_rests(m))); }}};

} // namespace

std::span<const TermEntry> term_table() { return table; }

Terms make_terms(const Model& model, const std::shared_ptr<const Connectivity>& mesh) {
  TermMaker maker(model, *mesh);
  for (const TermEntry& entry : table)
    if (entry.asked(model))
      entry.make(model, maker);
  Terms terms = std::move(maker).made();
  if (terms.empty())
    fail(ExitCode::bad_input, "the model has no term: neither viscosity nor inertia nor any force");
  return terms;
}

} // namespace sheet
