// SPDX-License-Identifier: GPL-3.0-or-later
// A CSV file of rows of numbers beside a scene. Its first line names the columns, each with its unit in brackets or in
// SI, as in "time [s], x [mm]"; blank lines and those that begin with # do not count.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/base/units.h"

namespace sheet::scene {

struct RowColumn {
  std::string_view name;
  const Quantity& kind;
};

struct RowFile {
  std::string path;
  std::span<const RowColumn> columns;    // that there may be
  std::vector<bool> present;             // which of them there are
  std::vector<std::vector<double>> rows; // a number for each column that there may be, in SI; 0 where it is not there
  std::vector<std::size_t> lines;        // of the rows, in the file
  std::size_t header_line = 1;

  [[nodiscard]] bool has(std::size_t column) const { return present[column]; }
  // Throws Error (bad_input) if it is not there.
  void require(std::size_t column) const;
  // Throws Error (bad_input), naming file and line.
  [[noreturn]] void wrong(std::size_t line, std::string_view reason) const;
};

// `example`: a first line, for messages; `too_many`: why no more than `most` rows are taken. Throws Error (bad_input,
// io), naming file and line.
[[nodiscard]] RowFile read_row_file(const std::string& path, std::span<const RowColumn> columns,
                                    std::string_view example, std::size_t most, std::string_view too_many);

} // namespace sheet::scene
