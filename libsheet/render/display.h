// SPDX-License-Identifier: GPL-3.0-or-later
// From linear light to what a display shows: exposure, a curve of tones that takes highlights to white without
// clipping, and the transfer function of sRGB.
#pragma once
#include <cstdint>

#include "libsheet/render/image.h"

namespace sheet::render {

// Each channel by itself: x up to 0.6, above it 0.6 + 0.4 (1 - exp(-(x - 0.6) / 0.4)), smooth at the joint. So all but
// highlights are shown true.
[[nodiscard]] float shoulder(float x);
// Linear [0, 1] to sRGB [0, 1] and back [IEC 61966-2-1].
[[nodiscard]] float encode_srgb(float x);
[[nodiscard]] float decode_srgb(float x);
// 0 to 255, not rounded; photographic.
[[nodiscard]] float display_level(float x);

// Each channel by itself: contrast as of film, dark and bright rolled off: x (2.51 x + 0.03) / (x (2.43 x + 0.59) +
// 0.14) [Narkowicz 2015, a fit of the Academy's curve, ACES].
[[nodiscard]] float filmic(float x);

// What becomes of linear light before the transfer function.
enum class Tone {
  shoulder,
  filmic,
  linear, // clipped at 1
};
// The curve of tones is that of what covers a pixel; where that throws back more light than its part of the pixel can
// show, as a highlight on glass does, the part grows.
[[nodiscard]] Bitmap to_bitmap(const Picture& picture, Tone tone);

} // namespace sheet::render
