// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/layer_scales.h"

#include <algorithm>
#include <cmath>

namespace sheet::scene {
namespace {

// Part of gravity along the solid where it is steepest; all of it but along planes, which do not turn.
double along(const Solid& solid, const Vector3d& gravity) {
  const auto* plane = std::get_if<HalfSpace>(&solid.shape);
  if (plane == nullptr || turns(solid.motion))
    return gravity.norm();
  const Vector3d normal = plane->normal.normalized();
  return (gravity - normal.dot(gravity) * normal).norm();
}

} // namespace

std::optional<LayerScales> layer_scales_of(const Scene& scene, const Scales& scales) {
  if (!scene.environment.gravity || !scales.length || !scales.thickness)
    return {};
  const double L = *scales.length, h = *scales.thickness, g = scene.environment.gravity->norm();
  const Liquid& m = scene.material;
  LayerScales layer;
  for (const Solid& solid : scene.solids)
    if (solid.contact == SolidContact::flow)
      layer.speed =
          std::max(layer.speed, m.density * h * (h + 3 * solid.slip_length) *
                                    (along(solid, *scene.environment.gravity) + g * h / L) / (3 * m.viscosity));
  if (!(layer.speed > 0) || !std::isfinite(layer.speed))
    return {};
  layer.time = L / layer.speed;
  layer.reynolds = layer.speed * h * h * m.density / (m.viscosity * L);
  layer.capillary_length = std::sqrt(m.surface_tension / (m.density * g));
  return layer;
}

} // namespace sheet::scene
