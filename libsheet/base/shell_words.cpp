// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/shell_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

namespace sheet {

namespace {

constexpr std::string_view ansi = "$'"; // bash's quotes within which \xHH is a byte

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string ansi_quoted(std::string_view word) {
  std::string quoted(ansi);
  for (const char c : word) {
    if (is_control(c) || c == '\'' || c == '\\')
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + "'";
}

// Reads the word at the line's start, and takes it off.
std::string take_word(std::string_view& line) {
  std::string word;
  char quote = 0; // within which we are: ', or $ for ansi's
  for (; !line.empty() && (quote != 0 || line[0] != ' '); line.remove_prefix(1)) {
    if (line[0] == '\'') {
      quote = quote == 0 ? '\'' : char{0};
    } else if (quote == 0 && line.starts_with(ansi)) {
      quote = '$';
      line.remove_prefix(1);
    } else if (quote == '$' && line.starts_with("\\x") && line.size() >= 4) {
      unsigned byte = 0;
      std::from_chars(line.data() + 2, line.data() + 4, byte, 16);
      word += static_cast<char>(byte);
      line.remove_prefix(3);
    } else if (quote == 0 && line[0] == '\\' && line.size() >= 2) {
      word += line[1];
      line.remove_prefix(1);
    } else {
      word += line[0];
    }
  }
  return word;
}

} // namespace

std::string shell_quoted(std::string_view word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:=+,%@^").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain))
    return std::string(word);
  if (std::any_of(word.begin(), word.end(), is_control))
    return ansi_quoted(word);
  std::string quoted = "'";
  for (const char c : word)
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> shell_words(std::string_view line) {
  std::vector<std::string> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    if (line.empty() || line[0] == '#')
      return words;
    words.push_back(take_word(line));
  }
}

} // namespace sheet
