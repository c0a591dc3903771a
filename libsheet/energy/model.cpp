// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/model.h"

#include <algorithm>
#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/energy/area_loads.h"
#include "libsheet/energy/bath.h"
#include "libsheet/energy/bath_drag.h"
#include "libsheet/energy/contact_damping.h"
#include "libsheet/energy/contact_shear.h"
#include "libsheet/energy/gravity.h"
#include "libsheet/energy/hinge.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/wall_drag.h"
#include "libsheet/energy/wall_weight.h"

namespace sheet {

namespace {

AreaLoads area_loads_of(const Model& model) {
  AreaLoads loads;
  if (model.liquid.surface_tension > 0)
    loads.tension.emplace();
  const bool spreads = model.bath && model.bath->spreads;
  if ((!model.walls.empty() || spreads) && model.has_weight())
    loads.weight.emplace(model.gravity, spreads ? model.bath->level : no_bath);
  if (!model.contacts.empty() && model.contacts_flow)
    loads.squeeze.emplace(model.contacts);
  return loads;
}

} // namespace

Terms make_terms(const Model& model, const std::shared_ptr<const Connectivity>& mesh) {
  Terms terms;
  AreaLoads loads = area_loads_of(model);
  if (model.liquid.viscous()) {
    const bool arcs = model.has_angles() && model.arcs;
    if (!arcs)
      terms.push_back(make_term(Membrane()));
    if (arcs)
      terms.push_back(make_term(MidEdgeShell(std::exchange(loads, {}))));
    else if (model.has_angles())
      terms.push_back(make_term(MidEdgeShell(false)));
    else if (model.bending != Bending::none)
      terms.push_back(make_term(Hinge(model.bending == Bending::hinge_paper, *mesh)));
  }
  if (loads.tension)
    terms.push_back(make_term(std::move(*loads.tension)));
  if (model.has_inertia())
    terms.push_back(make_term(Inertia()));
  if (model.has_weight())
    terms.push_back(make_term(Gravity(model.gravity)));
  if (model.liquid.viscous() &&
      std::ranges::any_of(model.walls, [](const Wall& w) { return w.slip_length != free_slip; }))
    terms.push_back(make_term(WallDrag()));
  if (loads.weight)
    terms.push_back(make_term(std::move(*loads.weight)));
  for (const PressureLaw& pressure : model.pressures)
    terms.push_back(make_term(Pressure(pressure)));
  if (model.bath && model.gravity.squaredNorm() > 0)
    terms.push_back(make_term(Bath(model.bath->density, model.gravity, model.bath->level, model.bath->clings)));
  if (model.bath && model.bath->drag > 0 && model.gravity.squaredNorm() > 0)
    terms.push_back(make_term(BathDrag(model.bath->drag, model.gravity, model.bath->level)));
  if (!model.contacts.empty()) {
    terms.push_back(make_term(Contact(model.contacts, model.contacts_adhere)));
    terms.push_back(make_term(ContactDamping(model.contacts, model.has_inertia(), model.contacts_adhere)));
  }
  if (loads.squeeze)
    terms.push_back(make_term(std::move(*loads.squeeze)));
  if (!model.contacts.empty() && model.contacts_flow && model.liquid.viscous())
    terms.push_back(make_term(ContactShear(model.contacts)));
  if (terms.empty())
    fail(ExitCode::bad_input, "the model has no term: neither viscosity nor inertia nor any force");
  return terms;
}

} // namespace sheet
