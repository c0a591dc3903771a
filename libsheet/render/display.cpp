// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/display.h"

#include <algorithm>
#include <cmath>

namespace sheet::render {

float shoulder(float x) {
  constexpr float joint = 0.6F;
  return x <= joint ? x : joint + (1 - joint) * (1 - std::exp(-(x - joint) / (1 - joint)));
}

float filmic(float x) {
  if (!(x < 1e6F)) // the squares of more are without bound
    return 1;
  return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

float encode_srgb(float x) {
  x = std::clamp(x, 0.0F, 1.0F);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

float decode_srgb(float x) { return x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F); }

float display_level(float x) { return 255 * encode_srgb(shoulder(x)); }

Bitmap to_bitmap(const Picture& picture, Tone tone) {
  const Image& image = picture.light;
  Bitmap bitmap(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Colour& light = image.pixels[i];
    float covered = 1;
    if (!picture.alpha.empty()) {
      covered = std::clamp(light.maxCoeff(), std::clamp(picture.alpha[i], 0.0F, 1.0F), 1.0F);
      bitmap.alpha.push_back(static_cast<std::uint8_t>(std::lround(255 * covered)));
    }
    for (int c = 0; c < 3; ++c) {
      const float x = covered > 0 ? light[c] / covered : 0;
      const float shown = tone == Tone::shoulder ? shoulder(x) : tone == Tone::filmic ? filmic(x) : x;
      bitmap.bytes[3 * i + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(std::lround(255 * encode_srgb(shown)));
    }
  }
  return bitmap;
}

} // namespace sheet::render
