// SPDX-License-Identifier: GPL-3.0-or-later
// "Did you mean ...?": the nearest of some known words.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>

namespace sheet {

// Number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
// (optimal string alignment distance [Damerau 1964]).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The first of the known words that are nearest to `word`, or "" if none is near: more than a third of its letters (at
// least 2) would have to change. A word of more than 100 bytes is near to none.
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

} // namespace sheet
