// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/picture_file.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/named_files.h"
#include "libsheet/render/codecs.h"

namespace sheet::render {

std::string encode_ppm(const Bitmap& bitmap) {
  std::string bytes = fmt::format("P6\n{} {}\n255\n", bitmap.width, bitmap.height);
  bytes.append(reinterpret_cast<const char*>(bitmap.bytes.data()), bitmap.bytes.size());
  return bytes;
}

Image read_picture(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".png" && ending != ".exr")
    fail(ExitCode::usage, "{}: an image of the surroundings must be a .png or .exr file", path);
  check_named_file(path);
  const std::string bytes = read_text_file(path);
  Image image = ending == ".png" ? decode_png(bytes, path) : decode_exr(bytes, path);
  for (Colour& c : image.pixels)
    for (float& x : c)
      x = x > 0 && std::isfinite(x) ? x : 0; // no light is negative or without bound
  return image;
}

void write_whole(const std::string& path, const std::string& bytes) {
  const std::filesystem::path target(path), folder = target.parent_path();
  std::error_code error;
  if (!folder.empty()) {
    std::filesystem::create_directories(folder, error);
    if (error)
      fail(ExitCode::io, "cannot make the folder {}: {}", folder.string(), error.message());
  }
  if (std::filesystem::is_directory(target))
    fail(ExitCode::io, "cannot write {}: it is a folder", path);
  claim_file(path, FileRole::output);
  const std::string part = (folder / fmt::format(".{}.part", target.filename().string())).string();
  try {
    OutputFile file(part, OutputFile::Content::binary);
    file.write(bytes);
    file.close();
    if (std::rename(part.c_str(), path.c_str()) != 0)
      fail(ExitCode::io, "cannot rename {} to {}: {}", part, path, std::strerror(errno));
  } catch (...) {
    std::filesystem::remove(part, error);
    throw;
  }
  release_file(path, FileRole::output);
}

} // namespace sheet::render
