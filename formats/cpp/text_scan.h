// SPDX-License-Identifier: MIT
// Numbers and words of text files, independent of the locale, with line numbers for messages.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sheet::formats {

// The whole token as a number, or nothing. Reals may be nan or inf; what underflows is 0; what overflows is nothing.
[[nodiscard]] std::optional<double> parse_real(std::string_view token);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view token);

// Appends the shortest text that reads back as the same double.
void append_real(std::string& text, double value);

// A word from a file, cut to a bearable length and freed of control characters, in quotes, for a message.
[[nodiscard]] std::string quoted(std::string_view token);

// Throws MeshFileError: "file: line 12: problem; remedy" (place "" is left out).
[[noreturn]] void mesh_fail(const std::string& file, const std::string& place, const std::string& problem);

// Walks through a text line by line and word by word. Lines end with LF, CR or both.
class TextScan {
public:
  enum class Continuation { none, backslash };
  // comment: the character that starts a comment up to the end of the line, or 0
  TextScan(std::string_view text, std::string file, char comment, Continuation continuation = Continuation::none);

  // Goes to the next line; false at the end of the text.
  bool next_line();
  // Goes to the next line that has a word; false at the end of the text.
  bool next_filled_line();
  // The next word of this line, empty at its end.
  std::string_view word();
  // The next word of this or a later line, empty at the end of the text.
  std::string_view word_across_lines();
  // The next word of this line as a finite number / an integer; fails, naming `what`, if there is none.
  double real(const char* what);
  std::int64_t integer(const char* what);
  // The number that a word stands for; fails if it is none or not finite.
  double to_real(std::string_view token, const char* what) const;

  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] std::size_t offset() const { return at_; } // of the first byte not yet taken
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  [[noreturn]] void fail(const std::string& problem) const;

private:
  void skip_blanks();
  void skip_line_end();

  std::string_view text_;
  std::string file_;
  char comment_;
  Continuation continuation_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0; // 1 for the first; 0 before next_line()
};

} // namespace sheet::formats
