// SPDX-License-Identifier: GPL-3.0-or-later
// One function a table of the scene file, for read.cpp. Each reports what is wrong and returns what it could read.
#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "libsheet/scene/reader.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// How file names are understood.
struct Files {
  std::filesystem::path folder; // of the scene file; relative names start here
  bool must_exist = false;
};

SheetTable read_sheet(TableReader table, const Environment& environment, const Files& files);
Liquid read_material(TableReader table, const Files& files);
Environment read_environment(TableReader table);
Model read_model(TableReader table);
// `sheets`: those of the scene, at least one.
Hold read_hold(TableReader table, std::span<const SheetTable> sheets, const Model& model, const Files& files);
Solid read_solid(TableReader table, const Environment& environment, const Files& files);
Inflow read_inflow(TableReader table, std::span<const SheetTable> sheets);
Outflow read_outflow(TableReader table);
Tear read_tear(TableReader table, std::span<const SheetTable> sheets);
Merge read_merge(TableReader table);
Contact read_contact(TableReader table);
Heat read_heat(TableReader table);

// Rows of motions that a scene may have in all: every frame carries them, and a scene's text has 4 MiB at most.
inline constexpr std::size_t most_keyframes = 16000;

// Parts that several tables have.
Motion read_motion(TableReader& parent, const Vector3d& center, const Files& files);
// The same of a thing that may also say it shortly: `velocity`, constant or in rows, a constant `angular_velocity`
// about its center, or both. Reports those beside a motion.
Motion read_motion_or_velocity(TableReader& parent, const Vector3d& center, const Files& files);
// The rows of a motion: `times` with `places`, `rotations` or both, or a CSV `file` of them. Null if they are wrong.
std::shared_ptr<const Keyframes> read_keyframes(TableReader& motion, const Vector3d& center, const Files& files);
std::optional<Rotation> read_rotation(TableReader& parent);
// A list of rows of a place and a value of the key's kind; what they are in words, and an example, for messages.
PlaceRows read_place_rows(TableReader& table, std::string_view key, std::string_view what, std::string_view example,
                          Bound bound);
// The file that the key names, of a kind that the key takes.
std::string read_file(TableReader& table, const Files& files, std::string_view key = "file");
// The sheet that the key "sheet" names, and its name. Without the key: none, if that is enough (`any`), or the only
// one.
struct WhichSheet {
  std::string name;
  const SheetTable& sheet;
};
WhichSheet read_which_sheet(TableReader& table, std::span<const SheetTable> sheets, bool any);
// A border by its name; reports one that the sheet does not have.
std::optional<Border> read_border(TableReader& table, std::string_view key, const SheetTable& sheet);

} // namespace sheet::scene
