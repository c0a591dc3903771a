// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/framing.h"

#include <algorithm>

namespace sheet::render {

void Extent::add(const Vector3& center, double radius) {
  box.add(center - Vector3::Constant(radius));
  box.add(center + Vector3::Constant(radius));
  view.add(center, radius);
}

void Extent::add(const Extent& other) {
  box.add(other.box);
  view.add(other.view);
}

void Survey::add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look) {
  const auto x = positions(frame);
  const std::vector<double> thickness = vertex_thickness(frame);
  std::vector<bool> used(x.size(), false);
  for (const Corners& t : sheet::triangles(frame))
    for (const std::uint32_t v : t)
      used[v] = true;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (used[v])
      sheet_.add(x[v], thickness[v] / 2);
  for (const SolidMesh& mesh : meshes) {
    const Eigen::Isometry3d motion = motion_of(scene->solids[mesh.solid], frame.time);
    for (const Vector3& p : mesh.positions)
      solids_.add(motion * p, 0);
  }
  if (look.has_scale())
    scale_.add(values_of(frame, *look.field));
}

Extent Survey::subject() const {
  Extent all = sheet_;
  if (sheet_.box.empty() || solids_.box.diagonal() <= 4 * sheet_.box.diagonal())
    all.add(solids_);
  return all;
}

Vector3 up_of(const Scene* scene) {
  return scene == nullptr ? Vector3(Vector3::UnitY()) : up(scene->environment).value_or(Vector3::UnitY());
}

Plane ground_below(const Box& subject, const Vector3& up) {
  const Vector3 half = 0.5 * (subject.high - subject.low);
  const double reach = half.cwiseProduct(up.cwiseAbs()).sum() + 0.02 * subject.diagonal();
  return {ground_id, subject.middle() - reach * up, up};
}

Plane bath_surface(double level, const Box& subject, const Vector3& up) {
  Plane surface = ground_below(subject, up);
  surface.point += std::min(0.0, level - surface.point.dot(up)) * up;
  return surface;
}

} // namespace sheet::render
