// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a motion: lists in the scene, or a CSV file beside it.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/scene/row_file.h"
#include "libsheet/scene/tables.h"

namespace sheet::scene {
namespace {

using Eigen::Quaterniond;

constexpr double norm_tolerance = 1e-3;
constexpr double widest_turn = 175 * std::numbers::pi / 180; // beyond it, rounding decides which way round

struct Rows {
  std::vector<double> times;
  std::vector<Vector3d> places;
  std::vector<Quaterniond> rotations;
  std::vector<std::size_t> lines; // of a file
};

const std::array<RowColumn, 8> motion_columns{{{"time", quantity::time},
                                               {"x", quantity::length},
                                               {"y", quantity::length},
                                               {"z", quantity::length},
                                               {"qw", quantity::number},
                                               {"qx", quantity::number},
                                               {"qy", quantity::number},
                                               {"qz", quantity::number}}};

// Of a CSV file. Throws Error (bad_input), naming file and line.
Rows read_rows(const std::string& path) {
  const RowFile file = read_row_file(path, motion_columns, "time [s], x [m], y [m], z [m]", most_keyframes,
                                     "every frame of a run carries them; take every n-th; what stands between is found "
                                     "by interpolation");
  const auto all_or_none = [&](std::size_t first, std::size_t last) {
    bool any = false;
    for (std::size_t column = first; column <= last; ++column)
      any = any || file.has(column);
    for (std::size_t column = first; any && column <= last; ++column)
      file.require(column);
    return any;
  };
  file.require(0);
  const bool has_places = all_or_none(1, 3), has_rotations = all_or_none(4, 7);
  if (!has_places && !has_rotations)
    file.wrong(file.header_line, "neither x, y, z nor qw, qx, qy, qz: nothing would move");
  Rows rows;
  rows.lines = file.lines;
  for (const std::vector<double>& row : file.rows) {
    rows.times.push_back(row[0]);
    if (has_places)
      rows.places.emplace_back(row[1], row[2], row[3]);
    if (has_rotations)
      rows.rotations.emplace_back(row[4], row[5], row[6], row[7]);
  }
  return rows;
}

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
      rows = read_rows(path);
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
