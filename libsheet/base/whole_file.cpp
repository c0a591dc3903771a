// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"

namespace sheet {

namespace {

namespace fs = std::filesystem;

// Where the file really lies, so that a link to it stays one.
fs::path real_place(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? fs::path(path) : real;
}

} // namespace

void write_whole_file(const std::string& path, const std::function<void(OutputFile&)>& write) {
  std::error_code error;
  const fs::file_status status = path == "-" ? fs::file_status(fs::file_type::fifo) : fs::status(path, error);
  if (fs::is_directory(status))
    fail(ExitCode::io, "cannot write {}: it is a folder", path);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    OutputFile file(path, OutputFile::Content::binary);
    write(file);
    file.close();
    return;
  }
  claim_file(path, FileRole::output);
  const fs::path target = real_place(path);
  const std::string part = (target.parent_path() / fmt::format(".{}.part", target.filename().string())).string();
  try {
    OutputFile file(part, OutputFile::Content::binary);
    write(file);
    file.close();
    if (std::rename(part.c_str(), target.c_str()) != 0)
      fail(ExitCode::io, "cannot rename {} to {}: {}", part, path, std::strerror(errno));
  } catch (...) {
    fs::remove(part, error);
    release_file(path, FileRole::output);
    throw;
  }
  release_file(path, FileRole::output);
}

void make_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty())
    fs::create_directories(folder, error);
  if (error)
    fail(ExitCode::io, "cannot make the folder {}: {}", folder.string(), error.message());
}

} // namespace sheet
