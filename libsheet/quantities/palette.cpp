// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/palette.h"

#include <algorithm>

namespace sheet {
namespace {

constexpr std::array<PaletteStop, 7> amount_stops = {{{0.0F, {0.12F, 0.05F, 0.28F}},
                                                      {0.17F, {0.19F, 0.19F, 0.52F}},
                                                      {0.34F, {0.11F, 0.37F, 0.60F}},
                                                      {0.5F, {0.07F, 0.53F, 0.56F}},
                                                      {0.67F, {0.24F, 0.69F, 0.42F}},
                                                      {0.84F, {0.65F, 0.82F, 0.22F}},
                                                      {1.0F, {0.99F, 0.92F, 0.33F}}}};
constexpr std::array<PaletteStop, 5> two_sided_stops = {{{0.0F, {0.09F, 0.25F, 0.55F}},
                                                         {0.25F, {0.45F, 0.66F, 0.84F}},
                                                         {0.5F, {0.95F, 0.95F, 0.94F}},
                                                         {0.75F, {0.90F, 0.57F, 0.42F}},
                                                         {1.0F, {0.62F, 0.10F, 0.15F}}}};
constexpr std::array<PaletteKind, 3> contact_colours = {
    {{"free", {0.80F, 0.81F, 0.83F}}, {"on solid", {0.16F, 0.45F, 0.75F}}, {"on sheet", {0.86F, 0.33F, 0.16F}}}};

// Told apart by eyes that do not tell red from green, too [Okabe and Ito 2008].
constexpr std::array<PaletteKind, 8> colours_of_sheets = {{{"sheet 1", {0.90F, 0.62F, 0.00F}},
                                                           {"sheet 2", {0.34F, 0.71F, 0.91F}},
                                                           {"sheet 3", {0.00F, 0.62F, 0.45F}},
                                                           {"sheet 4", {0.94F, 0.89F, 0.26F}},
                                                           {"sheet 5", {0.00F, 0.45F, 0.70F}},
                                                           {"sheet 6", {0.84F, 0.37F, 0.00F}},
                                                           {"sheet 7", {0.80F, 0.47F, 0.65F}},
                                                           {"sheet 8", {0.35F, 0.35F, 0.35F}}}};

} // namespace

const Palette amounts{amount_stops};
const Palette two_sided{two_sided_stops, {}, true};
const Palette contact_kinds{{}, contact_colours};
const Palette sheet_colours{{}, colours_of_sheets};

DisplayedColour Palette::at(float place) const {
  if (has_kinds()) {
    const float last = static_cast<float>(kinds.size()) - 1;
    return kinds[static_cast<std::size_t>(std::clamp(place * static_cast<float>(kinds.size()), 0.0F, last))].colour;
  }
  std::size_t i = 1;
  while (i + 1 < stops.size() && place > stops[i].place)
    ++i;
  const PaletteStop &a = stops[i - 1], &b = stops[i];
  const float w = std::clamp((place - a.place) / (b.place - a.place), 0.0F, 1.0F);
  DisplayedColour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = (1 - w) * a.colour[k] + w * b.colour[k];
  return colour;
}

} // namespace sheet
