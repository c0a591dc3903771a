// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures in memory, row by row from the upper left.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/render/types.h"

namespace sheet::render {

struct Image {
  int width = 0, height = 0;
  std::vector<Colour> pixels; // linear
  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  Colour& at(int x, int y) { return pixels[index(x, y)]; }
  [[nodiscard]] const Colour& at(int x, int y) const { return pixels[index(x, y)]; }
};

// What the middle of each pixel hits first.
struct Layers {
  std::vector<float> depth;     // along the view axis [m]; infinite: nothing
  std::vector<Vec> normal;      // smoothed, towards the camera; 0: nothing
  std::vector<float> thickness; // of the sheet [m]; 0: not the sheet
  std::vector<std::uint32_t> id;
  std::vector<Vec> velocity;  // [m/s]; 0: nothing
  std::vector<Colour> albedo; // what comes back of even light from all sides; 0: nothing
};
// Values of Layers::id; the scene's i-th solid has first_solid_id + i.
inline constexpr std::uint32_t nothing_id = 0, sheet_id = 1, ground_id = 2, first_solid_id = 3;

struct Picture {
  Image light;              // linear radiance
  std::vector<float> alpha; // of each pixel the part that is covered, for which alone `light` is; empty: all of it
  Layers layers;
  float noise = 0;       // standard error of a pixel's luminance as displayed, root mean square, of 255
  float worst_noise = 0; // the same of the worst tile
  double samples = 0;    // a pixel, on average
  std::uint64_t rays = 0;
};

// As displays want it: sRGB, 8 bits, three bytes a pixel.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> alpha; // straight: the bytes are not multiplied with it; empty: opaque
  Bitmap(int w, int h) : width(w), height(h), bytes(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] std::uint8_t* pixel(int x, int y) {
    return bytes.data() +
           3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

} // namespace sheet::render
