// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/solids.h"

#include <fmt/core.h>

#include "libsheet/base/overloaded.h"
#include "libsheet/scene/words.h"
#include "libsheet/solid/mesh.h"
#include "libsheet/solid/shapes.h"

namespace sheet::solid {

Solids::Solids(const Scene& scene) : may_squeeze_(scene::solids_squeeze(scene)) {
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    const scene::Solid& solid = scene.solids[i];
    Entry entry{solid, fmt::format("solid {} ({})", i, scene::words::solid_shapes[solid.shape.index()]), {}, nullptr};
    entry.placed = Eigen::Translation3d(solid.center) * Eigen::Isometry3d(scene::matrix(solid.rotation));
    entry.shape = std::visit(
        Overloaded{[&](const scene::SolidMesh& mesh) {
                     entry.name = fmt::format("solid {} ({})", i, mesh.file);
                     return shared_distance(mesh, entry.name);
                   },
                   [](const auto& exact) -> std::shared_ptr<const SolidDistance> { return make_distance(exact); }},
        solid.shape);
    solids_.push_back(std::move(entry));
  }
}

Eigen::Isometry3d Solids::pose(std::size_t solid, double t) const {
  return scene::motion_between(solids_[solid].scene.motion, 0, t) * solids_[solid].placed;
}

Vector3 Solids::belt_velocity(std::size_t solid, const Vector3& normal) const {
  return along_surface(solids_[solid].scene.surface_velocity, normal);
}

Vector3 Solids::surface_velocity(std::size_t solid, const Vector3& x, const Vector3& normal, double t) const {
  return scene::velocity_at(solids_[solid].scene.motion, t, x) + belt_velocity(solid, normal);
}

SolidPoint Solids::at(std::size_t solid, const Vector3& x, double t) const {
  const Eigen::Isometry3d place = pose(solid, t);
  const Near near = solids_[solid].shape->nearest(place.inverse() * x);
  const Vector3 normal = place.linear() * near.normal;
  return {near.distance, normal, surface_velocity(solid, x, normal, t)};
}

std::optional<Solids::Facing> Solids::facing(std::size_t solid, const Vector3& x, double t, double room,
                                             double longest_edge) const {
  const double reach = room + 2 * longest_edge;
  std::optional<Facing> nearest;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    if (i == solid || !(solids_[i].shape->distance(pose(i, t).inverse() * x, reach) < reach))
      continue;
    const SolidPoint own = at(solid, x, t), other = at(i, x, t);
    double gap = gap_between(own.distance, own.normal, other.distance, other.normal);
    if (longest_edge > 0) {
      const auto of = [&](std::size_t s) { return [this, s, t](const Vector3& y) { return at(s, y, t); }; };
      gap = std::min(gap, gap_beside(x, of(solid), of(i), longest_edge, least_gap * room).gap);
    }
    if (gap < room && (!nearest || gap < nearest->gap))
      nearest = {i, gap};
  }
  return nearest;
}

} // namespace sheet::solid
