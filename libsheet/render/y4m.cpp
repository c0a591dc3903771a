// SPDX-License-Identifier: GPL-3.0-or-later
// RGB to Y'CbCr in 8 bits [ITU-R BT.601, BT.709]: Y' in 16 to 235, Cb and Cr in 16 to 240.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "libsheet/render/picture_file.h"

namespace sheet::render {
namespace {

struct Matrix {
  double red, blue; // their part of Y'
};

Matrix matrix_for(const Bitmap& bitmap) {
  return bitmap.width >= 1280 || bitmap.height > 576 ? Matrix{0.2126, 0.0722} : Matrix{0.299, 0.114};
}

char byte(double x) { return static_cast<char>(static_cast<unsigned char>(std::lround(x))); }

} // namespace

std::string y4m_header(int width, int height, double frames_per_second) {
  const bool whole = std::floor(frames_per_second) == frames_per_second;
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420jpeg\n", width, height,
                     std::llround(whole ? frames_per_second : 1000 * frames_per_second), whole ? 1 : 1000);
}

std::string encode_y4m(const Bitmap& bitmap) {
  const Matrix m = matrix_for(bitmap);
  const auto rgb = [&](int x, int y, int c) {
    const auto pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(bitmap.width) + static_cast<std::size_t>(x);
    return bitmap.bytes[3 * pixel + static_cast<std::size_t>(c)] / 255.0;
  };
  std::string bytes = "FRAME\n";
  for (int y = 0; y < bitmap.height; ++y)
    for (int x = 0; x < bitmap.width; ++x)
      bytes += byte(16 + 219 * (m.red * rgb(x, y, 0) + (1 - m.red - m.blue) * rgb(x, y, 1) + m.blue * rgb(x, y, 2)));
  for (const int c : {2, 0}) { // Cb, Cr
    const double part = c == 2 ? m.blue : m.red;
    for (int y = 0; y < bitmap.height; y += 2)
      for (int x = 0; x < bitmap.width; x += 2) {
        double sum = 0;
        for (const int dy : {0, 1})
          for (const int dx : {0, 1}) {
            const int i = std::min(x + dx, bitmap.width - 1), j = std::min(y + dy, bitmap.height - 1);
            const double luma = m.red * rgb(i, j, 0) + (1 - m.red - m.blue) * rgb(i, j, 1) + m.blue * rgb(i, j, 2);
            sum += (rgb(i, j, c) - luma) / (2 * (1 - part));
          }
        bytes += byte(128 + 224 * sum / 4);
      }
  }
  return bytes;
}

} // namespace sheet::render
