// SPDX-License-Identifier: GPL-3.0-or-later
// What goes before toml++ 3.3, which cannot bear any text: its recursions exhaust the stack on a long dotted key, and
// its tables of characters know no answer for many that are not ASCII (found by tests/fuzz/scene.cpp).
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sheet::scene {

// A TOML text in ASCII: without comments, other characters of its texts as escapes, no text over several lines, no long
// dotted key. Lines are those of the original.
struct AsciiToml {
  struct Escape {
    int line, column; // in `text`
    int extra;        // characters more than the one that it stands for
  };
  std::string text;
  std::vector<Escape> escapes; // in the order of the text

  // The column in the original of a place in `text`.
  [[nodiscard]] int original_column(int line, int column) const;
};

// Throws Error (bad_input), "name:line:column: reason".
[[nodiscard]] AsciiToml to_ascii(std::string_view text, std::string_view name);

} // namespace sheet::scene
