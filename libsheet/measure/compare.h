// SPDX-License-Identifier: GPL-3.0-or-later
// Are two frames the same, within tolerances?
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet {

// Two numbers a, b agree if |a - b| <= absolute or |a - b| <= relative max(|a|, |b|). 0 and -0 agree, so do any two
// NaN.
struct Tolerance {
  double absolute = 0; // in the array's unit
  double relative = 0;
};

struct CompareOptions {
  Tolerance floats;                        // of floating-point arrays and the time
  std::map<std::string, Tolerance> arrays; // by name, any numbers; "time" is the frame's time
  std::set<std::string> ignored;           // arrays, "time", "step"
};

// "NAME=ABS" or "NAME=ABS,REL" into `options`. Throws Error (usage).
void add_tolerance(CompareOptions& options, const std::string& text);

// A line each: what differs, where, how much. Arrays are compared by name; their order does not count. Empty: the
// frames agree.
[[nodiscard]] std::vector<std::string> compare(const formats::Frame& a, const formats::Frame& b,
                                               const CompareOptions& options);

} // namespace sheet
