// SPDX-License-Identifier: GPL-3.0-or-later
// Which files this program reads and which it writes: none may be both, or nothing would be left to read. Files are
// told apart by device and inode, so links and other spellings of a name do not deceive. InputFile and OutputFile claim
// what they open; a program that opens a file later, or by other means, claims it beforehand.
#pragma once
#include <string>

namespace sheet {

enum class FileRole { input, output };

// Throws Error (usage) if the regular file that the path names is claimed already, except as input twice. A file that
// does not exist yet counts by its folder and name. Pipes and devices have no role. "-" is standard input or output.
void claim_file(const std::string& path, FileRole role);

// This program is done with the file: it may have another role from now on.
void release_file(const std::string& path, FileRole role);

} // namespace sheet
