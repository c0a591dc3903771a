// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/geometry/area.h"

namespace sheet::render {

void Extent::add(const Vector3& center, double radius) {
  box.add(center - Vector3::Constant(radius));
  box.add(center + Vector3::Constant(radius));
  for (ViewFit& view : views)
    view.add(center, radius);
}

void Extent::add(const Extent& other) {
  box.add(other.box);
  for (std::size_t i = 0; i < views.size(); ++i)
    views[i].add(other.views[i]);
}

static double area_of(const formats::Frame& frame) {
  const auto x = positions(frame);
  double area = 0;
  for (const Corners& c : sheet::triangles(frame))
    area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  return area;
}

void Survey::add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look) {
  const Vector3 upwards = up_of(scene);
  double lowest = std::numeric_limits<double>::infinity(); // of the solids [m]
  Box solids;
  for (const SolidMesh& mesh : meshes) {
    const Eigen::Isometry3d motion = motion_of(scene->solids[mesh.solid], frame.time);
    for (const Vector3& p : mesh.positions) {
      solids_.add(motion * p, 0);
      solids.add(motion * p);
      lowest = std::min(lowest, upwards.dot(motion * p));
    }
  }
  const double lost = !meshes.empty() && scene::is_bottomless(*scene)
                          ? lowest - solids.diagonal() - std::sqrt(area_of(frame))
                          : -std::numeric_limits<double>::infinity();
  const auto x = positions(frame);
  const std::vector<double> thickness = vertex_thickness(frame);
  std::vector<bool> used(x.size(), false);
  for (const Corners& t : sheet::triangles(frame))
    for (const std::uint32_t v : t)
      used[v] = true;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (used[v] && upwards.dot(x[v]) > lost)
      sheet_.add(x[v], thickness[v] / 2);
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
