// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/body_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/ValueTransformer.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "libsheet/solid/vdb/closing.h"
#include "libsheet/solid/vdb/slab_field.h"

namespace sheet::solid {
namespace {

using openvdb::FloatGrid;
using openvdb::FloatTree;
using Leaf = FloatTree::LeafNodeType;
static_assert(Leaf::SIZE == SlabBlocks::voxels);

std::unique_ptr<Leaf> make_leaf(const Voxel& origin, const std::array<float, SlabBlocks::voxels>& values, float depth,
                                float reach) {
  auto leaf = std::make_unique<Leaf>(openvdb::Coord(origin.x(), origin.y(), origin.z()), reach, false);
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i)
    if (values[i] > -depth && values[i] < reach)
      leaf->setValueOn(i, values[i]);
    else
      leaf->setValueOff(i, values[i] < 0 ? -depth : reach);
  return leaf;
}

} // namespace

struct BodyGrid::Grid {
  FloatGrid::Ptr field;
};

BodyGrid::BodyGrid(const SlabBlocks& blocks, float depth, float reach)
    : grid_(std::make_unique<Grid>()), depth_(depth) {
  std::vector<std::unique_ptr<Leaf>> leaves(blocks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), 16), [&](const auto& range) {
    SlabField field(blocks);
    std::array<float, SlabBlocks::voxels> values;
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      field.fill(b, reach, values);
      leaves[b] = make_leaf(blocks.origin(b), values, depth, reach);
    }
  });
  grid_->field = FloatGrid::create(reach);
  grid_->field->setGridClass(openvdb::GRID_LEVEL_SET);
  for (std::unique_ptr<Leaf>& leaf : leaves) {
    float value = 0;
    bool active = false;
    if (!leaf->isConstant(value, active))
      grid_->field->tree().addLeaf(leaf.release());
    else if (value < 0)
      grid_->field->tree().addTile(1, leaf->origin(), -depth, false);
  }
}

BodyGrid::~BodyGrid() = default;

std::size_t BodyGrid::voxels() const { return grid_->field->activeVoxelCount(); }

DepthCount BodyGrid::depths(double last_iso) const {
  tbb::enumerable_thread_specific<DepthCount> counts(last_iso);
  std::vector<const Leaf*> leaves;
  grid_->field->constTree().getNodes(leaves);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    counts.local().add({leaves[i]->buffer().data(), Leaf::SIZE});
  });
  DepthCount sum(last_iso);
  for (const DepthCount& count : counts) // integers, so in any order
    sum.add(count);
  auto tile = grid_->field->constTree().cbeginValueOff();
  for (tile.setMaxDepth(FloatTree::ValueOffCIter::LEAF_DEPTH - 1); tile; ++tile)
    if (*tile < 0)
      sum.add_deep(tile.getVoxelCount());
  return sum;
}

void BodyGrid::close(float length) {
  FloatTree& tree = grid_->field->tree();
  std::vector<Leaf*> leaves;
  tree.getNodes(leaves);
  std::vector<FieldBlock> blocks;
  blocks.reserve(leaves.size());
  for (Leaf* const leaf : leaves)
    blocks.push_back({Voxel(leaf->origin().x(), leaf->origin().y(), leaf->origin().z()), leaf->buffer().data()});
  close_field(
      blocks, [&](const Voxel& x) { return tree.getValue(openvdb::Coord(x.x(), x.y(), x.z())); }, length, depth_);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    for (openvdb::Index k = 0; k < Leaf::SIZE; ++k)
      if (leaves[i]->getValue(k) <= -depth_)
        leaves[i]->setValueOff(k);
  });
}

SolidSurface BodyGrid::isosurface(double iso) const {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles; // none: the mesh is not adaptive
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid_->field, points, triangles, quads, iso, 0.0);
  SolidSurface surface;
  surface.points.reserve(points.size());
  for (const openvdb::Vec3s& x : points)
    surface.points.emplace_back(x.x(), x.y(), x.z());
  surface.triangles.reserve(2 * quads.size());
  for (const openvdb::Vec4I& q : quads) { // clockwise
    const auto first = (points[q[0]] - points[q[2]]).lengthSqr(), second = (points[q[1]] - points[q[3]]).lengthSqr();
    if (first <= second) {
      surface.triangles.push_back({q[0], q[2], q[1]});
      surface.triangles.push_back({q[0], q[3], q[2]});
    } else {
      surface.triangles.push_back({q[1], q[0], q[3]});
      surface.triangles.push_back({q[1], q[3], q[2]});
    }
  }
  return surface;
}

std::string print_level_set(const SolidSurface& surface, const VoxelSpace& space, double time) {
  std::vector<openvdb::Vec3s> points;
  points.reserve(surface.points.size());
  for (const Vector3& x : surface.points)
    points.emplace_back(static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z()));
  std::vector<openvdb::Vec3I> triangles;
  triangles.reserve(surface.triangles.size());
  for (const Corners& c : surface.triangles)
    triangles.emplace_back(c[0], c[1], c[2]);
  constexpr float band = 3;
  const FloatGrid::Ptr field = openvdb::tools::meshToSignedDistanceField<FloatGrid>(
      *openvdb::math::Transform::createLinearTransform(1.0), points, triangles, {}, band, band);
  const auto voxel = static_cast<float>(space.voxel);
  openvdb::tools::foreach (field->beginValueAll(),
                           [voxel](const FloatGrid::ValueAllIter& value) { value.setValue(*value * voxel); });
  field->tree().root().setBackground(band * voxel, false);
  const auto transform = openvdb::math::Transform::createLinearTransform(space.voxel);
  transform->postTranslate(openvdb::Vec3d(space.center.x(), space.center.y(), space.center.z()));
  field->setTransform(transform);
  field->setName("surface");
  field->insertMeta("time", openvdb::DoubleMetadata(time));
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream stream(out);
  stream.write(openvdb::GridCPtrVec{field});
  std::string bytes = std::move(out).str();
  // A file's tag is random, which the same input must not give.
  const std::string tag = stream.getUniqueTag();
  if (const std::size_t place = bytes.find(tag); !tag.empty() && place < 100)
    bytes.replace(place, tag.size(), "00000000-0000-0000-0000-000000000000");
  return bytes;
}

} // namespace sheet::solid
