// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/document.h"

#include <algorithm>
#include <array>

#include "libsheet/base/error.h"
#include "libsheet/scene/ascii.h"

namespace sheet::scene {
struct TomlAssertion {};
[[noreturn, gnu::noinline, gnu::cold]] static void toml_assertion_failed() { throw TomlAssertion(); }
} // namespace sheet::scene

// toml++ recurses once a nested value, and asserts what a text may well violate (found by tests/fuzz/scene.cpp): its
// assertions are made exceptions here, in every kind of build.
#undef NDEBUG
#define TOML_MAX_NESTED_VALUES 24
#define TOML_ASSERT(condition) ((condition) ? void() : sheet::scene::toml_assertion_failed())
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace sheet::scene {
namespace {

Place place_of(const toml::source_region& region, const AsciiToml& from) {
  const int line = static_cast<int>(region.begin.line);
  return {line, from.original_column(line, static_cast<int>(region.begin.column))};
}

Node convert(const toml::node& source, const AsciiToml& from) {
  Node result;
  result.place = place_of(source.source(), from);
  if (const auto* table = source.as_table()) {
    result.type = Node::Type::table;
    for (const auto& [key, value] : *table)
      result.members.push_back({std::string(key.str()), place_of(key.source(), from), convert(value, from)});
  } else if (const auto* list = source.as_array()) {
    result.type = Node::Type::list;
    for (const toml::node& item : *list)
      result.items.push_back(convert(item, from));
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

bool may_be_several(std::string_view table) {
  return std::ranges::count(
             std::array<std::string_view, 6>{"sheet", "sheet.perturbation", "hold", "solid", "inflow", "outflow"},
             table) > 0;
}

} // namespace

Node parse_toml(std::string_view text, std::string_view name) {
  const AsciiToml ascii = to_ascii(text, name);
  try {
    return convert(toml::parse(ascii.text), ascii);
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    constexpr std::string_view twice = "cannot redefine existing table '"; // [solid] over each of several
    if (const std::size_t at = reason.find(twice); at != std::string::npos) {
      const std::size_t begin = at + twice.size();
      const std::string table = reason.substr(begin, reason.find('\'', begin) - begin);
      reason += may_be_several(table)
                    ? fmt::format(": where there are several, each is written [[{}]]", table)
                    : fmt::format(": a scene has one [{}], with all its keys under one heading", table);
    }
    const Place place = place_of(error.source(), ascii);
    fail(ExitCode::bad_input, "{}:{}:{}: {}", name, place.line, place.column, reason);
  } catch (const TomlAssertion&) {
    fail(ExitCode::bad_input, "{}: not TOML", name);
  }
}

const Node* Node::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string toml_text(std::string_view text) {
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
