// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/distance_field.h"

#include <utility>

#include "libsheet/base/error.h"
#include "libsheet/solid/level_set_module.h"
#include "libsheet/solid/vdb/level_sets.h"

namespace sheet::solid {
DistanceField::DistanceField(const SolidSurface& surface, double voxel_size, double band)
    : values_(level_set_module().make(surface, voxel_size, band)) {}
DistanceField::DistanceField(std::unique_ptr<const LevelSet> values) : values_(std::move(values)) {}
DistanceField::~DistanceField() = default;
DistanceField::DistanceField(DistanceField&&) noexcept = default;
DistanceField& DistanceField::operator=(DistanceField&&) noexcept = default;

double DistanceField::at(const Vector3& x) const { return values_->at(x); }
double DistanceField::slack() const { return values_->slack(); }
double DistanceField::voxel_size() const { return values_->voxel_size(); }
std::size_t DistanceField::bytes() const { return values_->bytes(); }
std::size_t DistanceField::voxels() const { return values_->voxels(); }
std::string DistanceField::print() const { return values_->print(); }
DistanceField DistanceField::parse(const std::string& bytes) { return DistanceField(level_set_module().parse(bytes)); }

std::uint64_t level_set_version() { return level_set_module().version; }

SolidSurface read_level_set(const std::string& file) {
  LevelSetFile found = level_set_module().read(file);
  if (!found.problem.empty())
    fail(found.unreadable ? ExitCode::io : ExitCode::bad_input, "{}: {}", file, found.problem);
  return std::move(found.surface);
}

} // namespace sheet::solid
