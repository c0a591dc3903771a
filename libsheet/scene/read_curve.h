// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve: rows of a place and a positive value there, as two lists in the scene or as a CSV file beside it.
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "libsheet/scene/row_file.h"
#include "libsheet/scene/tables.h"

namespace sheet::scene {

struct CurveKeys {
  std::string_view places, values, file;           // keys of the table
  std::string_view places_example, values_example; // of lists, for messages
  std::array<RowColumn, 2> columns;                // of the file
  std::string_view header_example;                 // its first line
};

struct Curve {
  std::vector<double> places, values; // four or more, positive; places increasing
};

// Nothing if it is wrong, which is reported.
[[nodiscard]] std::optional<Curve> read_curve(TableReader& table, const Files& files, const CurveKeys& keys);

} // namespace sheet::scene
