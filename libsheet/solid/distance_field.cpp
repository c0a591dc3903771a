// SPDX-License-Identifier: GPL-3.0-or-later
// The module that knows OpenVDB, loaded when it is first needed.
#include "libsheet/solid/distance_field.h"

#include <filesystem>
#include <utility>

#include <dlfcn.h>

#include "libsheet/base/error.h"
#include "libsheet/solid/vdb/level_sets.h"

namespace sheet::solid {
namespace {

namespace fs = std::filesystem;

constexpr const char* module_name = "sheet-level-sets.so";

// Where programs stand in bin/ it is in lib/sheet/modules/ beside that; programs elsewhere (tests) know its place
// themselves.
const LevelSetModule* open_module() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = program.parent_path().parent_path() / "lib" / "sheet" / "modules" / module_name;
  void* handle = dlopen(fs::exists(beside, error) ? beside.c_str() : module_name, RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr)
    fail(ExitCode::internal, "distances of meshes cannot be loaded: {} (expected at {}, and needs OpenVDB's library)",
         dlerror(), beside.string());
  const auto* module = static_cast<const LevelSetModule*>(dlsym(handle, "sheet_level_sets"));
  if (module == nullptr)
    fail(ExitCode::internal, "{} is not of this version: {}", beside.string(), dlerror());
  return module;
}

const LevelSetModule& module() {
  static const LevelSetModule* const loaded = open_module();
  return *loaded;
}

} // namespace

DistanceField::DistanceField(const SolidSurface& surface, double voxel_size, double band)
    : values_(module().make(surface, voxel_size, band)) {}
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
DistanceField DistanceField::parse(const std::string& bytes) { return DistanceField(module().parse(bytes)); }

std::uint64_t level_set_version() { return module().version; }

SolidSurface read_level_set(const std::string& file) {
  LevelSetFile found = module().read(file);
  if (!found.problem.empty())
    fail(found.unreadable ? ExitCode::io : ExitCode::bad_input, "{}: {}", file, found.problem);
  return std::move(found.surface);
}

} // namespace sheet::solid
