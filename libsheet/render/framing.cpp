// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/scene/prescribed.h"

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

// The vertices that a [[hold]] keeps from falling now; none if the frame has no holds.
static std::vector<bool> borne_vertices(const formats::Frame& frame, const Scene& scene, const Vector3& up) {
  const auto masks = holds(frame);
  std::uint64_t bearing = 0;
  for (std::size_t i = 0; i < scene.holds.size() && i < 64; ++i) {
    bool bears = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      bears = bears && (std::abs(up[static_cast<Eigen::Index>(axis)]) < 1e-3 || has_axis(scene.holds[i].axes, axis));
    bearing |= std::uint64_t{bears} << i;
  }
  bearing &= scene::holds_in_force(scene, frame.time);
  std::vector<bool> borne(masks.size(), false);
  for (std::size_t v = 0; v < masks.size(); ++v)
    borne[v] = (masks[v] & bearing) != 0;
  return borne;
}

// Those, and all that hangs from them along triangles.
static std::vector<bool> hanging_from(std::vector<bool> borne, const formats::Frame& frame) {
  DisjointSets pieces(borne.size());
  if (!borne.empty())
    for (const Corners& t : sheet::triangles(frame)) {
      pieces.join(t[0], t[1]);
      pieces.join(t[0], t[2]);
    }
  std::vector<bool> hangs(borne.size(), false);
  for (std::size_t v = 0; v < borne.size(); ++v)
    if (borne[v])
      hangs[pieces.find(v)] = true;
  for (std::size_t v = 0; v < borne.size(); ++v)
    borne[v] = hangs[pieces.find(v)];
  return borne;
}

void Survey::add(const formats::Frame& frame, const Scene* scene, const std::vector<SolidMesh>& meshes, Look look) {
  const Vector3 upwards = up_of(scene);
  double lowest = std::numeric_limits<double>::infinity(); // of the solids [m]
  Box bearers;                                             // solids, and what is or was held
  for (const SolidMesh& mesh : meshes) {
    const Eigen::Isometry3d motion = motion_of(scene->solids[mesh.solid], frame.time);
    for (const Vector3& p : mesh.positions) {
      solids_.add(motion * p, 0);
      bearers.add(motion * p);
      lowest = std::min(lowest, upwards.dot(motion * p));
    }
  }
  const auto x = positions(frame);
  std::vector<bool> hangs;
  if (scene != nullptr && scene::is_bottomless(*scene)) {
    const std::vector<bool> borne = borne_vertices(frame, *scene, upwards);
    for (std::size_t v = 0; v < borne.size(); ++v)
      if (borne[v]) {
        held_.add(x[v]);
        lowest_held_ = std::min(lowest_held_, upwards.dot(x[v]));
      }
    hangs = hanging_from(borne, frame);
    bearers.add(held_);
  }
  const double lost = !bearers.empty() && scene::is_bottomless(*scene)
                          ? std::min(lowest, lowest_held_) - bearers.diagonal() - std::sqrt(area_of(frame))
                          : -std::numeric_limits<double>::infinity();
  const std::vector<double> thickness = vertex_thickness(frame);
  std::vector<bool> used(x.size(), false);
  for (const Corners& t : sheet::triangles(frame))
    for (const std::uint32_t v : t)
      used[v] = true;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (used[v] && (upwards.dot(x[v]) > lost || (!hangs.empty() && hangs[v])))
      sheet_.add(x[v], thickness[v] / 2);
  if (look.has_scale())
    scale_.add(values_of(frame, *look.field));
}

Extent Survey::subject() const {
  Extent all = sheet_;
  if (has_solids_in_picture())
    all.add(solids_);
  return all;
}

bool Survey::has_solids_in_picture() const {
  return sheet_.box.empty() || solids_.box.diagonal() <= 4 * sheet_.box.diagonal();
}

Vector3 up_of(const Scene* scene) {
  return scene == nullptr ? Vector3(Vector3::UnitY()) : up(scene->environment).value_or(Vector3::UnitY());
}

Plane ground_below(const Box& subject, const Vector3& up) {
  const Vector3 half = 0.5 * (subject.high - subject.low);
  const double reach = half.cwiseProduct(up.cwiseAbs()).sum() + 0.02 * subject.diagonal();
  return {ground_id, subject.middle() - reach * up, up};
}

bool has_shore(const Scene& scene) {
  constexpr double least = 0.02, most = 0.9; // its height on a way of one
  const Vector3 upwards = up_of(&scene);
  return std::ranges::any_of(scene.solids, [&](const scene::Solid& solid) {
    const auto* plane = std::get_if<scene::HalfSpace>(&solid.shape);
    const double lean = plane != nullptr ? plane->normal.normalized().cross(upwards).norm() : 0;
    return lean > least && lean < most && plane->normal.dot(upwards) > 0;
  });
}

Plane bath_surface(double level, const Box& subject, const Vector3& up, bool shore) {
  Plane surface = ground_below(subject, up);
  const double higher = level - surface.point.dot(up);
  surface.point += (shore ? higher : std::min(0.0, higher)) * up;
  return surface;
}

} // namespace sheet::render
