// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/distance_field.h"

#include <cmath>
#include <sstream>

#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "libsheet/base/error.h"

namespace sheet::solid {
namespace {

using openvdb::FloatGrid;

openvdb::Vec3d to_vdb(const Vector3& x) { return {x.x(), x.y(), x.z()}; }
Vector3 from_vdb(const openvdb::Vec3d& x) { return {x.x(), x.y(), x.z()}; }

constexpr const char* center_key = "sheet_center";
constexpr const char* voxel_key = "sheet_voxel";

} // namespace

// The grid's own unit is a voxel and its origin the middle of the surface, so single precision is enough at any scale.
struct DistanceField::Grid {
  FloatGrid::Ptr grid;
  Vector3 center;
  double voxel;
};

DistanceField::DistanceField(const SolidSurface& surface, double voxel_size, double band) {
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
  grid_ = std::make_unique<Grid>(Grid{grid, center, voxel_size});
}

DistanceField::DistanceField(std::unique_ptr<const Grid> grid) : grid_(std::move(grid)) {}
DistanceField::~DistanceField() = default;
DistanceField::DistanceField(DistanceField&&) noexcept = default;
DistanceField& DistanceField::operator=(DistanceField&&) noexcept = default;

double DistanceField::at(const Vector3& x) const {
  const FloatGrid::ConstUnsafeAccessor accessor(grid_->grid->tree());
  const Vector3 place = (x - grid_->center) / grid_->voxel;
  // Voxels are counted in 32 bits.
  if (place.cwiseAbs().maxCoeff() > 1e9)
    return grid_->voxel * static_cast<double>(grid_->grid->background());
  return grid_->voxel * static_cast<double>(openvdb::tools::BoxSampler::sample(accessor, to_vdb(place)));
}

// The last part stands for single precision, which OpenVDB computes in.
double DistanceField::slack() const {
  const openvdb::CoordBBox box = grid_->grid->evalActiveVoxelBoundingBox();
  return grid_->voxel * (std::sqrt(3.0) / 2 + 1e-6 * box.extents().asVec3d().length());
}

double DistanceField::voxel_size() const { return grid_->voxel; }
std::size_t DistanceField::bytes() const { return grid_->grid->memUsage(); }
std::size_t DistanceField::voxels() const { return grid_->grid->activeVoxelCount(); }

std::string DistanceField::print() const {
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream stream(out);
  stream.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
  stream.write(openvdb::GridCPtrVec{grid_->grid});
  return std::move(out).str();
}

DistanceField DistanceField::parse(const std::string& bytes) {
  openvdb::initialize();
  std::istringstream in(bytes, std::ios::binary);
  openvdb::io::Stream stream(in, false);
  const openvdb::GridPtrVecPtr grids = stream.getGrids();
  if (grids->empty())
    throw std::runtime_error("no grid");
  FloatGrid::Ptr grid = openvdb::gridPtrCast<FloatGrid>(grids->front());
  const Vector3 center = from_vdb(grid->metaValue<openvdb::Vec3d>(center_key));
  const double voxel = grid->metaValue<double>(voxel_key);
  return DistanceField(std::make_unique<const Grid>(Grid{std::move(grid), center, voxel}));
}

SolidSurface read_level_set(const std::string& file) {
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
    fail(ExitCode::io, "{}: {}; is it there, readable and whole?", file, error.what());
  } catch (const std::exception& error) {
    fail(ExitCode::bad_input, "{}: {}; a level set of OpenVDB is wanted", file, error.what());
  }
  if (!field)
    fail(ExitCode::bad_input,
         "{}: no grid of single precision and class \"level set\" in it; a solid needs signed distances, not a density",
         file);
  for (auto value = field->cbeginValueOn(); value; ++value)
    if (!std::isfinite(*value))
      fail(ExitCode::bad_input, "{}: the voxel {} is not finite; write the field anew", file,
           value.getCoord().asVec3i().str());
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*field, points, triangles, quads, 0.0, 0.0);
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

} // namespace sheet::solid
