// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/ranges.h>

#include "libsheet/base/edit_distance.h"

namespace sheet::scene {

using Form = Key::Form;

namespace {

bool is_plain_number(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" +"), end = text.find_last_not_of(' ');
  if (begin == std::string_view::npos)
    return false;
  double value = 0;
  return std::from_chars(text.data() + begin, text.data() + end + 1, value).ptr == text.data() + end + 1;
}

} // namespace

Place TableReader::place_of(std::string_view key) const {
  const Node* value = table_.find(key);
  return value ? value->place : table_.place;
}

const Key& TableReader::declared(std::string_view key) const {
  if (const Key* found = keys_.find(key))
    return *found;
  throw std::logic_error(fmt::format("{}: {} is none of the scene's keys", where_, key));
}

const Key& TableReader::declared(std::string_view key, std::initializer_list<Key::Form> forms) const {
  const Key& found = declared(key);
  if (std::ranges::find(forms, found.form) == forms.end())
    throw std::logic_error(fmt::format("{}: {} is declared as {}", where_, key, kind_of(found)));
  return found;
}

const Node* TableReader::take(std::string_view key) {
  known_.push_back(declared(key).name);
  return table_.find(key);
}

void TableReader::wrong(std::string_view key, std::string reason) {
  problems_.add(place_of(key), fmt::format("{}: {}", key, reason));
}

void TableReader::wrong_type(const Node& value, std::string_view key, std::string_view expected) {
  problems_.add(value.place, fmt::format("{}: expected {}, got {}", key, expected, describe(value.type)));
}

void TableReader::missing(std::string_view key, std::string_view example) {
  problems_.add(table_.place, fmt::format("missing key \"{}\" in {}, such as {} = {}", key, where_, key, example));
}

std::optional<double> TableReader::number(const Node& value, std::string_view key, const Quantity& kind, Bound bound) {
  double number = 0;
  if (value.is_number()) {
    number = value.number();
  } else if (value.type == Node::Type::text) {
    std::string problem;
    const auto read = read_quantity(value.text, kind, problem);
    if (!read) {
      problems_.add(value.place, fmt::format("{}: {}", key, problem));
      return {};
    }
    if (kind.unit != "1" && *read != 0 && is_plain_number(value.text)) {
      problems_.add(value.place, fmt::format("{}: \"{}\" has no unit: write one, as in \"{}\", or the plain number, "
                                             "which is in {}",
                                             key, value.text.substr(0, 60), kind.example, kind.unit));
      return {};
    }
    number = *read;
  } else {
    problems_.add(value.place, fmt::format("{}: {}", key, mismatch(kind, describe(value.type))));
    return {};
  }
  const auto got = [&] {
    return kind.unit == "1" ? shortest(number) : fmt::format("{} {}", shortest(number), kind.unit);
  };
  if (!std::isfinite(number))
    problems_.add(value.place, fmt::format("{} must be finite, got {}", key, got()));
  else if (bound == Bound::positive && number <= 0)
    problems_.add(value.place, fmt::format("{} must be positive, got {}", key, got()));
  else if (bound == Bound::not_negative && number < 0)
    problems_.add(value.place, fmt::format("{} must not be negative, got {}", key, got()));
  else
    return number;
  return {};
}

std::optional<double> TableReader::quantity(const Node& value, std::string_view key, Bound bound) {
  return number(value, key, *declared(key, {Form::quantity, Form::list, Form::timed}).quantity, bound);
}

std::optional<double> TableReader::quantity(std::string_view key, Bound bound) {
  const Quantity& kind = *declared(key, {Form::quantity}).quantity;
  const Node* value = take(key);
  return value ? number(*value, key, kind, bound) : std::nullopt;
}

double TableReader::quantity_or(std::string_view key, double fallback, Bound bound) {
  return quantity(key, bound).value_or(fallback);
}

double TableReader::required(std::string_view key, Bound bound, std::string_view example) {
  const Quantity& kind = *declared(key, {Form::quantity}).quantity;
  if (absent(key))
    missing(key, !example.empty()   ? std::string(example)
                 : kind.unit == "1" ? std::string(kind.example)
                                    : fmt::format("\"{}\"", kind.example));
  return quantity(key, bound).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<Eigen::Vector3d> TableReader::vector(const Node& value, std::string_view key) {
  const Quantity& kind = *declared(key, {Form::list, Form::timed}).quantity;
  if (value.type != Node::Type::list || value.items.size() != 3) {
    const std::string got = value.type == Node::Type::list ? fmt::format("{} of them", value.items.size())
                                                           : std::string(describe(value.type));
    problems_.add(value.place, fmt::format("{}: expected [x, y, z], each {} such as \"{}\", got {}", key, kind.name,
                                           kind.example, got));
    return {};
  }
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    const auto component = number(value.items[static_cast<std::size_t>(i)], key, kind, Bound::any);
    good = good && component;
    result[i] = component.value_or(0);
  }
  if (!good)
    return {};
  return result;
}

std::optional<Eigen::Vector3d> TableReader::vector(std::string_view key) {
  const Node* value = take(key);
  return value ? vector(*value, key) : std::nullopt;
}

std::vector<double> TableReader::list_or_missing(std::string_view key, Bound bound, std::string_view example) {
  std::vector<double> numbers;
  const Node* list = take(key);
  if (list == nullptr) {
    missing(key, example);
    return numbers;
  }
  if (list->type != Node::Type::list) {
    wrong(key, fmt::format("expected a list, got {}", describe(list->type)));
    return numbers;
  }
  for (const Node& item : list->items)
    if (const auto number = quantity(item, key, bound))
      numbers.push_back(*number);
  return numbers.size() == list->items.size() ? numbers : std::vector<double>{};
}

Eigen::Vector3d TableReader::direction_or(std::string_view key, const Eigen::Vector3d& fallback) {
  const auto direction = vector(key);
  if (!direction)
    return fallback;
  if (direction->stableNorm() > 0)
    return *direction;
  wrong(key, "a direction must not be zero");
  return fallback;
}

std::optional<std::string> TableReader::text(std::string_view key) {
  (void)declared(key, {Form::text, Form::file});
  const Node* value = take(key);
  if (!value)
    return {};
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; };
  if (value->type != Node::Type::text)
    wrong_type(*value, key, "a text");
  else if (value->text.empty())
    wrong(key, "must not be empty");
  else if (std::any_of(value->text.begin(), value->text.end(), control))
    wrong(key, "must not hold control characters");
  else
    return value->text;
  return {};
}

std::optional<bool> TableReader::boolean(std::string_view key) {
  (void)declared(key, {Form::boolean});
  const Node* value = take(key);
  if (!value)
    return {};
  if (value->type == Node::Type::boolean)
    return value->boolean;
  wrong_type(*value, key, "true or false");
  return {};
}

std::optional<std::int64_t> TableReader::seed(std::string_view key) {
  (void)declared(key, {Form::integer});
  const Node* value = take(key);
  if (!value)
    return {};
  if (value->type == Node::Type::integer && value->integer >= 0)
    return value->integer;
  if (value->type == Node::Type::integer)
    wrong(key, fmt::format("must not be negative, got {}", value->integer));
  else
    wrong_type(*value, key, "an integer");
  return {};
}

std::optional<std::size_t> TableReader::choice(std::string_view key) {
  const std::span<const std::string_view> words = declared(key, {Form::word}).words;
  const Node* value = take(key);
  if (!value)
    return {};
  std::string list;
  for (const auto word : words)
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", word);
  if (value->type != Node::Type::text) {
    wrong_type(*value, key, "one of " + list);
    return {};
  }
  const auto found = std::find(words.begin(), words.end(), value->text);
  if (found != words.end())
    return static_cast<std::size_t>(found - words.begin());
  const auto near = nearest_word(value->text, words);
  wrong(key, fmt::format("\"{}\" is none of {}{}", value->text.substr(0, 60), list,
                         near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
  return {};
}

namespace {
bool is_finite(double value) { return std::isfinite(value); }
bool is_finite(const Eigen::Vector3d& value) { return value.allFinite(); }
} // namespace

template <class T, class ReadRow>
std::optional<Timed<T>> TableReader::rows(const Node& list, std::string_view key, std::size_t width, ReadRow read_row) {
  Timed<T> result;
  for (const Node& row : list.items) {
    if (row.type != Node::Type::list || row.items.size() != width) {
      problems_.add(row.place, fmt::format("{}: expected rows [time, {}]", key, width == 2 ? key : "x, y, z"));
      return {};
    }
    const auto time = number(row.items[0], key, quantity::time, Bound::any);
    const std::optional<T> value = read_row(row);
    if (!time || !value)
      return {};
    if (!result.entries.empty() && *time <= result.entries.back().time) {
      problems_.add(row.place, fmt::format("{}: times must increase, but {} s follows {} s", key, shortest(*time),
                                           shortest(result.entries.back().time)));
      return {};
    }
    if (!result.entries.empty() &&
        !is_finite((*value - result.entries.back().value) / (*time - result.entries.back().time))) {
      problems_.add(row.place,
                    fmt::format("{}: from the row before it changes so much in {} s that the change a second is "
                                "beyond the range of numbers",
                                key, shortest(*time - result.entries.back().time)));
      return {};
    }
    result.entries.push_back({*time, *value});
  }
  return result;
}

std::optional<Timed<double>> TableReader::timed_number(std::string_view key, Bound bound) {
  (void)declared(key, {Form::timed});
  const Node* value = take(key);
  if (!value)
    return {};
  if (value->type == Node::Type::list && !value->items.empty())
    return rows<double>(*value, key, 2, [&](const Node& row) { return quantity(row.items[1], key, bound); });
  const auto constant = quantity(*value, key, bound);
  if (!constant)
    return {};
  return Timed<double>{{{0, *constant}}};
}

std::optional<Timed<Eigen::Vector3d>> TableReader::timed_velocity(std::string_view key) {
  (void)declared(key, {Form::timed});
  const Node* value = take(key);
  if (!value)
    return {};
  if (value->type == Node::Type::list && !value->items.empty() && value->items[0].type == Node::Type::list)
    return rows<Eigen::Vector3d>(*value, key, 4, [&](const Node& row) -> std::optional<Eigen::Vector3d> {
      Node components = row;
      components.items.erase(components.items.begin());
      return vector(components, key);
    });
  const auto constant = vector(*value, key);
  if (!constant)
    return {};
  return Timed<Eigen::Vector3d>{{{0, *constant}}};
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const Node* value = take(key);
  if (!value)
    return {};
  if (value->type == Node::Type::table)
    return TableReader(*value, std::string(key), *declared(key).below, problems_);
  wrong_type(*value, key, "a table");
  return {};
}

void TableReader::has_no_meaning(std::initializer_list<std::string_view> keys, std::string_view because) {
  for (const auto key : keys)
    for (const Member& member : table_.members)
      if (member.key == key && std::find(known_.begin(), known_.end(), key) == known_.end()) {
        problems_.add(member.place, fmt::format("key \"{}\" has no meaning in {}: {}", key, where_, because));
        known_.push_back(key);
      }
}

void TableReader::finish() {
  for (const Member& member : table_.members) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end())
      continue;
    const std::vector<std::string> others =
        keys_.find(member.key) == nullptr ? tables_with(member.key) : std::vector<std::string>{};
    problems_.add(member.place,
                  fmt::format("unknown key \"{}\" in {}{}", member.key.substr(0, 60), where_,
                              others.empty() ? suggestion(member.key, known_)
                                             : fmt::format("; it belongs in {}", fmt::join(others, ", "))));
  }
}

} // namespace sheet::scene
