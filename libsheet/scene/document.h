// SPDX-License-Identifier: GPL-3.0-or-later
// A TOML text as a plain tree in which every key and value knows where it was written.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sheet::scene {

// A place in the file, or the --set that a value came from.
struct Place {
  int line = 0, column = 0; // from 1; 0: the file as a whole
  int set = -1;             // index of the --set; it precedes line and column
};

struct Member;

struct Node {
  enum class Type { boolean, integer, real, text, list, table, date };
  Type type = Type::table;
  Place place;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<Node> items;     // of a list
  std::vector<Member> members; // of a table, in no particular order

  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
  [[nodiscard]] bool is_number() const { return type == Type::integer || type == Type::real; }
  [[nodiscard]] double number() const { return type == Type::integer ? static_cast<double>(integer) : real; }
};

struct Member {
  std::string key;
  Place place; // of the key
  Node value;
};

// "a table", "a text", ... for messages.
[[nodiscard]] std::string_view describe(Node::Type type);

// A text without control characters as a TOML value, in quotes.
[[nodiscard]] std::string toml_text(std::string_view text);

// Throws Error (bad_input), "name:line:column: reason", at the first place that is not TOML. Safe with any text: size,
// nesting and dotted keys are limited, and texts over several lines are refused.
[[nodiscard]] Node parse_toml(std::string_view text, std::string_view name);

// Applies "path=value" to the tree: path is keys and list indices (from 0) joined by dots; tables that are missing are
// made. value is TOML; what is not TOML (a bare word, 2.5 mm) is taken as a text. Throws Error (usage), "--set TEXT:
// reason".
void apply_set(Node& document, std::string_view set, int index);

} // namespace sheet::scene
