// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include <fmt/core.h>
#include <unistd.h>

#include "formats/cpp/stream_layout.h"
#include "formats/cpp/stream_text.h"
#include "formats/cpp/text_start.h"

namespace sheet::formats {

namespace {

constexpr std::size_t first_buffer_size = 256u << 10;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "nan:" and the bits in hexadecimal, which must be those of a NaN.
template <class T> bool parse_nan(std::string_view digits, T& x) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  Bits bits = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    return false;
  x = std::bit_cast<T>(bits);
  return std::isnan(x);
}

template <class T> bool parse_number(std::string_view word, T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    if (word.starts_with("nan:"))
      return parse_nan(word.substr(4), x);
    const std::string_view magnitude = word.substr(word.starts_with('-') ? 1 : 0);
    if (!magnitude.empty() && !is_digit(magnitude[0]) && magnitude[0] != '.' && word != "nan" && magnitude != "inf")
      return false; // what std::from_chars would take besides
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  return error == std::errc() && end == word.data() + word.size();
}

template <class T> std::string expected() {
  if constexpr (std::is_floating_point_v<T>)
    return fmt::format("a {}: decimal, inf, -inf, nan or nan:BITS", name_of(type_of<T>()));
  else
    return fmt::format("a {}: whole number from {} to {}", name_of(type_of<T>()), std::numeric_limits<T>::min(),
                       std::numeric_limits<T>::max());
}

// The enumerator of that name, from `first` to `last`.
template <class Enum> std::optional<Enum> find_named(std::string_view name, Enum first, Enum last) {
  for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i)
    if (name_of(static_cast<Enum>(i)) == name)
      return static_cast<Enum>(i);
  return std::nullopt;
}

} // namespace

TextParser::TextParser(int descriptor, std::string name)
    : descriptor_(descriptor), name_(std::move(name)), buffer_(first_buffer_size) {}

// `word` is part of the current line.
void TextParser::fail(std::string_view word, const std::string& what) const {
  const auto column = word.data() - line_.data() + 1;
  throw StreamError(StreamError::Kind::value, fmt::format("{}:{}:{}: {}", name_, number_, column, what));
}

void TextParser::cut_short(const std::string& what) const {
  throw StreamError(StreamError::Kind::corrupt, fmt::format("{}:{}:1: cut short: {}", name_, number_ + 1, what));
}

// Reads a line, of any kind. False at the end of the input.
bool TextParser::read_line() {
  std::size_t searched = begin_;
  for (;;) {
    if (const void* const found = std::memchr(buffer_.data() + searched, '\n', filled_ - searched)) {
      const auto size = static_cast<std::size_t>(static_cast<const char*>(found) - (buffer_.data() + begin_));
      line_ = {buffer_.data() + begin_, size};
      begin_ += size + 1;
      break;
    }
    if (begin_ > 0) {
      std::memmove(buffer_.data(), buffer_.data() + begin_, filled_ - begin_);
      filled_ -= begin_;
      begin_ = 0;
    }
    searched = filled_;
    if (filled_ == buffer_.size())
      buffer_.resize(2 * buffer_.size());
    const ssize_t got = ::read(descriptor_, buffer_.data() + filled_, buffer_.size() - filled_);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      throw StreamError(StreamError::Kind::io, fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
    filled_ += static_cast<std::size_t>(got);
    if (got > 0)
      continue;
    if (filled_ == 0)
      return false;
    line_ = {buffer_.data(), filled_}; // the last line has no newline
    begin_ = filled_;
    break;
  }
  if (++number_ == 1) {
    line_ = without_mark(line_);
    if (const std::string error = find_no_text(line_); !error.empty())
      fail(line_, error);
    returns_ = line_.ends_with('\r');
  }
  if (returns_ && line_.ends_with('\r'))
    line_.remove_suffix(1);
  return true;
}

// Reads a line that is neither blank nor a comment.
bool TextParser::next_line() {
  if (again_) {
    again_ = false;
    rest_ = line_;
    return true;
  }
  do
    if (!read_line())
      return false;
  while (line_.starts_with('#') || std::all_of(line_.begin(), line_.end(), is_blank));
  rest_ = line_;
  return true;
}

// The next word of the line; empty at its end.
std::string_view TextParser::next_word() {
  const auto* const start = std::find_if_not(rest_.data(), rest_.data() + rest_.size(), is_blank);
  const auto* const end = std::find_if(start, rest_.data() + rest_.size(), is_blank);
  rest_ = {end, rest_.size() - static_cast<std::size_t>(end - rest_.data())};
  return {start, static_cast<std::size_t>(end - start)};
}

void TextParser::expect_line_end(std::string_view what) {
  if (const std::string_view word = next_word(); !word.empty())
    fail(word, fmt::format("\"{}\" stands behind {}: remove it", word, what));
}

template <class T> T TextParser::expect_number() {
  const std::string_view word = next_word();
  T number{};
  if (!parse_number(word, number))
    fail(word, fmt::format("\"{}\" is not {}", word, expected<T>()));
  return number;
}

template <class T> T TextParser::expect_setting(std::string_view key) {
  if (!next_line())
    cut_short(fmt::format("\"{} NUMBER\" is expected", key));
  if (const std::string_view word = next_word(); word != key)
    fail(word, fmt::format("\"{}\" stands where \"{} NUMBER\" is expected", word, key));
  const T number = expect_number<T>();
  expect_line_end("the number");
  return number;
}

void TextParser::read_version() {
  const std::string_view word = next_word();
  if (word.starts_with("SHEETFRM") || word.starts_with("SHEETEND"))
    fail(word, "this is a binary sheet stream already: it needs no parsing");
  if (word != "sheet-text")
    fail(word, "not the text form of a sheet stream: its first line is \"sheet-text 1.0\"");
  const std::string_view version = next_word();
  if (!version.starts_with("1.") || version.size() < 3 || !std::all_of(version.begin() + 2, version.end(), is_digit))
    fail(version, fmt::format("version \"{}\" of the text form is not 1.0", version));
  expect_line_end("the version");
}

TextParser::Item TextParser::read(Frame& frame) {
  for (;;) {
    if (!next_line()) {
      if (ended_)
        return Item::nothing;
      cut_short(started_ ? "the last line is \"end\"" : "the text is empty, its first line is \"sheet-text 1.0\"");
    }
    if (!started_ || (ended_ && line_.starts_with("sheet-text"))) { // texts join by cat, as streams do
      read_version();
      started_ = true;
      ended_ = false;
      continue;
    }
    const std::string_view word = next_word();
    if (word != "frame" && word != "end")
      fail(word, fmt::format("\"{}\" stands where \"frame\" or \"end\" is expected", word));
    expect_line_end(word);
    ended_ = word == "end";
    if (ended_)
      return Item::end;
    read_frame(frame);
    return Item::frame;
  }
}

void TextParser::read_frame(Frame& frame) {
  frame.arrays.clear();
  frame.time = expect_setting<double>("time");
  frame.step = expect_setting<std::uint64_t>("step");
  frame.vertices = expect_setting<std::uint64_t>("vertices");
  frame.triangles = expect_setting<std::uint64_t>("triangles");
  frame.edges = expect_setting<std::uint64_t>("edges");
  if (const std::string error = find_header_error(frame); !error.empty())
    fail(line_, error);
  while (next_line()) {
    const std::string_view word = next_word();
    if (word == "frame" || word == "end") {
      again_ = true;
      break;
    }
    if (word != "array")
      fail(word, fmt::format("\"{}\" stands where \"array\", \"frame\" or \"end\" is expected", word));
    frame.arrays.push_back(read_entry(frame));
    read_data(frame.arrays.back());
  }
  if (const std::string error = find_table_error(frame); !error.empty())
    fail(line_, error);
}

// Reads a line "array NAME PLACE TYPE COMPONENTS UNIT RULE [critical]" behind its first word.
Array TextParser::read_entry(const Frame& frame) {
  Array array;
  const std::string_view name = next_word(), place = next_word(), type = next_word();
  array.name = name;
  array.components = expect_number<std::uint32_t>();
  array.unit = next_word();
  const std::string_view transfer = next_word(), critical = next_word();

  const auto found_type = find_named(type, Type::int8, Type::text);
  if (!found_type)
    fail(type, fmt::format("\"{}\" is not a type: int8 uint8 int32 uint32 int64 uint64 float32 float64 text", type));
  array.type = *found_type;

  const bool counted = place.starts_with("frame[") && place.ends_with(']');
  const auto found_place = find_named(counted ? place.substr(0, 5) : place, Place::vertex, Place::frame);
  if (!found_place)
    fail(place, fmt::format("\"{}\" is not a place: vertex, triangle, edge, frame[ROWS] or, for text, frame", place));
  array.place = *found_place;
  array.rows = frame.rows_at(array.place);
  if (array.place == Place::frame && counted != (array.type != Type::text))
    fail(place, counted ? "text counts its rows itself: write \"frame\"" : "how many rows? write \"frame[ROWS]\"");
  if (counted && !parse_number(place.substr(6, place.size() - 7), array.rows))
    fail(place, fmt::format("\"{}\" does not say how many rows: write \"frame[ROWS]\"", place));

  const auto found_transfer = find_named(transfer, Transfer::drop, Transfer::mean);
  if (!found_transfer)
    fail(transfer, fmt::format("\"{}\" is not a rule: drop copy interpolate conserve common mean", transfer));
  array.transfer = *found_transfer;
  array.critical = critical == "critical";
  if (!critical.empty() && !array.critical)
    fail(critical, fmt::format("\"{}\" stands where \"critical\" or nothing is expected", critical));
  expect_line_end("critical");

  if (frame.find(array.name) != nullptr)
    fail(name, fmt::format("array \"{}\" appears twice", name));
  if (frame.arrays.size() == layout::max_arrays)
    fail(name, fmt::format("a frame may have {} arrays, this is one more", layout::max_arrays));
  if (const std::string error = find_entry_error(array, frame); !error.empty())
    fail(name, fmt::format("array \"{}\": {}", name, error));
  return array;
}

void TextParser::read_text(Array& array) {
  std::string text;
  for (bool first = true; next_line(); first = false) {
    if (!line_.starts_with('|')) {
      again_ = true;
      break;
    }
    if (!first)
      text += '\n';
    if (line_.size() > 1 && line_[1] != ' ')
      fail(line_, "a line of text starts with \"| \"");
    if (line_.size() > 1)
      text += line_.substr(2);
  }
  array.rows = text.size();
  array.data.assign(reinterpret_cast<const std::byte*>(text.data()), text.size());
  if (const std::string error = find_data_error(array); !error.empty())
    fail(line_, fmt::format("array \"{}\", which ends above: {}", array.name, error));
}

template <class T> void TextParser::read_rows(Array& array) {
  std::size_t room = 0, count = 0; // values; the memory grows with the text that is really there
  for (std::uint64_t row = 0; row < array.rows; ++row) {
    if (!next_line())
      cut_short(fmt::format("array \"{}\" has {} of {} rows", array.name, row, array.rows));
    for (std::uint32_t component = 0; component < array.components; ++component) {
      if (count == room) {
        room = std::max<std::size_t>(1024, 2 * room);
        array.data.resize(room * sizeof(T));
      }
      const T number = expect_number<T>();
      std::memcpy(array.data.data() + count++ * sizeof(T), &number, sizeof(T));
    }
    expect_line_end("the row");
  }
  array.data.resize(count * sizeof(T));
}

void TextParser::read_data(Array& array) {
  switch (array.type) {
  case Type::int8:
    return read_rows<std::int8_t>(array);
  case Type::uint8:
    return read_rows<std::uint8_t>(array);
  case Type::int32:
    return read_rows<std::int32_t>(array);
  case Type::uint32:
    return read_rows<std::uint32_t>(array);
  case Type::int64:
    return read_rows<std::int64_t>(array);
  case Type::uint64:
    return read_rows<std::uint64_t>(array);
  case Type::float32:
    return read_rows<float>(array);
  case Type::float64:
    return read_rows<double>(array);
  case Type::text:
    return read_text(array);
  }
}

} // namespace sheet::formats
