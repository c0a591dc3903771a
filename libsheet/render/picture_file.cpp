// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/picture_file.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "libsheet/base/error.h"
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
  if (ending != ".png" && ending != ".exr" && ending != ".hdr")
    fail(ExitCode::usage, "{}: an image of the surroundings must be a .hdr, .exr or .png file", path);
  check_named_file(path);
  const std::string bytes = read_text_file(path);
  Image image = ending == ".png"   ? decode_png(bytes, path)
                : ending == ".exr" ? decode_exr(bytes, path)
                                   : decode_hdr(bytes, path);
  for (Colour& c : image.pixels)
    for (float& x : c)
      x = x > 0 && std::isfinite(x) ? x : 0; // no light is negative or without bound
  return image;
}

} // namespace sheet::render
