// SPDX-License-Identifier: GPL-3.0-or-later
// The option --material NAME[,NAME...] of programs that show liquids: presets (slab.h), of the scene's liquids in turn.
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "libsheet/base/tool.h"

namespace sheet::render {

// `values`: places among liquid_names, with the default in it. `text` says what the option does, without the names.
void declare_materials(Tool& tool, std::vector<std::size_t>& values, std::string_view text);

} // namespace sheet::render
