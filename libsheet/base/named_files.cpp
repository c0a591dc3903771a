// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/named_files.h"

#include <sys/stat.h>

#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"

namespace sheet {

void check_named_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return;
  if (!S_ISREG(status.st_mode))
    fail(ExitCode::io, "{}: it is not a file but a {}", path,
         S_ISDIR(status.st_mode)    ? "folder"
         : S_ISFIFO(status.st_mode) ? "pipe"
                                    : "device");
  claim_file(path, FileRole::input);
}

formats::MeshImport import_named_mesh(const std::string& path) try {
  check_named_file(path);
  return formats::import_mesh(path);
} catch (const formats::MeshFileError& error) {
  fail(error.kind() == formats::MeshFileError::Kind::io ? ExitCode::io : ExitCode::bad_input, "{}", error.what());
}

} // namespace sheet
