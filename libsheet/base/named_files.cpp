// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/named_files.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

#include <sys/stat.h>
#include <xxhash.h>

#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"

namespace sheet {

namespace fs = std::filesystem;

namespace {

// Of a relative name, without 0, 1, ... of its leading folders; of an absolute one, itself.
std::vector<fs::path> endings_of(const fs::path& name) {
  if (name.is_absolute())
    return {name};
  std::vector<fs::path> endings;
  for (auto first = name.begin(); first != name.end(); ++first) {
    fs::path& ending = endings.emplace_back();
    for (auto part = first; part != name.end(); ++part)
      ending /= *part;
  }
  return endings;
}

// Where streams are that are read, absolute.
std::vector<fs::path>& stream_folders() {
  static std::vector<fs::path> folders = [] {
    std::vector<fs::path> told;
    for (const char* variable : {stream_folder_variable, scene_folder_variable})
      if (const char* folder = std::getenv(variable); folder != nullptr)
        told.emplace_back(folder);
    return told;
  }();
  return folders;
}

// A file of this name and checksum ("": any) is looked for.
struct Search {
  std::string name, checksum;
  std::string other = {}; // the first of its name that is another

  // From a folder, and from each one above; `as_told` is how that folder is told, "": not at all.
  std::optional<std::string> upwards_from(fs::path folder, fs::path as_told) {
    std::error_code error;
    for (; true; folder = folder.parent_path(), as_told /= "..") {
      for (const fs::path& ending : endings_of(name)) {
        const std::string path = (as_told / ending).string();
        if (!fs::is_regular_file(path, error))
          continue;
        if (checksum.empty() || checksum_of_file(path) == checksum)
          return path;
        if (other.empty())
          other = path;
      }
      if (folder == folder.parent_path())
        return {};
    }
  }
};

} // namespace

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

std::string checksum_of_file(const std::string& path) {
  check_named_file(path);
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::array<char, 1 << 16> part{};
  while (file.read(part.data(), part.size()) || file.gcount() > 0)
    XXH3_64bits_update(state.get(), part.data(), static_cast<std::size_t>(file.gcount()));
  if (!file.eof())
    fail(ExitCode::io, "{}: it cannot be read", path);
  return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

void look_beside(const std::string& stream) {
  std::error_code error;
  const fs::path folder = fs::absolute(stream, error).parent_path();
  if (!error && std::ranges::find(stream_folders(), folder) == stream_folders().end())
    stream_folders().push_back(folder);
}

std::string find_named_file(const std::string& name, const std::string& checksum) {
  if (checksum.empty())
    return name;
  Search search{.name = name, .checksum = checksum};
  if (const auto found = search.upwards_from(fs::current_path(), {}))
    return *found;
  for (const fs::path& folder : stream_folders())
    if (const auto found = search.upwards_from(folder, folder))
      return *found;
  if (!search.other.empty())
    fail(ExitCode::bad_input,
         "{}: it has changed since sheet-init ran (its checksum is {}, the scene says {}): bring the old one back, or "
         "make the first frame anew",
         search.other, checksum_of_file(search.other), checksum);
  check_named_file(name);
  fail(ExitCode::io,
       "{}: there is no such file, neither as seen from here, from the stream's folder or from one above, nor without "
       "its folders",
       name);
}

std::optional<std::string> find_by_name(const std::string& name) {
  Search search{.name = name, .checksum = {}};
  for (const fs::path& folder : stream_folders())
    if (auto found = search.upwards_from(folder, folder))
      return found;
  return search.upwards_from(fs::current_path(), {});
}

formats::MeshImport import_named_mesh(const std::string& path, formats::WantedArrays arrays) try {
  check_named_file(path);
  return formats::import_mesh(path, arrays);
} catch (const formats::MeshFileError& error) {
  fail(error.kind() == formats::MeshFileError::Kind::io ? ExitCode::io : ExitCode::bad_input, "{}", error.what());
}

} // namespace sheet
