// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files (TOML). Every key is checked; all that is wrong is reported together in one Error (bad_input), a line for
// each:
//   scene.toml:12:5: unknown key "viscocity" in [material]; did you mean "viscosity"?
// `sets` are the texts of --set options, "material.viscosity=50"; what is wrong with a value of theirs names them
// instead.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

// A user's file. Files that it names are looked for in its folder and must exist. In the Scene their names are relative
// to the current folder, so that streams hold no absolute paths, unless the scene file itself says an absolute one.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path, std::span<const std::string> sets = {});

// A text, such as the one that travels in a stream; `name` stands for the file in messages. File names are taken to
// start in base_folder (empty: the current one) and are not looked for: whoever reads the file reports it.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view name, std::span<const std::string> sets = {},
                                const std::filesystem::path& base_folder = {});

} // namespace sheet::scene

namespace sheet {
using scene::parse_scene;
using scene::read_scene;
} // namespace sheet
