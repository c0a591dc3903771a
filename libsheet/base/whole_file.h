// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are there as a whole or not at all.
#pragma once
#include <functional>
#include <string>

#include "libsheet/base/files.h"

namespace sheet {

// Lets `write` write the file under another name in the same folder, and renames it when it is whole; where that fails
// (a full disk), an earlier file of the name stays, and nothing else. What is no regular file (a pipe, a device, "-")
// is written as it is. Throws Error (io), and what `write` throws.
void write_whole_file(const std::string& path, const std::function<void(OutputFile&)>& write);

// The folder of the path, made if it is missing. Throws Error (io).
void make_folder_of(const std::string& path);

} // namespace sheet
