// SPDX-License-Identifier: GPL-3.0-or-later
// --set path=value
#include <algorithm>
#include <charconv>
#include <optional>

#include "libsheet/base/error.h"
#include "libsheet/scene/document.h"

namespace sheet::scene {
namespace {

// Everything below a value that a --set gave comes from that --set.
void mark(Node& node, int set) {
  node.place = {0, 0, set};
  for (Node& item : node.items)
    mark(item, set);
  for (Member& member : node.members) {
    member.place = node.place;
    mark(member.value, set);
  }
}

// The value of `text` as TOML, if it is one value and no second setting in disguise.
std::optional<Node> read_toml_value(const std::string& text) {
  try {
    Node document = parse_toml("value = " + text, "");
    if (document.members.size() == 1)
      if (Node* value = document.find("value"))
        return std::move(*value);
  } catch (const Error&) {
    // the caller says what else it may be
  }
  return {};
}

// What is not TOML is a bare word or a quantity with its unit.
Node read_value(std::string_view text, std::string_view set) {
  const bool printable =
      std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
  if (printable) {
    if (auto value = read_toml_value(std::string(text)))
      return *value;
    if (auto value = read_toml_value(toml_text(text)))
      return *value;
  }
  fail(ExitCode::usage, "--set {}: the value must be one line of UTF-8 text", set);
}

std::string_view without_spaces(std::string_view text) {
  while (text.starts_with(' '))
    text.remove_prefix(1);
  while (text.ends_with(' '))
    text.remove_suffix(1);
  return text;
}

bool is_number(std::string_view key) {
  return std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

void apply_set(Node& document, std::string_view set, int index) {
  constexpr int deepest = 8;
  const std::size_t equals = set.find('=');
  if (equals == std::string_view::npos)
    fail(ExitCode::usage, "--set {0}: expected KEY=VALUE, such as material.viscosity=50", set);
  std::string_view path = without_spaces(set.substr(0, equals));
  const Place place{0, 0, index};
  Node* node = &document;
  for (int depth = 0;; ++depth) {
    const std::size_t dot = path.find('.');
    const std::string_view key = without_spaces(path.substr(0, dot));
    const bool last = dot == std::string_view::npos;
    if (key.empty() || depth == deepest)
      fail(ExitCode::usage, "--set {}: expected keys joined by dots before the \"=\", such as material.viscosity", set);
    if (node->type == Node::Type::list && node->items.size() == 1 && !is_number(key))
      node = &node->items.front(); // the only one needs no number
    if (node->type == Node::Type::list) {
      std::size_t item = 0;
      const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), item);
      if (error == std::errc{} && item == node->items.size() && !last) { // the next one
        node->items.emplace_back().type = Node::Type::table;
        node->items.back().place = place;
      }
      if (error != std::errc{} || end != key.data() + key.size() || item >= node->items.size())
        fail(ExitCode::usage, "--set {}: \"{}\" is not an item of a list of {} (the first is 0)", set, key,
             node->items.size());
      node = &node->items[item];
    } else if (node->type == Node::Type::table) {
      Node* child = node->find(key);
      if (!child) {
        node->members.push_back({std::string(key), place, {}});
        child = &node->members.back().value;
        child->place = place;
        if (!last && path.substr(dot + 1).starts_with("0.")) // the first of a list, such as solid.0.shape
          child->type = Node::Type::list;
      } else if (last) {
        std::find_if(node->members.begin(), node->members.end(), [&](const Member& m) { return m.key == key; })->place =
            place;
      }
      node = child;
    } else {
      fail(ExitCode::usage, "--set {}: there is nothing below {}, so no \"{}\"", set, describe(node->type), key);
    }
    if (last)
      break;
    path.remove_prefix(dot + 1);
  }
  *node = read_value(without_spaces(set.substr(equals + 1)), set);
  mark(*node, index);
}

} // namespace sheet::scene
