// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/read_curve.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "libsheet/base/error.h"

namespace sheet::scene {
namespace {

constexpr std::size_t least_rows = 4, most_rows = 1000;

std::optional<Curve> read_curve_file(TableReader& table, const Files& files, const CurveKeys& keys) {
  table.has_no_meaning({keys.places, keys.values}, "the rows are those of the file");
  const std::string path = read_file(table, files, keys.file);
  if (!files.must_exist) {
    table.wrong(keys.file, fmt::format("rows by file need a scene that is a file; here they stand in the scene: {}, {}",
                                       keys.places, keys.values));
    return {};
  }
  if (!std::filesystem::is_regular_file(path)) // reported
    return {};
  try {
    const RowFile file = read_row_file(path, keys.columns, keys.header_example, most_rows,
                                       "every frame of a run carries them, and a spline goes through them");
    file.require(0);
    file.require(1);
    const std::string_view place = keys.columns[0].name, value = keys.columns[1].name;
    for (std::size_t i = 0; i < file.rows.size(); ++i) {
      if (!(file.rows[i][0] > 0) || !(file.rows[i][1] > 0))
        file.wrong(file.lines[i], fmt::format("a {} and a {} are positive", place, value));
      if (i > 0 && !(file.rows[i][0] > file.rows[i - 1][0]))
        file.wrong(file.lines[i], fmt::format("{} must increase from each row to the next", keys.places));
    }
    if (file.rows.size() < least_rows)
      file.wrong(file.header_line, "a table takes four rows or more");
    Curve curve;
    for (const std::vector<double>& row : file.rows) {
      curve.places.push_back(row[0]);
      curve.values.push_back(row[1]);
    }
    return curve;
  } catch (const Error& error) {
    table.wrong(keys.file, error.what());
    return {};
  }
}

std::optional<Curve> read_curve_lists(TableReader& table, const CurveKeys& keys) {
  Curve curve{table.list_or_missing(keys.places, Bound::positive,
                                    fmt::format("{}, or {} = \"curve.csv\"", keys.places_example, keys.file)),
              table.list_or_missing(keys.values, Bound::positive, keys.values_example)};
  if (curve.places.empty() || curve.values.empty())
    return {}; // reported
  if (curve.places.size() < least_rows)
    table.wrong(keys.places, "a table takes four rows or more");
  else if (curve.places.size() > most_rows)
    table.wrong(keys.places, fmt::format("a table takes at most {} rows", most_rows));
  else if (curve.values.size() != curve.places.size())
    table.wrong(keys.values,
                fmt::format("{} viscosities, but {} {}", curve.values.size(), curve.places.size(), keys.places));
  else if (std::ranges::adjacent_find(curve.places, std::greater_equal<>()) != curve.places.end())
    table.wrong(keys.places, "they must increase from each row to the next");
  else
    return curve;
  return {};
}

} // namespace

std::optional<Curve> read_curve(TableReader& table, const Files& files, const CurveKeys& keys) {
  return table.absent(keys.file) ? read_curve_lists(table, keys) : read_curve_file(table, files, keys);
}

} // namespace sheet::scene
