// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the keys of one table, each as the scene's keys declare it (keys.h), and remembers which it was asked for: what
// is left is unknown. A value that is wrong is reported once, at its place, and reads as absent. To ask for a key that
// is not declared, or as what it is not, is a fault of the program: std::logic_error.
#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "libsheet/base/units.h"
#include "libsheet/scene/keys.h"
#include "libsheet/scene/motion.h"
#include "libsheet/scene/problems.h"

namespace sheet::scene {

enum class Bound { any, positive, not_negative };

class TableReader {
public:
  // `where` names the table in messages: "[material]", "[[hold]]", "pressure"; `keys`: those that it may have.
  TableReader(const Node& table, std::string where, const KeyTable& keys, Problems& problems)
      : table_(table), where_(std::move(where)), keys_(keys), problems_(problems) {}

  [[nodiscard]] const Place& place() const { return table_.place; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] Problems& problems() { return problems_; }

  // Place of a key's value, or of the table if the key is absent.
  [[nodiscard]] Place place_of(std::string_view key) const;
  [[nodiscard]] bool absent(std::string_view key) const { return table_.find(key) == nullptr; }

  // The value as it was written, for what the functions below do not cover.
  const Node* take(std::string_view key);

  std::optional<double> quantity(std::string_view key, Bound bound = Bound::any);
  double quantity_or(std::string_view key, double fallback, Bound bound = Bound::any);
  // Without a good value: NaN, with which every later comparison is false, so that one mistake is one line. `example`:
  // where that of its quantity is none of this key.
  double required(std::string_view key, Bound bound = Bound::positive, std::string_view example = {});
  std::optional<Eigen::Vector3d> vector(std::string_view key);
  // All numbers of a list; none if it is absent or one of them is wrong, which is reported.
  std::vector<double> list_or_missing(std::string_view key, Bound bound, std::string_view example);
  Eigen::Vector3d direction_or(std::string_view key, const Eigen::Vector3d& fallback); // not zero
  std::optional<std::string> text(std::string_view key);                               // or the name of a file
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::int64_t> seed(std::string_view key);
  // One of the key's words, as its index.
  std::optional<std::size_t> choice(std::string_view key);
  // A constant, or a list of rows [time, value] in the order of time.
  std::optional<Timed<double>> timed_number(std::string_view key, Bound bound = Bound::any);
  // A constant vector, or a list of rows [time, x, y, z] in the order of time.
  std::optional<Timed<Eigen::Vector3d>> timed_velocity(std::string_view key);
  // A table below this one; nothing if it is absent or no table.
  std::optional<TableReader> table(std::string_view key);

  // Says that a required key is missing.
  void missing(std::string_view key, std::string_view example);
  // Says what is wrong with the value of a key that was read.
  void wrong(std::string_view key, std::string reason);
  // Known elsewhere, but without meaning here: an own message instead of "unknown key".
  void has_no_meaning(std::initializer_list<std::string_view> keys, std::string_view because);

  // Reports every key that nobody asked for.
  void finish();

  // The same for a single value of a key's list.
  std::optional<double> quantity(const Node& value, std::string_view key, Bound bound);
  std::optional<Eigen::Vector3d> vector(const Node& value, std::string_view key);
  // Of another kind than the key's.
  std::optional<double> number(const Node& value, std::string_view key, const Quantity& kind, Bound bound);

  // How the key is declared.
  [[nodiscard]] const Key& declared(std::string_view key) const;

private:
  [[nodiscard]] const Key& declared(std::string_view key, std::initializer_list<Key::Form> forms) const;
  void wrong_type(const Node& value, std::string_view key, std::string_view expected);
  template <class T, class ReadRow>
  std::optional<Timed<T>> rows(const Node& list, std::string_view key, std::size_t width, ReadRow read_row);

  const Node& table_;
  std::string where_;
  const KeyTable& keys_;
  Problems& problems_;
  std::vector<std::string_view> known_;
};

} // namespace sheet::scene
