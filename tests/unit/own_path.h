// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a test's own: tests run side by side, those of two builds too.
#pragma once
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace sheet::test {

// A path for a file or folder of this name, in a folder of this process that goes when it ends.
inline std::string own_path(const std::string& name) {
  struct Folder {
    pid_t owner = ::getpid(); // and no fork of it
    std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("sheet_unit_" + std::to_string(owner));
    Folder() { std::filesystem::create_directories(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      if (owner == ::getpid())
        std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return (folder.path / name).string();
}

} // namespace sheet::test
