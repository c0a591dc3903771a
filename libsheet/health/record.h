// SPDX-License-Identifier: GPL-3.0-or-later
// The frame's array `health` (formats/sheet.md, section 5): a row for each kind of trouble that its run has seen, so
// that a run that is gone on with goes on counting.
#pragma once
#include <optional>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"
#include "libsheet/health/trouble.h"

namespace sheet::health {

// Trouble in one frame.
struct Observation {
  Trouble trouble;
  double value;                      // the worst one: a ratio, an angle [degrees], a number (trouble.cpp)
  double share = 0;                  // of the sheet's area that has it
  double amount = 0;                 // vertices, triangles, m^3 that have it
  std::optional<Vector3> place = {}; // of the worst [m]
};

// What a run has seen of a kind so far. Times in s, place in m.
struct Row {
  double kind = 0, times = 0, first = 0, last = 0;
  double worst = 0, worst_time = 0;  // the worst value
  double share = 0;                  // the greatest
  std::optional<Vector3> place = {}; // of the worst value
  double amount = 0;                 // sum of all
};

// Adds it to the frame's row of its kind, with the frame's time. Errors: bad_input where `health` is something else.
void note(formats::Frame& frame, const Observation& observation);

// In the order of kinds; rows of kinds that are not known, too. Empty if the frame has none.
[[nodiscard]] std::vector<Row> rows(const formats::Frame& frame);

enum class Verdict { slight, noted, serious };
// steps: of the run so far.
[[nodiscard]] Verdict verdict(const Row& row, std::uint64_t steps);

} // namespace sheet::health
