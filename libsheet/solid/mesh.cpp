// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/named_files.h"
#include "libsheet/solid/check.h"
#include "libsheet/solid/distance_cache.h"
#include "libsheet/solid/distance_field.h"
#include "libsheet/solid/triangle_tree.h"

namespace sheet::solid {
namespace {

// Half the field's width in voxels. Wider fields answer farther out, but there a box does nearly as well.
constexpr double band_voxels = 6;
// Voxels along the longest side, where the scene does not say.
constexpr double voxels_across = 128;
// No field has more voxels than this, some 100 MB: the time would be lost, not gained.
constexpr double most_voxels = 1e7;

double voxel_size_for(const SolidSurface& surface, double wanted) {
  Box3 box;
  for (const Vector3& x : surface.points)
    box.extend(x);
  const double side = box.sizes().maxCoeff();
  return wanted > 0 ? wanted : side / voxels_across;
}

// A field's voxels lie within the band on both sides of the surface.
void check_voxels(const SolidSurface& surface, const std::string& name, double voxel_size) {
  double area = 0;
  for (const auto& [a, b, c] : surface.triangles)
    area += 0.5 * (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]).norm();
  const double voxels = 2 * band_voxels * area / (voxel_size * voxel_size);
  if (!(voxels <= most_voxels))
    fail(ExitCode::bad_input,
         "{}: voxel_size = {:g} m makes a field of {:.2g} voxels, more than {:g}: leave it out, or give {:.2g} m or "
         "more",
         name, voxel_size, voxels, most_voxels, std::sqrt(2 * band_voxels * area / most_voxels) * 1.01);
}

class MeshDistance final : public SolidDistance {
public:
  MeshDistance(SolidSurface surface, DistanceField field)
      : tree_(std::move(surface)), field_(std::move(field)), slack_(field_.slack()) {}

  [[nodiscard]] Box3 bounds() const override { return tree_.bounds(); }

  [[nodiscard]] Near nearest(const Vector3& x) const override {
    return *tree_.nearest(x, std::numeric_limits<double>::infinity());
  }

  [[nodiscard]] double distance(const Vector3& x, double enough) const override {
    const double outside = tree_.bounds().exteriorDistance(x);
    if (outside >= enough)
      return outside;
    const double field = field_.at(x);
    if (field - slack_ >= enough) // the field takes closed hollows for solid
      return field - slack_;
    return nearest(x).distance;
  }

  [[nodiscard]] std::optional<TriangleHit> first_hit(const MovingTriangle& triangle, double clearance,
                                                     double tolerance) const override {
    auto hit = tree_.first_hit(triangle, clearance, tolerance);
    if (hit)
      hit->point.near = nearest(point_of(triangle.at(hit->s), hit->point.weights));
    return hit;
  }

  [[nodiscard]] double separation(const Triangle3& triangle, double enough, double /*tolerance*/) const override {
    const double least = tree_.nearest(triangle, enough).distance;
    // What does not cross the surface lies on one side of it.
    return least > 0 && distance(triangle[0], least) < 0 ? 0.0 : least;
  }

private:
  TriangleTree tree_;
  DistanceField field_;
  double slack_;
};

std::shared_ptr<const SolidDistance> distance_from_file(const scene::SolidMesh& mesh, const std::string& name) {
  SolidSurface surface;
  try {
    surface = read_surface(mesh);
  } catch (const Error& error) {
    if (error.code() != ExitCode::io)
      throw;
    fail(ExitCode::io, "{} (the scene names it as seen from the folder in which sheet-init ran: go on from there)",
         error.what());
  }
  check_surface(surface, name, true);
  const double voxel_size = voxel_size_for(surface, mesh.voxel_size.value_or(0));
  check_voxels(surface, name, voxel_size);
  const std::string key = cache_key(surface, voxel_size, band_voxels);
  std::optional<DistanceField> field = load_field(key);
  if (!field) {
    check_surface(surface, name);
    field.emplace(surface, voxel_size, band_voxels);
    store_field(key, *field);
  }
  return std::make_shared<MeshDistance>(std::move(surface), std::move(*field));
}

} // namespace

SolidSurface read_surface(const scene::SolidMesh& mesh) {
  SolidSurface surface;
  const std::string file = find_named_file(mesh.file, mesh.checksum);
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".vdb") {
    check_named_file(file);
    surface = read_level_set(file);
  } else {
    const formats::MeshImport import = import_named_mesh(file);
    for (const std::string& note : import.notes)
      log::warning("{} (what is left must be the closed surface of a solid)", note);
    for (const auto& [x, y, z] : import.mesh.points)
      surface.points.emplace_back(x, y, z);
    surface.triangles = import.mesh.triangles;
  }
  for (Vector3& x : surface.points)
    x *= mesh.scale;
  return surface;
}

std::shared_ptr<const SolidDistance> shared_distance(const scene::SolidMesh& mesh, const std::string& name) {
  static std::mutex mutex;
  static std::vector<std::pair<scene::SolidMesh, std::weak_ptr<const SolidDistance>>> known;
  const std::scoped_lock lock(mutex);
  std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
  for (const auto& [file, shared] : known)
    if (std::shared_ptr<const SolidDistance> distance = file == mesh ? shared.lock() : nullptr)
      return distance;
  std::shared_ptr<const SolidDistance> distance = distance_from_file(mesh, name);
  known.emplace_back(mesh, distance);
  return distance;
}

std::unique_ptr<const SolidDistance> make_distance(SolidSurface surface, double voxel_size) {
  DistanceField field(surface, voxel_size_for(surface, voxel_size), band_voxels);
  return std::make_unique<MeshDistance>(std::move(surface), std::move(field));
}

} // namespace sheet::solid
