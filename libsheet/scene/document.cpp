// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/document.h"

#include <algorithm>

#include "libsheet/base/error.h"

// toml++ recurses once a nested value.
#define TOML_MAX_NESTED_VALUES 24
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace sheet::scene {
namespace {

constexpr std::size_t largest_text = 4 << 20;
constexpr int longest_dotted_key = 16;

[[noreturn]] void fail_at(std::string_view name, std::size_t line, std::size_t column, std::string_view reason) {
  fail(ExitCode::bad_input, "{}:{}:{}: {}", name, line, column, reason);
}

// toml++ limits the nesting of values but not of dotted keys, and its recursions would exhaust the stack on a long one.
// Without texts over several lines a line can be judged by itself.
void refuse_what_toml_cannot_bear(std::string_view text, std::string_view name) {
  if (text.size() > largest_text)
    fail(ExitCode::bad_input, "{}: longer than {} bytes", name, largest_text);
  std::size_t line = 1, start = 0;
  int dots = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line;
      start = i + 1;
      dots = 0;
      quote = 0;
    } else if (c == '\0') {
      fail_at(name, line, i - start + 1, "a zero byte");
    } else if (quote) {
      if (c == '\\' && quote == '"')
        ++i;
      else if (c == quote)
        quote = 0;
      if (i < text.size() && text[i] == '\n')
        --i; // an escaped line end still ends the line
    } else if (c == '"' || c == '\'') {
      if (text.substr(i, 3) == std::string(3, c))
        fail_at(name, line, i - start + 1, "a text over several lines has no use in a scene");
      quote = c;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++dots > longest_dotted_key)
        fail_at(name, line, i - start + 1, "too many dots in a key");
    } else if (c == ',' || c == '=' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;
    }
  }
}

Place place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Node convert(const toml::node& source) {
  Node result;
  result.place = place_of(source.source());
  if (const auto* table = source.as_table()) {
    result.type = Node::Type::table;
    for (const auto& [key, value] : *table)
      result.members.push_back({std::string(key.str()), place_of(key.source()), convert(value)});
  } else if (const auto* list = source.as_array()) {
    result.type = Node::Type::list;
    for (const toml::node& item : *list)
      result.items.push_back(convert(item));
  } else if (const auto* text = source.as_string()) {
    result.type = Node::Type::text;
    result.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    result.type = Node::Type::integer;
    result.integer = integer->get();
  } else if (const auto* real = source.as_floating_point()) {
    result.type = Node::Type::real;
    result.real = real->get();
  } else if (const auto* boolean = source.as_boolean()) {
    result.type = Node::Type::boolean;
    result.boolean = boolean->get();
  } else {
    result.type = Node::Type::date;
  }
  return result;
}

} // namespace

Node parse_toml(std::string_view text, std::string_view name) {
  refuse_what_toml_cannot_bear(text, name);
  try {
    return convert(toml::parse(text));
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    fail_at(name, error.source().begin.line, error.source().begin.column, reason);
  }
}

const Node* Node::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += '\\';
    result += c;
  }
  return result + '"';
}

std::string_view describe(Node::Type type) {
  switch (type) {
  case Node::Type::boolean:
    return "true or false";
  case Node::Type::integer:
  case Node::Type::real:
    return "a number";
  case Node::Type::text:
    return "a text";
  case Node::Type::list:
    return "a list";
  case Node::Type::table:
    return "a table";
  case Node::Type::date:
    break;
  }
  return "a date or time";
}

} // namespace sheet::scene
