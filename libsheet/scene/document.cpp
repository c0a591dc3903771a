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

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t begin = std::min(text.find_first_not_of(blank), text.size());
  return text.substr(begin, text.find_last_not_of(blank) + 1 - begin);
}

std::string_view line_of(std::string_view text, std::size_t number) { // from 1
  for (; number > 1 && text.find('\n') != text.npos; --number)
    text.remove_prefix(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

// The value, or the item of a list or table, in which a column (from 1) of the line is.
std::string_view value_at(std::string_view line, std::size_t column) {
  const std::size_t at = std::min(column - 1, line.size());
  const std::size_t before = line.substr(0, at).find_last_of("=[{,"), begin = before == line.npos ? 0 : before + 1;
  return trimmed(line.substr(begin, std::min(line.find_first_of(",]}", at), line.size()) - begin));
}

// What to write instead, where the parser's reason says enough; else "".
std::string_view remedy_of(std::string_view reason) {
  const auto says = [&](std::string_view words) { return reason.find(words) != reason.npos; };
  if (says("string: ") && (says("control characters") || says("end-of-file")))
    return ": a text ends on its line, with the quote that it begins with";
  if (says("escape"))
    return ": a text in double quotes has \\\\ for a backslash; folders are separated by /";
  if (says("expected '=', saw") || says("expected value, saw"))
    return ": a line is KEY = VALUE";
  if (says("parsing boolean"))
    return ": true and false are written so";
  return "";
}

// Whether it is a number without a digit on one side of its point.
bool has_bare_point(std::string_view number) {
  const auto digit = [&](std::size_t i) { return i < number.size() && number[i] >= '0' && number[i] <= '9'; };
  const std::size_t point = number.find('.');
  return point != number.npos && number.find_first_not_of("+-.0123456789eE") == number.npos &&
         !(point > 0 && digit(point - 1) && digit(point + 1));
}

// What to write instead, where a text has no quotes, as 4 mm, or a number or a comment is written as elsewhere; ""
// where it is none of these.
std::string remedy_of(std::string_view reason, std::string_view line, std::size_t column) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  const std::string_view value = value_at(line, column);
  const std::size_t letter = value.find_first_of(letters);
  if (const std::string_view remedy = remedy_of(reason); !remedy.empty())
    return std::string(remedy);
  if (value.empty() || value.find_first_of("\"'") != value.npos)
    return "";
  if (value.find("//") != value.npos || value.find(" --") != value.npos)
    return ": a comment begins with #";
  if (has_bare_point(value))
    return ": a number has digits on both sides of its point, as 0.5 or 5.0";
  if (letter == 0 && reason.ends_with("could not determine value type")) // else a key, or a heading
    return fmt::format(": a text is written in quotes, \"{}\"", value);
  if (value.find_first_of("+-.0123456789") != 0)
    return "";
  if (letter != value.npos)
    return fmt::format(": a number with a unit is written in quotes, \"{}\"", value);
  return column <= line.size() && line[column - 1] == ',' ? ": write a decimal point, not a comma" : "";
}

} // namespace

Node parse_toml(std::string_view text, std::string_view name) {
  if (text.starts_with("SHEETFRM") || text.starts_with("SHEETEND") || text.starts_with("sheet-text"))
    fail(ExitCode::bad_input,
         "{}: this is a sheet stream, not a scene: sheet-info tells what is in it, sheet-loop --resume goes on with "
         "it{}",
         name, text.starts_with('S') ? "" : " (its text form: sheet-parse makes a stream of it)");
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
    const toml::source_position at = error.source().begin;
    if (at.line > 0 && at.column > 0)
      reason += remedy_of(reason, line_of(ascii.text, at.line), at.column);
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
