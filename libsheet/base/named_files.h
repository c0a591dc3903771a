// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a scene or an option names: meshes, level sets, pictures. They are read whole and may be read again, so a
// pipe or a device, which would keep a program waiting for ever, is refused.
#pragma once
#include <string>

#include "formats/cpp/mesh_import.h"

namespace sheet {

// Throws Error: io (it is a pipe, a device or a folder), usage (this program writes it). Whoever reads a file that is
// not there says so.
void check_named_file(const std::string& path);

// The mesh of such a file. Throws Error: io, bad_input (content, or a kind that is not known).
[[nodiscard]] formats::MeshImport import_named_mesh(const std::string& path);

} // namespace sheet
