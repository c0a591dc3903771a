// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/model.h"

#include "libsheet/energy/gravity.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/surface_tension.h"

namespace sheet {

Terms make_terms(const Model& model, const std::shared_ptr<const Connectivity>& mesh) {
  (void)mesh;
  Terms terms;
  if (model.viscosity > 0)
    terms.push_back(make_term(Membrane(model.viscosity)));
  if (model.surface_tension > 0)
    terms.push_back(make_term(SurfaceTension(model.surface_tension)));
  if (model.has_inertia())
    terms.push_back(make_term(Inertia(model.density, model.mass)));
  if (model.density > 0 && model.gravity.squaredNorm() > 0)
    terms.push_back(make_term(Gravity(model.density, model.gravity)));
  if (model.pressure)
    terms.push_back(make_term(Pressure(*model.pressure)));
  return terms;
}

} // namespace sheet
