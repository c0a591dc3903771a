// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/level_sets.h"

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/version.h>

#include "libsheet/geometry/box.h"
#include "libsheet/solid/vdb/unite.h"

namespace sheet::solid {
namespace {

using openvdb::FloatGrid;

openvdb::Vec3d to_vdb(const Vector3& x) { return {x.x(), x.y(), x.z()}; }
Vector3 from_vdb(const openvdb::Vec3d& x) { return {x.x(), x.y(), x.z()}; }

constexpr const char* center_key = "sheet_center";
constexpr const char* voxel_key = "sheet_voxel";

// The grid's own unit is a voxel and its origin the middle of the surface, so single precision is enough at any scale.
class Grid : public LevelSet {
public:
  Grid(FloatGrid::Ptr grid, const Vector3& center, double voxel)
      : grid_(std::move(grid)), center_(center), voxel_(voxel) {}

  [[nodiscard]] double at(const Vector3& x) const override {
    const FloatGrid::ConstUnsafeAccessor accessor(grid_->tree());
    const Vector3 place = (x - center_) / voxel_;
    // Voxels are counted in 32 bits.
    if (place.cwiseAbs().maxCoeff() > 1e9)
      return voxel_ * static_cast<double>(grid_->background());
    return voxel_ * static_cast<double>(openvdb::tools::BoxSampler::sample(accessor, to_vdb(place)));
  }

  // The last part stands for single precision, which OpenVDB computes in.
  [[nodiscard]] double slack() const override {
    const openvdb::CoordBBox box = grid_->evalActiveVoxelBoundingBox();
    return voxel_ * (std::sqrt(3.0) / 2 + 1e-6 * box.extents().asVec3d().length());
  }

  [[nodiscard]] double voxel_size() const override { return voxel_; }
  [[nodiscard]] std::size_t bytes() const override { return grid_->memUsage(); }
  [[nodiscard]] std::size_t voxels() const override { return grid_->activeVoxelCount(); }

  [[nodiscard]] std::string print() const override {
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    stream.write(openvdb::GridCPtrVec{grid_});
    return std::move(out).str();
  }

private:
  FloatGrid::Ptr grid_;
  Vector3 center_;
  double voxel_;
};

std::unique_ptr<const LevelSet> make(const SolidSurface& surface, double voxel_size, double band) {
  openvdb::initialize();
  Box3 box;
  for (const Vector3& x : surface.points)
    box.extend(x);
  const Vector3 center = box.center();
  std::vector<openvdb::Vec3s> points;
  points.reserve(surface.points.size());
  for (const Vector3& x : surface.points)
    points.emplace_back(to_vdb((x - center) / voxel_size));
  std::vector<openvdb::Vec3I> triangles;
  triangles.reserve(surface.triangles.size());
  for (const Corners& c : surface.triangles)
    triangles.emplace_back(c[0], c[1], c[2]);
  const auto width = static_cast<float>(band);
  const FloatGrid::Ptr grid = openvdb::tools::meshToSignedDistanceField<FloatGrid>(
      *openvdb::math::Transform::createLinearTransform(1.0), points, triangles, {}, width, width);
  grid->insertMeta(center_key, openvdb::Vec3DMetadata(to_vdb(center)));
  grid->insertMeta(voxel_key, openvdb::DoubleMetadata(voxel_size));
  return std::make_unique<Grid>(grid, center, voxel_size);
}

std::unique_ptr<const LevelSet> parse(const std::string& bytes) {
  openvdb::initialize();
  std::istringstream in(bytes, std::ios::binary);
  openvdb::io::Stream stream(in, false);
  const openvdb::GridPtrVecPtr grids = stream.getGrids();
  if (grids->empty())
    throw std::runtime_error("no grid");
  const FloatGrid::Ptr grid = openvdb::gridPtrCast<FloatGrid>(grids->front());
  const Vector3 center = from_vdb(grid->metaValue<openvdb::Vec3d>(center_key));
  return std::make_unique<Grid>(grid, center, grid->metaValue<double>(voxel_key));
}

SolidSurface zero_level(const FloatGrid& field) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(field, points, triangles, quads, 0.0, 0.0);
  SolidSurface surface;
  surface.points.reserve(points.size());
  for (const openvdb::Vec3s& x : points)
    surface.points.push_back(from_vdb(openvdb::Vec3d(x)));
  // OpenVDB goes round a face clockwise, seen from outside.
  for (const openvdb::Vec3I& t : triangles)
    surface.triangles.push_back({t[0], t[2], t[1]});
  for (const openvdb::Vec4I& q : quads) {
    surface.triangles.push_back({q[0], q[2], q[1]});
    surface.triangles.push_back({q[0], q[3], q[2]});
  }
  return surface;
}

LevelSetFile read(const std::string& file) {
  openvdb::initialize();
  FloatGrid::Ptr field;
  try {
    openvdb::io::File input(file);
    input.open(false);
    for (auto name = input.beginName(); name != input.endName() && !field; ++name) {
      const openvdb::GridBase::Ptr grid = input.readGrid(name.gridName());
      if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
        field = openvdb::gridPtrCast<FloatGrid>(grid);
    }
  } catch (const openvdb::IoError& error) {
    return {{}, std::string(error.what()) + "; is it there, readable and whole?", true};
  } catch (const std::exception& error) {
    return {{}, std::string(error.what()) + "; a level set of OpenVDB is wanted"};
  }
  if (!field)
    return {{},
            "no grid of single precision and class \"level set\" in it; a solid needs signed distances, not a density"};
  for (auto value = field->cbeginValueOn(); value; ++value)
    if (!std::isfinite(*value))
      return {{}, "the voxel " + value.getCoord().asVec3i().str() + " is not finite; write the field anew"};
  return {zero_level(*field), {}};
}

} // namespace

const LevelSetModule sheet_level_sets{openvdb::OPENVDB_LIBRARY_VERSION, make, parse, read, unite_slabs};

} // namespace sheet::solid
