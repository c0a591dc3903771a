// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a motion: lists in the scene, or a CSV file beside it.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/scene/tables.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

using Eigen::Quaterniond;

constexpr std::array<std::string_view, 8> column_names{"time", "x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr double norm_tolerance = 1e-3;
constexpr double widest_turn = 175 * std::numbers::pi / 180; // beyond it, rounding decides which way round

struct Rows {
  std::vector<double> times;
  std::vector<Vector3d> places;
  std::vector<Quaterniond> rotations;
  std::vector<std::size_t> lines; // of a file
};

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

// A CSV file of rows. Throws Error (bad_input), naming file and line.
class RowFile {
public:
  explicit RowFile(const std::string& path) : path_(path) {}

  Rows read() {
    std::istringstream text(read_utf8_file(path_, std::size_t{1} << 26));
    for (std::string line; std::getline(text, line);) {
      ++line_;
      const std::string_view content = trim(line);
      if (content.empty() || content.front() == '#')
        continue;
      if (columns_.empty())
        read_header(content);
      else
        read_row(content);
    }
    if (columns_.empty())
      wrong("it holds no rows; the first line names the columns, such as time [s], x [m], y [m], z [m]");
    return std::move(rows_);
  }

private:
  struct Column {
    std::size_t name;
    double unit; // in SI
  };

  template <class... Args> [[noreturn]] void wrong(fmt::format_string<Args...> reason, Args&&... args) const {
    fail(ExitCode::bad_input, "{}:{}: {}", path_, std::max<std::size_t>(line_, 1),
         fmt::format(reason, std::forward<Args>(args)...));
  }

  [[nodiscard]] bool has(std::size_t name) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
  }

  // "x [mm]"
  Column read_column(std::string_view cell) const {
    const std::size_t bracket = cell.find('[');
    const std::string_view name = trim(cell.substr(0, bracket));
    const auto known = std::find(column_names.begin(), column_names.end(), name);
    if (known == column_names.end())
      wrong("unknown column \"{}\"{}", name.substr(0, 60), suggestion(name, column_names));
    const Column column{static_cast<std::size_t>(known - column_names.begin()), 1};
    if (has(column.name))
      wrong("column \"{}\" stands there twice", name);
    if (bracket == std::string_view::npos)
      return column;
    if (cell.back() != ']')
      wrong("column \"{}\": a unit stands in brackets, such as {} [m]", cell.substr(0, 60), name);
    const Quantity& kind = column.name == 0 ? quantity::time : column.name < 4 ? quantity::length : quantity::number;
    const std::string_view unit = trim(cell.substr(bracket + 1, cell.size() - bracket - 2));
    std::string problem;
    const auto factor = read_quantity(fmt::format("1 {}", unit == "1" ? "" : unit), kind, problem);
    if (!factor)
      wrong("column \"{}\": {}", name, problem);
    return {column.name, *factor};
  }

  void read_header(std::string_view line) {
    for (const std::string_view cell : cells_of(line))
      columns_.push_back(read_column(cell));
    const auto all_or_none = [&](std::size_t first, std::size_t last) {
      bool any = false;
      for (std::size_t name = first; name <= last; ++name)
        any = any || has(name);
      for (std::size_t name = first; any && name <= last; ++name)
        if (!has(name))
          wrong("column \"{}\" is missing", column_names[name]);
      return any;
    };
    (void)all_or_none(0, 0);
    if (!has(0))
      wrong("column \"time\" is missing");
    has_places_ = all_or_none(1, 3);
    has_rotations_ = all_or_none(4, 7);
    if (!has_places_ && !has_rotations_)
      wrong("neither x, y, z nor qw, qx, qy, qz: nothing would move");
  }

  void read_row(std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != columns_.size())
      wrong("{} values, but the first line names {} columns", cells.size(), columns_.size());
    std::array<double, column_names.size()> values{};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double& value = values[columns_[i].name];
      const char* end = cells[i].data() + cells[i].size();
      const auto [stop, error] = std::from_chars(cells[i].data() + cells[i].starts_with('+'), end, value);
      value *= columns_[i].unit;
      if (cells[i].empty() || error != std::errc{} || stop != end || !std::isfinite(value))
        wrong("column \"{}\": \"{}\" is not a finite number", column_names[columns_[i].name], cells[i].substr(0, 60));
    }
    if (rows_.times.size() == most_keyframes)
      wrong("more than {} rows: every frame of a run carries them; take every n-th; what stands between is found by "
            "interpolation",
            most_keyframes);
    rows_.lines.push_back(line_);
    rows_.times.push_back(values[0]);
    if (has_places_)
      rows_.places.emplace_back(values[1], values[2], values[3]);
    if (has_rotations_)
      rows_.rotations.emplace_back(values[4], values[5], values[6], values[7]);
  }

  const std::string& path_;
  std::size_t line_ = 0;
  std::vector<Column> columns_;
  bool has_places_ = false, has_rotations_ = false;
  Rows rows_;
};

// Nothing where a list is absent, or wrong, which is reported.
template <class T, class ReadItem>
std::vector<T> read_list(TableReader& table, std::string_view key, std::size_t count, ReadItem read_item) {
  std::vector<T> result;
  const Node* list = table.take(key);
  if (!list)
    return result;
  if (list->type != Node::Type::list || (count > 0 && list->items.size() != count)) {
    table.wrong(key, list->type != Node::Type::list
                         ? fmt::format("expected a list, got {}", describe(list->type))
                         : fmt::format("{} of them, but {} times", list->items.size(), count));
    return result;
  }
  for (const Node& item : list->items) {
    const std::optional<T> value = read_item(item);
    if (!value)
      return {};
    result.push_back(*value);
  }
  return result;
}

std::optional<Quaterniond> read_quaternion(TableReader& table, const Node& item) {
  std::array<double, 4> q{};
  if (item.type != Node::Type::list || item.items.size() != 4) {
    table.problems().add(item.place, "rotations: expected unit quaternions [w, x, y, z]");
    return {};
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = table.quantity(item.items[i], "rotations", Bound::any);
    if (!value)
      return {};
    q[i] = *value;
  }
  return Quaterniond(q[0], q[1], q[2], q[3]);
}

Rows read_lists(TableReader& table) {
  Rows rows;
  if (table.absent("times"))
    table.missing("times", "[0, \"0.5 s\", \"1 s\"]");
  if (table.absent("places") && table.absent("rotations"))
    table.missing("places", "[[0, 0, 0], [0, 0.1, 0], [0, 0.1, 0.1]]");
  rows.times =
      read_list<double>(table, "times", 0, [&](const Node& item) { return table.quantity(item, "times", Bound::any); });
  const std::size_t count = rows.times.size();
  rows.places =
      read_list<Vector3d>(table, "places", count, [&](const Node& item) { return table.vector(item, "places"); });
  rows.rotations =
      read_list<Quaterniond>(table, "rotations", count, [&](const Node& item) { return read_quaternion(table, item); });
  return rows;
}

// What is wrong with the rows together, and in which one; quaternions are made unit ones.
std::optional<std::pair<std::size_t, std::string>> find_fault(Rows& rows) {
  for (std::size_t i = 0; i < rows.times.size(); ++i) {
    if (i > 0 && !(rows.times[i] > rows.times[i - 1]))
      return std::pair(i, fmt::format("times must increase, but {} s follows {} s", shortest(rows.times[i]),
                                      shortest(rows.times[i - 1])));
    const double passed = i > 0 ? rows.times[i] - rows.times[i - 1] : 1;
    const double moved = i > 0 && !rows.places.empty() ? (rows.places[i] - rows.places[i - 1]).norm() : 0;
    if (!std::isfinite(1 / passed) || !std::isfinite(moved / passed) || !std::isfinite(passed))
      return std::pair(i,
                       fmt::format("from the row before it moves by {:.3g} m in {:.3g} s, a velocity beyond the range "
                                   "of numbers",
                                   moved, passed));
    if (rows.rotations.empty())
      continue;
    Quaterniond& q = rows.rotations[i];
    const double norm = q.norm();
    if (!(std::abs(norm - 1) <= norm_tolerance))
      return std::pair(i, fmt::format("a rotation is a unit quaternion, but this one has the norm {:.4g}", norm));
    if (std::abs(norm - 1) > 1e-15) // so that what is one stays as it is
      q.coeffs() /= norm;
    if (i > 0 && q.angularDistance(rows.rotations[i - 1]) > widest_turn)
      return std::pair(i, "from the row before it turns by half a turn, so there is no telling which way round: give "
                          "more rows");
  }
  if (rows.times.size() < 2)
    return std::pair(std::size_t{0}, "a motion takes two rows or more");
  return {};
}

} // namespace

std::shared_ptr<const Keyframes> read_keyframes(TableReader& table, const Vector3d& center, const Files& files) {
  Rows rows;
  std::string path;
  const auto interpolation = static_cast<Interpolation>(table.choice("interpolation").value_or(0));
  const bool by_file = !table.absent("file");
  if (by_file) {
    table.has_no_meaning({"times", "places", "rotations"}, "the rows are those of the file");
    path = read_file(table, files);
    if (!files.must_exist) {
      table.wrong("file", "rows by file need a scene that is a file; here they stand in the scene: times, places, "
                          "rotations");
      return {};
    }
    if (!std::filesystem::is_regular_file(path)) // reported
      return {};
    try {
      rows = RowFile(path).read();
    } catch (const Error& error) {
      table.wrong("file", error.what());
      return {};
    }
  } else {
    rows = read_lists(table);
  }
  const bool has_places = !rows.places.empty(), has_rotations = !rows.rotations.empty();
  const Vector3d turned_about = has_places ? Vector3d(Vector3d::Zero()) : table.vector("center").value_or(center);
  if (has_places)
    table.has_no_meaning({"center"}, "it turns about the places");
  if (const auto fault = find_fault(rows)) {
    const auto& [row, reason] = *fault;
    const Node* times = table.take("times");
    if (by_file)
      table.wrong("file", fmt::format("{}:{}: {}", path, rows.lines.empty() ? 1 : rows.lines[row], reason));
    else if (times && row < times->items.size())
      table.problems().add(times->items[row].place, "times: " + reason);
    else if (times && times->type == Node::Type::list && times->items.empty())
      table.wrong("times", reason);
    return {};
  }
  if (!has_places && !has_rotations)
    return {}; // reported
  return std::make_shared<const Keyframes>(std::move(rows.times), std::move(rows.places), std::move(rows.rotations),
                                           turned_about, interpolation);
}

} // namespace sheet::scene
