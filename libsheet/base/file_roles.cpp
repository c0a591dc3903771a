// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/file_roles.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

// A regular file, or the place of one that does not exist yet: its folder and name.
struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name; // "" for a file that exists
  friend bool operator==(const Identity&, const Identity&) = default;
};

struct Claim {
  Identity identity;
  std::string path;
  FileRole role;
};

std::vector<Claim>& claims() {
  static std::vector<Claim> the_claims;
  return the_claims;
}

std::optional<Identity> identity_of(const struct stat& status) {
  if (!S_ISREG(status.st_mode))
    return std::nullopt;
  return Identity{status.st_dev, status.st_ino, ""};
}

std::optional<Identity> identity_of(const std::string& path, FileRole role) {
  struct stat status {};
  if (path == "-")
    return ::fstat(role == FileRole::input ? STDIN_FILENO : STDOUT_FILENO, &status) == 0 ? identity_of(status)
                                                                                         : std::nullopt;
  if (::stat(path.c_str(), &status) == 0)
    return identity_of(status);
  const std::filesystem::path place(path);
  const std::string folder = place.has_parent_path() ? place.parent_path().string() : ".";
  if (::stat(folder.c_str(), &status) != 0)
    return std::nullopt;
  return Identity{status.st_dev, status.st_ino, place.filename().string()};
}

std::string spoken(const std::string& path, FileRole role) {
  return path != "-" ? path : role == FileRole::input ? "standard input" : "standard output";
}

} // namespace

void claim_file(const std::string& path, FileRole role) {
  const auto identity = identity_of(path, role);
  if (!identity)
    return;
  // A file that was deleted may have left its inode to another one: such claims are void.
  std::erase_if(claims(),
                [&](const Claim& c) { return c.identity == *identity && identity_of(c.path, c.role) != c.identity; });
  for (const Claim& c : claims()) {
    if (c.identity == *identity && c.path == path && c.role == role && role == FileRole::input)
      return; // it is read once more
    if (c.identity != *identity || (c.role == FileRole::input && role == FileRole::input))
      continue;
    const std::string name = spoken(path, role), other = spoken(c.path, c.role);
    fail(ExitCode::usage, "{} is {} at once{}: choose another output", name,
         c.role == role ? "output twice" : "input and output",
         name == other ? "" : fmt::format(" (it is the same file as {})", other));
  }
  claims().push_back({*identity, path, role});
}

void release_file(const std::string& path, FileRole role) {
  std::erase_if(claims(), [&](const Claim& c) { return c.role == role && c.path == path; });
}

} // namespace sheet
