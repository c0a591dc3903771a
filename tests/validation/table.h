// SPDX-License-Identifier: GPL-3.0-or-later
// Results as rows of tab-separated values, and back: settings to words, words to settings.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "tests/validation/case.h"

namespace sheet::validation {

using Words = std::map<std::string, std::string>; // option to word

// Sets one of set, edge, steps, scheme, thickness, bending, pattern, seed; fails with usage.
void assign(Settings& s, const std::string& option, const std::string& word);

[[nodiscard]] std::string header(bool times);
[[nodiscard]] std::string row(const Case& c, const Settings& s, const Result& r, bool times);
// The settings and the stored error of a row.
struct Stored {
  std::string name;
  Settings settings;
  double error = 0;
};
[[nodiscard]] std::vector<Stored> read_table(const std::string& path);

// Observed orders by halving the step twice, or the edge twice; the other is fixed. In time from differences of the
// value between step sizes, in space from its error, with the error in time extrapolated away.
struct Orders {
  double value[3], error[3], order;
};
[[nodiscard]] Orders time_order(const Case& c, Settings s);  // s.steps, twice, four times that
[[nodiscard]] Orders space_order(const Case& c, Settings s); // s.edge, half, a quarter of that

} // namespace sheet::validation
