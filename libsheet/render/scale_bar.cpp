// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/scale_bar.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "libsheet/quantities/scaled_unit.h"
#include "libsheet/render/font.h"

namespace sheet::render {
namespace {

constexpr Ink dark = {40, 44, 52};

// In pixels of the font: between what is written and the picture's edge, and what stands before it; the widest scale
// (a bar, its ticks and "-1.2e-06"; the title's words are narrower); a line of text.
constexpr int edge = 12, gap = 6, widest = 63, line = 11;
constexpr std::size_t longest_label = 8;
// Of the picture that the scale may take away.
constexpr double most_width = 0.3;
constexpr int least_height = 11 * line;

int font_size(int width, int height) { return std::max(1, std::min(width, height) / 320); }

// As fonts have it, from UTF-8: all signs of units are in Latin-1.
std::string latin1(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    out += c < 0x80 ? text[i] : static_cast<char>((c & 0x03) << 6 | (static_cast<unsigned char>(text[++i]) & 0x3f));
  }
  return out;
}

std::uint8_t byte_of(float x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0F, 1.0F))); }
Ink ink_of(const Colour& displayed) { return {byte_of(displayed[0]), byte_of(displayed[1]), byte_of(displayed[2])}; }

void draw_key(Bitmap& bitmap, int text, int x, const Palette& palette) {
  int y = edge * text;
  for (const PaletteKind& kind : palette.kinds) {
    fill(bitmap, x, y, 7 * text, 7 * text, ink_of({kind.colour[0], kind.colour[1], kind.colour[2]}));
    write_text(bitmap, x + 12 * text, y, std::string(kind.name), text, dark);
    y += 14 * text;
  }
}

// No longer than there is room for.
std::string label_of(double value, int decimals) {
  std::string label = fmt::format("{:.{}f}", value, decimals);
  return label.size() <= longest_label ? label : fmt::format("{:.2g}", value);
}

} // namespace

Ruler make_ruler(const Scale& scale, const Field& field, int most) {
  const ScaledUnit unit = fitting_unit(field.unit, std::max(std::abs(scale.low), std::abs(scale.high)));
  const double low = scale.low / unit.size, high = scale.high / unit.size, raw = (high - low) / most;
  const double decade = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * decade;
  for (const double round : {5.0, 2.0, 1.0})
    if (round * decade >= raw)
      step = round * decade;
  Ruler ruler{unit.name.empty() ? std::string(field.caption) : fmt::format("{} [{}]", field.caption, latin1(unit.name)),
              {}};
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ruler.ticks.push_back({(k * step - low) / (high - low), label_of(k * step + 0.0, decimals)});
  return ruler;
}

bool has_room_for_scale(int width, int height) {
  return scale_width(width, height) <= most_width && height >= least_height;
}

double scale_width(int width, int height) {
  return static_cast<double>((gap + widest + edge) * font_size(width, height)) / width;
}

double clock_height(int width, int height) {
  return has_room_for_scale(width, height)
             ? static_cast<double>((gap + line + edge) * font_size(width, height)) / height
             : 0;
}

void draw_scale(Bitmap& bitmap, const Scale& scale, Look look, double time) {
  if (!has_room_for_scale(bitmap.width, bitmap.height))
    return;
  const int text = font_size(bitmap.width, bitmap.height), margin = edge * text,
            x0 = bitmap.width - margin - widest * text;
  constexpr double year = 31557600; // as units.h has it
  const std::string clock = time < year ? fmt::format("t = {:.4g} s", time) : fmt::format("t = {:.4g} a", time / year);
  write_text(bitmap, margin, bitmap.height - margin - 7 * text, clock, text, dark);
  if (!look.has_scale())
    return;
  const Palette& palette = look.field->palette;
  if (palette.has_kinds()) {
    draw_key(bitmap, text, x0, palette);
    return;
  }
  const int bar = 10 * text, most_lines = 3, y0 = margin + most_lines * line * text,
            height = bitmap.height - y0 - margin;
  const Ruler ruler = make_ruler(scale, *look.field, std::max(2, height / (24 * text)));
  int y = margin;
  std::istringstream words(ruler.title); // one below the other
  for (std::string word; words >> word; y += line * text)
    write_text(bitmap, x0, y, word, text, dark);
  fill(bitmap, x0 - 1, y0 - 1, bar + 2, height + 2, dark);
  for (int row = 0; row < height; ++row)
    fill(bitmap, x0, y0 + row, bar, 1,
         ink_of(false_colour(1 - (static_cast<float>(row) + 0.5F) / static_cast<float>(height), palette)));
  for (const Tick& tick : ruler.ticks) {
    const int row = y0 + static_cast<int>(std::lround((1 - tick.place) * (height - 1)));
    fill(bitmap, x0 + bar, row, 3 * text, 1, dark);
    write_text(bitmap, x0 + bar + 5 * text, row - 3 * text, tick.label, text, dark);
  }
}

} // namespace sheet::render
