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
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "libsheet/solid/vdb/slab_field.h"

namespace sheet::solid {
namespace {

using openvdb::BoolTree;
using openvdb::FloatGrid;
using openvdb::FloatTree;
using Leaf = FloatTree::LeafNodeType;
static_assert(Leaf::SIZE == SlabBlocks::voxels);

constexpr float deepest = -BodyGrid::depth;

std::unique_ptr<Leaf> make_leaf(const Voxel& origin, const std::array<float, SlabBlocks::voxels>& values, float reach) {
  auto leaf = std::make_unique<Leaf>(openvdb::Coord(origin.x(), origin.y(), origin.z()), reach, false);
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i)
    if (values[i] > deepest && values[i] < reach)
      leaf->setValueOn(i, values[i]);
    else
      leaf->setValueOff(i, values[i] < 0 ? deepest : reach);
  return leaf;
}

// Where the voxels are the field becomes that of deep inside.
void fill_voxels(const BoolTree& voxels, FloatTree& field) {
  for (auto leaf = voxels.cbeginLeaf(); leaf; ++leaf) {
    Leaf* const values = field.touchLeaf(leaf->origin());
    for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel)
      values->setValueOff(voxel.pos(), deepest);
  }
  auto tile = voxels.cbeginValueOn();
  for (tile.setMaxDepth(BoolTree::ValueOnCIter::LEAF_DEPTH - 1); tile; ++tile)
    field.fill(tile.getBoundingBox(), deepest, false);
}

// Distances from the isosurface in metres, three voxels to either side.
void become_level_set(FloatTree& field, double iso, double voxel) {
  const auto reach = static_cast<float>(BodyGrid::depth * voxel);
  openvdb::tree::LeafManager<FloatTree> leaves(field);
  leaves.foreach ([&](Leaf& leaf, std::size_t) {
    const float* const values = leaf.buffer().data();
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
      const auto metres = static_cast<float>((static_cast<double>(values[i]) - iso) * voxel);
      leaf.setValueOnly(i, std::clamp(metres, -reach, reach));
      leaf.setActiveState(i, std::abs(metres) < reach);
    }
  });
  auto tile = field.beginValueOff();
  for (tile.setMaxDepth(FloatTree::ValueOffIter::LEAF_DEPTH - 1); tile; ++tile)
    tile.setValue(*tile < 0 ? -reach : reach);
  field.root().setBackground(reach, true);
  openvdb::tools::pruneLevelSet(field);
}

} // namespace

struct BodyGrid::Grid {
  FloatGrid::Ptr field;
  BoolTree::Ptr wide = std::make_shared<BoolTree>(); // the voxels of wide voids
};

BodyGrid::BodyGrid(const SlabBlocks& blocks, float reach) : grid_(std::make_unique<Grid>()) {
  std::vector<std::unique_ptr<Leaf>> leaves(blocks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), 16), [&](const auto& range) {
    SlabField field(blocks);
    std::array<float, SlabBlocks::voxels> values;
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      field.fill(b, reach, values);
      leaves[b] = make_leaf(blocks.origin(b), values, reach);
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
      grid_->field->tree().addTile(1, leaf->origin(), deepest, false);
  }
}

BodyGrid::~BodyGrid() = default;

std::size_t BodyGrid::voxels() const { return grid_->field->activeVoxelCount(); }

DepthCount BodyGrid::depths() const {
  tbb::enumerable_thread_specific<DepthCount> counts;
  std::vector<const Leaf*> leaves;
  grid_->field->constTree().getNodes(leaves);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    counts.local().add({leaves[i]->buffer().data(), Leaf::SIZE});
  });
  DepthCount sum;
  for (const DepthCount& count : counts) // integers, so in any order
    sum.add(count);
  auto tile = grid_->field->constTree().cbeginValueOff();
  for (tile.setMaxDepth(FloatTree::ValueOffCIter::LEAF_DEPTH - 1); tile; ++tile)
    if (*tile < 0)
      sum.add_deep(tile.getVoxelCount());
  return sum;
}

void BodyGrid::close(float length) {
  grid_->field = openvdb::tools::sdfToSdf(*grid_->field, length);
  openvdb::tree::LeafManager<FloatTree> leaves(grid_->field->tree());
  leaves.foreach ([&](Leaf& leaf, std::size_t) {
    float* const values = leaf.buffer().data();
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i)
      values[i] = std::max(values[i] + length, deepest);
  });
}

Voids BodyGrid::fill_narrow_voids(float iso, int radius) {
  FloatTree& field = grid_->field->tree();
  const BoolTree::Ptr enclosed = openvdb::tools::extractEnclosedRegion(field, iso);
  enclosed->topologyDifference(*openvdb::tools::sdfInteriorMask(field, iso));
  std::vector<BoolTree::Ptr> voids;
  if (enclosed->activeVoxelCount() > 0)
    openvdb::tools::extractActiveVoxelSegmentMasks(*enclosed, voids);
  Voids found;
  grid_->wide->clear();
  for (const BoolTree::Ptr& one : voids) {
    BoolTree core(*one);
    openvdb::tools::erodeActiveValues(core, radius, openvdb::tools::NN_FACE);
    if (core.activeVoxelCount() > 0) {
      grid_->wide->topologyUnion(*one);
      ++found.wide;
    } else {
      fill_voxels(*one, field);
      ++found.filled;
    }
  }
  found.voxels = grid_->wide->activeVoxelCount();
  return found;
}

bool BodyGrid::is_beside_wide_void(const Vector3& x) const {
  const openvdb::Coord low = openvdb::Coord::floor(openvdb::Vec3d(x.x(), x.y(), x.z()));
  for (int corner = 0; corner < 8; ++corner)
    if (grid_->wide->isValueOn(low.offsetBy(corner & 1, corner >> 1 & 1, corner >> 2)))
      return true;
  return false;
}

void BodyGrid::fill_wide_voids() { fill_voxels(*grid_->wide, grid_->field->tree()); }

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

std::string BodyGrid::print(double iso, const VoxelSpace& space, double time) && {
  FloatGrid& field = *grid_->field;
  become_level_set(field.tree(), iso, space.voxel);
  const auto transform = openvdb::math::Transform::createLinearTransform(space.voxel);
  transform->postTranslate(openvdb::Vec3d(space.center.x(), space.center.y(), space.center.z()));
  field.setTransform(transform);
  field.setGridClass(openvdb::GRID_LEVEL_SET);
  field.setName("surface");
  field.insertMeta("time", openvdb::DoubleMetadata(time));
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream stream(out);
  stream.write(openvdb::GridCPtrVec{grid_->field});
  std::string bytes = std::move(out).str();
  // A file's tag is random, which the same input must not give.
  const std::string tag = stream.getUniqueTag();
  if (const std::size_t place = bytes.find(tag); !tag.empty() && place < 100)
    bytes.replace(place, tag.size(), "00000000-0000-0000-0000-000000000000");
  return bytes;
}

} // namespace sheet::solid
