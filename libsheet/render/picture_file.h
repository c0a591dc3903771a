// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as files, and files as pictures. Everything is made in memory first.
#pragma once
#include <string>

#include "libsheet/render/image.h"

namespace sheet::render {

// RGB, or RGBA with straight alpha, 8 bits, marked as sRGB.
[[nodiscard]] std::string encode_png(const Bitmap& bitmap);

// R, G, B linear as half floats, with A those of the part that is covered, as EXR files have it; the layers as floats,
// if the picture has them: Z [m], normal.X, .Y, .Z, thickness [m], velocity.X, .Y, .Z [m/s], albedo.R, .G, .B and id
// (unsigned; image.h).
[[nodiscard]] std::string encode_exr(const Picture& picture);

// One picture of a binary PPM stream.
[[nodiscard]] std::string encode_ppm(const Bitmap& bitmap);

// A YUV4MPEG2 stream: its header, and one frame of it. 4:2:0, chroma in the middle of four pixels, limited range; the
// matrix is BT.709 from 1280 columns or 577 rows on, else BT.601, which is what players take.
[[nodiscard]] std::string y4m_header(int width, int height, double frames_per_second);
[[nodiscard]] std::string encode_y4m(const Bitmap& bitmap);

// A .png (sRGB), .exr or .hdr file as linear light. Throws Error (io, bad_input), naming the file.
[[nodiscard]] Image read_picture(const std::string& path);

} // namespace sheet::render
