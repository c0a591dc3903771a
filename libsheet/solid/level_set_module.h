// SPDX-License-Identifier: GPL-3.0-or-later
// The module that knows OpenVDB (vdb/level_sets.h), loaded when it is first asked for.
#pragma once

namespace sheet::solid {

struct LevelSetModule;

// Throws Error (internal) if it is not where it was installed, or cannot be loaded.
[[nodiscard]] const LevelSetModule& level_set_module();

} // namespace sheet::solid
