// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/row_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/scene/problems.h"

namespace sheet::scene {

namespace {

std::string_view trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && blank(text.back()))
    text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos)
      return cells;
    line.remove_prefix(comma + 1);
  }
}

// Nothing of a text that is not one number and no more.
std::optional<double> number_in(std::string_view cell) {
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data() + cell.starts_with('+'), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

class RowReader {
public:
  RowReader(const std::string& path, std::span<const RowColumn> columns, std::size_t most, std::string_view too_many)
      : most_(most), too_many_(too_many) {
    file_.path = path;
    file_.columns = columns;
    file_.present.assign(columns.size(), false);
  }

  RowFile read(std::string_view example) {
    std::istringstream text(read_utf8_file(file_.path, std::size_t{1} << 26));
    for (std::string line; std::getline(text, line);) {
      ++line_;
      const std::string_view content = trim(line);
      if (content.empty() || content.front() == '#')
        continue;
      if (there_.empty())
        read_header(content, example);
      else
        read_row(content);
    }
    if (there_.empty())
      wrong("it holds no rows; the first line names the columns, such as {}", example);
    return std::move(file_);
  }

private:
  struct Column {
    std::size_t index;
    double unit, zero; // in SI; zero: of its scale, which is not 0 in degC
  };

  template <class... Args> [[noreturn]] void wrong(fmt::format_string<Args...> reason, Args&&... args) const {
    file_.wrong(line_, fmt::format(reason, std::forward<Args>(args)...));
  }

  // "x [mm]"
  Column read_column(std::string_view cell) {
    const std::size_t bracket = cell.find('[');
    const std::string_view name = trim(cell.substr(0, bracket));
    const auto known = std::ranges::find(file_.columns, name, &RowColumn::name);
    if (known == file_.columns.end()) {
      std::vector<std::string_view> names;
      for (const RowColumn& column : file_.columns)
        names.push_back(column.name);
      wrong("unknown column \"{}\"{}", name.substr(0, 60), suggestion(name, names));
    }
    const auto index = static_cast<std::size_t>(known - file_.columns.begin());
    if (file_.present[index])
      wrong("column \"{}\" stands there twice", name);
    file_.present[index] = true;
    if (bracket == std::string_view::npos)
      return {index, 1, 0};
    if (cell.back() != ']')
      wrong("column \"{}\": a unit stands in brackets, such as {} [{}]", cell.substr(0, 60), name, known->kind.unit);
    const std::string_view unit = trim(cell.substr(bracket + 1, cell.size() - bracket - 2));
    std::string problem;
    const auto value_of = [&](int number) {
      const auto value = read_quantity(fmt::format("{} {}", number, unit == "1" ? "" : unit), known->kind, problem);
      if (!value)
        wrong("column \"{}\": {}", name, problem);
      return *value;
    };
    const double zero = value_of(0);
    return {index, value_of(1) - zero, zero};
  }

  void read_header(std::string_view line, std::string_view example) {
    file_.header_line = line_;
    if (line.find(',') == std::string_view::npos && line.find_first_of(";\t") != std::string_view::npos)
      wrong("columns are separated by commas, not by {}; numbers have a decimal point",
            line.find(';') != std::string_view::npos ? "semicolons" : "tabs");
    if (number_in(cells_of(line).front()))
      wrong("the first line names the columns, such as {}", example);
    for (const std::string_view cell : cells_of(line))
      there_.push_back(read_column(cell));
  }

  void read_row(std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != there_.size())
      wrong("{} values, but the first line names {} columns", cells.size(), there_.size());
    std::vector<double> values(file_.columns.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_in(cells[i]);
      values[there_[i].index] = value.value_or(0) * there_[i].unit + there_[i].zero;
      if (!value || !std::isfinite(values[there_[i].index]))
        wrong("column \"{}\": \"{}\" is not a finite number", file_.columns[there_[i].index].name,
              cells[i].substr(0, 60));
    }
    if (file_.rows.size() == most_)
      wrong("more than {} rows: {}", most_, too_many_);
    file_.rows.push_back(std::move(values));
    file_.lines.push_back(line_);
  }

  std::size_t most_;
  std::string_view too_many_;
  RowFile file_;
  std::size_t line_ = 0;
  std::vector<Column> there_;
};

} // namespace

void RowFile::require(std::size_t column) const {
  if (!has(column))
    wrong(header_line, fmt::format("column \"{}\" is missing", columns[column].name));
}

void RowFile::wrong(std::size_t line, std::string_view reason) const {
  fail(ExitCode::bad_input, "{}:{}: {}", path, std::max<std::size_t>(line, 1), reason);
}

RowFile read_row_file(const std::string& path, std::span<const RowColumn> columns, std::string_view example,
                      std::size_t most, std::string_view too_many) {
  return RowReader(path, columns, most, too_many).read(example);
}

} // namespace sheet::scene
