// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include <unistd.h>

#include "formats/cpp/printable.h"
#include "formats/cpp/stream_text.h"
#include "formats/cpp/stream_writer.h"

namespace sheet::formats {

namespace {

constexpr std::size_t buffer_size = 256u << 10;
constexpr std::size_t longest_number = 32; // characters

template <class T> char* put_not_finite(char* to, T x) {
  if (std::isinf(x)) {
    const std::string_view text = x < 0 ? "-inf" : "inf";
    return std::copy(text.begin(), text.end(), to);
  }
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  const Bits bits = std::bit_cast<Bits>(x);
  to = std::copy_n("nan", 3, to);
  if (bits == std::bit_cast<Bits>(std::numeric_limits<T>::quiet_NaN()))
    return to;
  *to++ = ':';
  for (int shift = 8 * sizeof(T) - 4; shift >= 0; shift -= 4)
    *to++ = "0123456789abcdef"[(bits >> shift) & 15];
  return to;
}

// The fewest digits that read back to the same bits, written plainly from 1e-4 up to 1e16, with an exponent elsewhere.
template <class T> char* put_floating(char* to, T x) {
  if (!std::isfinite(x))
    return put_not_finite(to, x);
  char text[longest_number]; // [-]d[.ddd]e(+|-)dd[d]
  const char* const end = std::to_chars(text, text + longest_number, x, std::chars_format::scientific).ptr;
  const char* p = text;
  if (*p == '-')
    *to++ = *p++;
  const char* const e = std::find(p, end, 'e');
  int exponent = 0;
  std::from_chars(e + (e[1] == '+' ? 2 : 1), end, exponent);
  if (exponent < -4 || exponent >= 16)
    return std::copy(p, end, to);
  char digits[longest_number];
  digits[0] = *p;
  const int count = e - p > 2 ? static_cast<int>(std::copy(p + 2, e, digits + 1) - digits) : 1;
  if (exponent < 0) {
    to = std::copy_n("0.000", 1 - exponent, to);
    return std::copy_n(digits, count, to);
  }
  const int whole = exponent + 1; // digits before the point
  to = std::copy_n(digits, std::min(whole, count), to);
  if (count <= whole)
    return std::fill_n(to, whole - count, '0');
  *to++ = '.';
  return std::copy_n(digits + whole, count - whole, to);
}

} // namespace

TextPrinter::TextPrinter(int descriptor, std::string name)
    : descriptor_(descriptor), name_(std::move(name)), terminal_(::isatty(descriptor) != 0), buffer_(buffer_size) {}

void TextPrinter::flush() {
  write_all(descriptor_, std::as_bytes(std::span(buffer_.data(), used_)), name_);
  used_ = 0;
}

void TextPrinter::put(std::string_view text) {
  while (!text.empty()) {
    if (used_ == buffer_size)
      flush();
    const std::size_t size = std::min(text.size(), buffer_size - used_);
    std::memcpy(buffer_.data() + used_, text.data(), size);
    used_ += size;
    text.remove_prefix(size);
  }
}

template <class T> void TextPrinter::put_number(T number) {
  if (buffer_size - used_ < longest_number)
    flush();
  char* const to = buffer_.data() + used_;
  char* end;
  if constexpr (std::is_floating_point_v<T>)
    end = put_floating(to, number);
  else
    end = std::to_chars(to, to + longest_number, number).ptr;
  used_ = static_cast<std::size_t>(end - buffer_.data());
}

template <class T> void TextPrinter::put_rows(const Array& array) {
  const auto values = array.values<T>();
  std::size_t i = 0;
  for (std::uint64_t row = 0; row < array.rows; ++row)
    for (std::uint32_t component = 1; component <= array.components; ++component) {
      put_number(values[i++]);
      put(component < array.components ? " " : "\n");
    }
}

void TextPrinter::put_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = text.find('\n');
    const std::string_view line = text.substr(0, size);
    put(line.empty() ? "|" : "| ");
    put(line);
    put("\n");
    if (size == text.npos)
      return;
    text.remove_prefix(size + 1);
    if (text.empty())
      put("|\n");
  }
}

void TextPrinter::put_array(const Array& array) {
  put("array ");
  put(array.name);
  put(" ");
  put(name_of(array.place));
  if (array.place == Place::frame && array.type != Type::text) {
    put("[");
    put_number(array.rows);
    put("]");
  }
  for (const std::string_view word : {std::string_view(" "), name_of(array.type), std::string_view(" ")})
    put(word);
  put_number(array.components);
  for (const std::string_view word :
       {std::string_view(" "), std::string_view(array.unit), std::string_view(" "), name_of(array.transfer)})
    put(word);
  put(array.critical ? " critical\n" : "\n");
  switch (array.type) {
  case Type::int8:
    return put_rows<std::int8_t>(array);
  case Type::uint8:
    return put_rows<std::uint8_t>(array);
  case Type::int32:
    return put_rows<std::int32_t>(array);
  case Type::uint32:
    return put_rows<std::uint32_t>(array);
  case Type::int64:
    return put_rows<std::int64_t>(array);
  case Type::uint64:
    return put_rows<std::uint64_t>(array);
  case Type::float32:
    return put_rows<float>(array);
  case Type::float64:
    return put_rows<double>(array);
  case Type::text:
    return terminal_ ? put_text(printable(array.text())) : put_text(array.text());
  }
}

void TextPrinter::put_ends(std::uint64_t ends) {
  if (!started_)
    put("sheet-text 1.0\n");
  started_ = true;
  for (; ends_ < ends; ++ends_)
    put("end\n");
}

void TextPrinter::print(const Frame& frame, std::uint64_t ends) {
  if (const std::string error = find_form_error(frame); !error.empty())
    throw StreamError(StreamError::Kind::value, "cannot print frame: " + error);
  put_ends(ends);
  put("frame\ntime ");
  put_number(frame.time);
  put("\nstep ");
  put_number(frame.step);
  put("\nvertices ");
  put_number(frame.vertices);
  put("\ntriangles ");
  put_number(frame.triangles);
  put("\nedges ");
  put_number(frame.edges);
  put("\n");
  for (const Array& array : frame.arrays)
    put_array(array);
  flush();
}

void TextPrinter::end(std::uint64_t ends) {
  put_ends(ends);
  flush();
}

} // namespace sheet::formats
