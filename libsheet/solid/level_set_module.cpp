// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/level_set_module.h"

#include <filesystem>

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
    fail(ExitCode::internal, "level sets cannot be loaded: {} (expected at {}, and needs OpenVDB's library)", dlerror(),
         beside.string());
  const auto* module = static_cast<const LevelSetModule*>(dlsym(handle, "sheet_level_sets"));
  if (module == nullptr)
    fail(ExitCode::internal, "{} is not of this version: {}", beside.string(), dlerror());
  return module;
}

} // namespace

const LevelSetModule& level_set_module() {
  static const LevelSetModule* const loaded = open_module();
  return *loaded;
}

} // namespace sheet::solid
