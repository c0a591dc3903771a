// SPDX-License-Identifier: GPL-3.0-or-later
// Writing on pictures: a small fixed font of our own, lower case, digits and what units need.
#pragma once
#include <array>
#include <string_view>

#include "libsheet/render/image.h"

namespace sheet::render {

using Ink = std::array<std::uint8_t, 3>;

// Latin-1 text (\xb5 is the micro sign) with its upper left corner at (x, y), characters 5 x 7 times `scale` pixels and
// one more between them, plus two rows below the line. Characters that the font does not have are blank. What lies
// outside of the picture is cut off, here and in fill.
void write_text(Bitmap& bitmap, int x, int y, std::string_view text, int scale, const Ink& ink);
[[nodiscard]] int text_width(std::string_view text, int scale);

void fill(Bitmap& bitmap, int x, int y, int width, int height, const Ink& ink);

} // namespace sheet::render
