// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/layer_scales.h"

#include <algorithm>
#include <cmath>

#include "libsheet/material/wall_flow.h"

namespace sheet::scene {
namespace {

// Part of gravity along the solid where it is steepest, or where it is known to be steepest under the sheet; all of it
// along what turns, and where neither is known.
double along(const Solid& solid, const Vector3d& gravity, std::optional<double> under_sheet) {
  const auto* plane = std::get_if<HalfSpace>(&solid.shape);
  if (turns(solid.motion) || (plane == nullptr && !under_sheet))
    return gravity.norm();
  if (plane == nullptr)
    return *under_sheet;
  const Vector3d normal = plane->normal.normalized();
  return (gravity - normal.dot(gravity) * normal).norm();
}

} // namespace

double speed_of_layer(const Liquid& liquid, double stress, double h, double b) {
  if (liquid.law.newtonian())
    return stress * (h + 3 * b) / (3 * liquid.viscosity);
  return stress > liquid.law.yield_stress ? wall_flow_of(liquid)->velocity(stress, h, b) : 0;
}

double thickness_of_layer(const Liquid& liquid, double along, double flux, double b, double least) {
  constexpr int most_doublings = 40, halvings = 30;
  const auto carries = [&](double h) { return h * speed_of_layer(liquid, liquid.density * h * along, h, b) >= flux; };
  double low = least, high = least;
  for (int i = 0; i < most_doublings && !carries(high); ++i)
    high *= 2;
  for (int i = 0; i < halvings && high > least; ++i) {
    const double middle = (low + high) / 2;
    (carries(middle) ? high : low) = middle;
  }
  return high;
}

std::optional<LayerScales> layer_scales_of(const Scene& scene, const Scales& scales) {
  if (!scene.environment.gravity || !scales.length || !scales.thickness)
    return {};
  const double L = *scales.length, h = *scales.thickness, g = scene.environment.gravity->norm();
  const Liquid& m = scene.material;
  LayerScales layer;
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (const Solid& solid = scene.solids[i]; solid.contact == SolidContact::flow) {
      const double down =
          along(solid, *scene.environment.gravity, i < scales.along.size() ? scales.along[i] : std::nullopt);
      const double stress = m.density * h * (down + g * h / L);
      layer.along = std::max(layer.along, down);
      layer.stress = std::max(layer.stress, stress);
      layer.speed = std::max(layer.speed, speed_of_layer(m, stress, h, solid.slip_length));
    }
  if (!(layer.stress > 0) || !std::isfinite(layer.speed))
    return {};
  layer.viscosity = viscosity_of(m, {layer.speed * layer.speed / (h * h)});
  layer.time = L / layer.speed;
  layer.reynolds = layer.speed * h * h * m.density / (layer.viscosity * L);
  layer.capillary_length = std::sqrt(m.surface_tension / (m.density * g));
  return layer;
}

} // namespace sheet::scene
