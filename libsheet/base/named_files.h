// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a scene or an option names: meshes, level sets, pictures. They are read whole and may be read again, so a
// pipe or a device, which would keep a program waiting for ever, is refused.
#pragma once
#include <optional>
#include <string>

#include "formats/cpp/mesh_import.h"

namespace sheet {

// Throws Error: io (it is a pipe, a device or a folder), usage (this program writes it). Whoever reads a file that is
// not there says so.
void check_named_file(const std::string& path);

// What it holds: 16 hexadecimal digits, XXH3. Throws Error: io.
[[nodiscard]] std::string checksum_of_file(const std::string& path);

// Where a file is that a scene named when it had this checksum (empty: it is not known, and the name is the answer).
// Looked for as named and without its leading folders, from the current folder and from each one above, so that a
// stream may be worked on elsewhere; then likewise from the folders of the streams that are read, and from that of the
// scene file where sheet-run tells it. Throws Error: bad_input (another file has its place), io (there is none).
[[nodiscard]] std::string find_named_file(const std::string& name, const std::string& checksum);

// Where a file of this name is, whatever it holds: from the folders of the streams that are read, then from the current
// one; each time as named and without its leading folders, there and in each folder above. Nothing if there is none.
[[nodiscard]] std::optional<std::string> find_by_name(const std::string& name);

// Streams in this file are read: what they name may lie beside it.
void look_beside(const std::string& stream);

// Environment variable by which sheet-loop tells its stages the folder of the stream that they work on.
inline constexpr const char* stream_folder_variable = "SHEET_STREAM_FOLDER";

// Likewise by which sheet-run tells all programs the folder of the scene file.
inline constexpr const char* scene_folder_variable = "SHEET_SCENE_FOLDER";

// The mesh of such a file. Throws Error: io, bad_input (content, or a kind that is not known).
[[nodiscard]] formats::MeshImport import_named_mesh(const std::string& path, formats::WantedArrays arrays = {});

} // namespace sheet
