// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/ascii.h"

#include <algorithm>

#include "libsheet/base/error.h"

namespace sheet::scene {
namespace {

constexpr std::size_t largest_text = 4 << 20;
constexpr std::size_t most_escapes = 1000;
constexpr int longest_dotted_key = 16;

// Length of the UTF-8 character that `text` begins with, and its number; length 0 if it is none.
struct Character {
  std::size_t length = 0;
  unsigned long number = 0;
};

Character read_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length)
    return {};
  unsigned long number = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U)
      return {};
    number = number << 6 | (byte(i) & 0x3FU);
  }
  const unsigned long least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  if (number < least || number > 0x10FFFF || (number >= 0xD800 && number <= 0xDFFF))
    return {};
  return {length, number};
}

class Translator {
public:
  Translator(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

  AsciiToml run() {
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '\n')
        end_line();
      else if (static_cast<unsigned char>(c) > 126)
        other_character();
      else if (c == '\0')
        refuse("a zero byte");
      else if (quote_ != 0)
        in_quotes(c);
      else
        outside(c);
    }
    return std::move(result_);
  }

private:
  void end_line() {
    result_.text += '\n';
    rest_.remove_prefix(1);
    line_start_ = result_.text.size();
    extra_ = 0;
    ++line_;
    dots_ = 0;
    quote_ = 0;
  }

  void other_character() {
    if (quote_ == 0)
      refuse("a character that has no place outside of quotes and comments");
    const Character character = read_utf8(rest_);
    if (character.length == 0)
      refuse("this is not UTF-8");
    if (quote_ == '\'')
      refuse("a text with such a character needs double quotes");
    if (result_.escapes.size() == most_escapes)
      refuse("too many characters that are not ASCII");
    const std::string escape = character.number > 0xFFFF ? fmt::format("\\U{:08X}", character.number)
                                                         : fmt::format("\\u{:04X}", character.number);
    const int extra = static_cast<int>(escape.size()) - 1;
    result_.escapes.push_back({line_, column() + extra_, extra});
    result_.text += escape;
    extra_ += extra;
    rest_.remove_prefix(character.length);
  }

  void in_quotes(char c) {
    if (c == quote_)
      quote_ = 0;
    pass();
    // What follows a backslash neither ends the text nor is it one of ours; an escaped line end still ends the line.
    if (c == '\\' && quote_ == '"' && !rest_.empty() && rest_.front() > 0 && rest_.front() < 127 &&
        rest_.front() != '\n')
      pass();
  }

  void outside(char c) {
    if (c == '#') {
      rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      return;
    }
    if (c == '"' || c == '\'') {
      if (rest_.starts_with(std::string(3, c)))
        refuse("a text over several lines has no use in a scene");
      quote_ = c;
    } else if (c == '.') {
      if (++dots_ > longest_dotted_key)
        refuse("too many dots in a key");
    } else if (std::string_view(",=[]{}").find(c) != std::string_view::npos) {
      dots_ = 0;
    }
    pass();
  }

  void pass() {
    result_.text += rest_.front();
    rest_.remove_prefix(1);
  }

  [[nodiscard]] int column() const { return static_cast<int>(result_.text.size() - line_start_) - extra_ + 1; }

  [[noreturn]] void refuse(std::string_view reason) const {
    fail(ExitCode::bad_input, "{}:{}:{}: {}", name_, line_, column(), reason);
  }

  std::string_view rest_, name_;
  AsciiToml result_;
  std::size_t line_start_ = 0; // in the result
  int line_ = 1, dots_ = 0, extra_ = 0;
  char quote_ = 0;
};

} // namespace

int AsciiToml::original_column(int line, int column) const {
  auto escape =
      std::lower_bound(escapes.begin(), escapes.end(), line, [](const Escape& e, int l) { return e.line < l; });
  int extra = 0;
  for (; escape != escapes.end() && escape->line == line && escape->column < column; ++escape)
    extra += escape->extra;
  return column - extra;
}

AsciiToml to_ascii(std::string_view text, std::string_view name) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3); // a byte order mark
  if (text.size() > largest_text)
    fail(ExitCode::bad_input, "{}: longer than {} bytes", name, largest_text);
  return Translator(text, name).run();
}

} // namespace sheet::scene
