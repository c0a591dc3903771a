// SPDX-License-Identifier: GPL-3.0-or-later
// What can be wrong with a run: each kind of trouble with its name, from when on it is worth a word, when it is
// serious, and what a user can do.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace sheet::health {

// The numbers stand in frames (formats/sheet.md, section 5): they are never given to another kind.
enum class Trouble : std::uint8_t {
  thin = 1,
  sharp = 2,
  coarse_fold = 3,
  coarse_solid = 4,
  short_steps = 5,
  held_back = 6,
  close_to_solid = 7,
  not_converged = 8,
  above_tolerance = 9,
  edits_due = 10,
  crumbs = 11,
  volume = 12,
  two_solids = 13,
  crushed = 14,
  gas_escapes = 15,
  threads = 16,
};

// From where on trouble counts: all three must be reached.
struct Limit {
  double worst;        // the worst value is this or worse
  double share;        // it has been on this share of the sheet's area (0: it has no area, or any will do)
  std::uint64_t times; // it has been seen this often
  double of_steps = 0; // and in this share of all steps
};

// How a value is told.
enum class Told : std::uint8_t { plainly, in_percent };

struct Kind {
  Trouble trouble;
  std::string_view name;
  bool least;               // the worst value is the least one, else the greatest
  Told told;                // its value
  std::string_view what;    // a sentence about the worst value, which stands for {}
  std::string_view counted; // what the sum of amounts counts; "": amounts mean nothing
  Limit noted, serious;
  std::string_view remedy;
};

// In the order of their numbers.
[[nodiscard]] std::span<const Kind> kinds();
[[nodiscard]] const Kind& kind_of(Trouble trouble);
// Null for a number that this version does not know.
[[nodiscard]] const Kind* find_kind(double number);

} // namespace sheet::health
