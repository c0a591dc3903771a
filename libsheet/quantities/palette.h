// SPDX-License-Identifier: GPL-3.0-or-later
// Which colours stand for which values, in pictures and pages alike.
#pragma once
#include <array>
#include <span>
#include <string_view>

namespace sheet {

using DisplayedColour = std::array<float, 3>; // sRGB as displayed, 0 to 1

struct PaletteStop {
  float place; // on the scale, 0 to 1
  DisplayedColour colour;
};
struct PaletteKind {
  std::string_view name; // beside its field of the key
  DisplayedColour colour;
};

// Either stops, between which colours change evenly, or kinds: the value 0, 1, ... is the kind's number.
struct Palette {
  std::span<const PaletteStop> stops;
  std::span<const PaletteKind> kinds = {};
  bool symmetric = false; // about the value 0, which is in the middle of the scale

  [[nodiscard]] bool has_kinds() const { return !kinds.empty(); }
  // The colour at a place of the scale, 0 to 1, each kind having an equal part of it.
  [[nodiscard]] DisplayedColour at(float place) const;
};

extern const Palette amounts;   // dark to light: the luminance rises evenly
extern const Palette two_sided; // blue, white, red
extern const Palette contact_kinds;
extern const Palette sheet_colours; // a kind for each of the first eight sheets of a scene (sheet_kinds.h)

} // namespace sheet
