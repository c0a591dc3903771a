// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>

#include <png.h>

#include "libsheet/base/error.h"
#include "libsheet/render/codecs.h"
#include "libsheet/render/display.h"
#include "libsheet/render/picture_file.h"

namespace sheet::render {
namespace {

// libpng's simple interface; what it allocated is freed whatever happens.
struct Png {
  png_image image;
  Png() {
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
  }
  ~Png() { png_image_free(&image); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

} // namespace

std::string encode_png(const Bitmap& bitmap) {
  Png png;
  png.image.width = static_cast<png_uint_32>(bitmap.width);
  png.image.height = static_cast<png_uint_32>(bitmap.height);
  std::vector<std::uint8_t> with_alpha;
  for (std::size_t i = 0; i < bitmap.alpha.size(); ++i) {
    with_alpha.insert(with_alpha.end(), &bitmap.bytes[3 * i], &bitmap.bytes[3 * i] + 3);
    with_alpha.push_back(bitmap.alpha[i]);
  }
  png.image.format = with_alpha.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
  std::string bytes(size, '\0');
  const std::vector<std::uint8_t>& values = with_alpha.empty() ? bitmap.bytes : with_alpha;
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, values.data(), 0, nullptr) == 0)
    fail(ExitCode::internal, "libpng: {}", png.image.message);
  bytes.resize(size);
  return bytes;
}

Image decode_png(const std::string& bytes, const std::string& name) {
  Png png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0)
    fail(ExitCode::bad_input, "{}: not a PNG image that can be read: {}", name, png.image.message);
  if (png.image.width > longest_side || png.image.height > longest_side)
    fail(ExitCode::bad_input, "{}: {} x {} pixels are too many: at most {} a side", name, png.image.width,
         png.image.height, longest_side);
  png.image.format = PNG_FORMAT_RGB;
  std::string values(PNG_IMAGE_SIZE(png.image), '\0');
  if (png_image_finish_read(&png.image, nullptr, values.data(), 0, nullptr) == 0)
    fail(ExitCode::bad_input, "{}: not a PNG image that can be read: {}", name, png.image.message);
  Image image(static_cast<int>(png.image.width), static_cast<int>(png.image.height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][static_cast<Eigen::Index>(c)] =
          decode_srgb(static_cast<float>(static_cast<unsigned char>(values[3 * i + c])) / 255);
  return image;
}

} // namespace sheet::render
