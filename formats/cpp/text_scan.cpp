// SPDX-License-Identifier: MIT
#include "formats/cpp/text_scan.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "formats/cpp/foreign_mesh.h"

namespace sheet::formats {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_white(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+')
    token.remove_prefix(1);
  return token;
}

} // namespace

std::optional<double> parse_real(std::string_view token) {
  token = without_plus(token);
  double value = 0.0;
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (stop != end || token.empty())
    return std::nullopt;
  if (error == std::errc::result_out_of_range && token.find("e-") == token.npos && token.find("E-") == token.npos)
    return std::nullopt;
  if (error == std::errc::result_out_of_range)
    return 0.0;
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  token = without_plus(token);
  std::int64_t value = 0;
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

void append_real(std::string& text, double value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), result.ptr);
}

std::string quoted(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : token.substr(0, longest))
    text += c >= ' ' && c <= '~' ? c : '?';
  return text + (token.size() > longest ? "...'" : "'");
}

void mesh_fail(const std::string& file, const std::string& place, const std::string& problem) {
  throw MeshFileError(MeshFileError::Kind::content, file + ": " + (place.empty() ? "" : place + ": ") + problem);
}

TextScan::TextScan(std::string_view text, std::string file, char comment, Continuation continuation)
    : text_(text), file_(std::move(file)), comment_(comment), continuation_(continuation) {}

void TextScan::skip_line_end() {
  if (at_ < text_.size() && text_[at_] == '\r')
    ++at_;
  else if (at_ < text_.size() && text_[at_] == '\n') {
    ++at_;
    return;
  }
  if (at_ > 0 && at_ < text_.size() && text_[at_ - 1] == '\r' && text_[at_] == '\n')
    ++at_;
}

bool TextScan::next_line() {
  if (line_ > 0) {
    while (at_ < text_.size() && !is_line_end(text_[at_]))
      ++at_;
    skip_line_end();
  }
  if (at_ >= text_.size())
    return false;
  ++line_;
  return true;
}

bool TextScan::next_filled_line() {
  while (next_line()) {
    skip_blanks();
    if (at_ < text_.size() && !is_line_end(text_[at_]))
      return true;
  }
  return false;
}

void TextScan::skip_blanks() {
  while (at_ < text_.size() && is_white(text_[at_]))
    ++at_;
  if (comment_ != 0 && at_ < text_.size() && text_[at_] == comment_)
    while (at_ < text_.size() && !is_line_end(text_[at_]))
      ++at_;
  // a backslash at the very end of a line joins it with the next one
  if (continuation_ == Continuation::backslash && at_ + 1 < text_.size() && text_[at_] == '\\' &&
      is_line_end(text_[at_ + 1])) {
    ++at_;
    skip_line_end();
    ++line_;
    while (at_ < text_.size() && is_white(text_[at_]))
      ++at_;
  }
}

std::string_view TextScan::word() {
  skip_blanks();
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_white(text_[at_]) && !is_line_end(text_[at_]) &&
         (comment_ == 0 || text_[at_] != comment_) &&
         !(continuation_ == Continuation::backslash && at_ > start && text_[at_] == '\\'))
    ++at_;
  return text_.substr(start, at_ - start);
}

std::string_view TextScan::word_across_lines() {
  if (line_ == 0 && !next_line())
    return {};
  for (;;) {
    const std::string_view token = word();
    if (!token.empty())
      return token;
    if (!next_line())
      return {};
  }
}

double TextScan::to_real(std::string_view token, const char* what) const {
  const std::optional<double> value = parse_real(token);
  if (!value)
    fail(token.empty() ? std::string(what) + " is missing"
                       : std::string(what) + " is not a number: " + quoted(token) +
                             (token.find(',') != token.npos ? "; write numbers with a decimal point" : ""));
  if (!std::isfinite(*value))
    fail(std::string(what) + " is not finite: " + quoted(token));
  return *value;
}

double TextScan::real(const char* what) { return to_real(word(), what); }

std::int64_t TextScan::integer(const char* what) {
  const std::string_view token = word();
  const std::optional<std::int64_t> value = parse_integer(token);
  if (!value)
    fail(token.empty() ? std::string(what) + " is missing"
                       : std::string(what) + " is not a whole number: " + quoted(token));
  return *value;
}

void TextScan::fail(const std::string& problem) const { mesh_fail(file_, "line " + std::to_string(line_), problem); }

} // namespace sheet::formats
