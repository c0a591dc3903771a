// SPDX-License-Identifier: GPL-3.0-or-later
// All that knows OpenVDB, which takes longer to load than a short run to compute: a module, sheet-level-sets.so, that
// programs load when a mesh is a solid, or a union of layers is asked for (level_set_module.h). It throws standard
// exceptions only, and nothing of libsheet is called in it.
#pragma once
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "libsheet/solid/mesh.h"
#include "libsheet/solid/slab_union.h"

namespace sheet::solid {

// As DistanceField, whose data it is.
class LevelSet {
public:
  virtual ~LevelSet() = default;
  [[nodiscard]] virtual double at(const Vector3& x) const = 0;
  [[nodiscard]] virtual double slack() const = 0;
  [[nodiscard]] virtual double voxel_size() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  [[nodiscard]] virtual std::size_t voxels() const = 0;
  [[nodiscard]] virtual std::string print() const = 0;
};

// What a .vdb file held, or why it could not be had.
struct LevelSetFile {
  SolidSurface surface;
  std::string problem;     // none: empty
  bool unreadable = false; // the problem is one of the file, not of what it holds
};

struct LevelSetModule {
  std::uint64_t version; // of OpenVDB
  std::unique_ptr<const LevelSet> (*make)(const SolidSurface& surface, double voxel_size, double band);
  std::unique_ptr<const LevelSet> (*parse)(const std::string& bytes); // throws std::exception
  LevelSetFile (*read)(const std::string& file);
  SlabUnion (*unite)(const Slabs& slabs, const UnionOptions& options); // slab_union.h, without weights of origins
};

extern "C" const LevelSetModule sheet_level_sets;

} // namespace sheet::solid
