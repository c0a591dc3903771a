// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/framing.h"

#include <algorithm>

namespace sheet::render {

void Survey::add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look) {
  sheet.add(box_of(frame));
  for (const SolidMesh& mesh : meshes)
    solids.add(box_of(mesh, motion_of(scene->solids[mesh.solid], frame.time)));
  if (look != Look::material && look != Look::wireframe)
    scale.add(values_of(frame, look));
}

Box Survey::subject(double growth) const {
  Box box = sheet;
  if (sheet.empty() || solids.diagonal() <= 4 * sheet.diagonal())
    box.add(solids);
  if (!box.empty()) {
    // A point, or a line, has no size to go by.
    const Vector3 margin = Vector3::Constant(std::max(1e-12, 1e-6 * box.diagonal())) + growth * (box.high - box.low);
    box.low -= margin;
    box.high += margin;
  }
  return box;
}

Vector3 up_of(const Scene* scene) {
  return scene == nullptr ? Vector3(Vector3::UnitY()) : up(scene->environment).value_or(Vector3::UnitY());
}

Plane ground_below(const Box& subject, const Vector3& up) {
  const Vector3 half = 0.5 * (subject.high - subject.low);
  const double reach = half.cwiseProduct(up.cwiseAbs()).sum() + 0.02 * subject.diagonal();
  return {ground_id, subject.center() - reach * up, up};
}

} // namespace sheet::render
