// SPDX-License-Identifier: MIT
#include "formats/cpp/printable.h"

#include <cstddef>

namespace sheet::formats {

namespace {

// Bytes of the UTF-8 character that starts the text; 0 if none does.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length > text.size())
    return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80)
      return 0;
  return length;
}

void append_escape(std::string& out, const char* kind, unsigned char value) {
  constexpr char digits[] = "0123456789abcdef";
  out += kind;
  out += digits[value >> 4];
  out += digits[value & 15];
}

} // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t length = utf8_length(text);
    if (length == 0 || (first < 0x20 && first != '\n' && first != '\t') || first == 0x7f)
      append_escape(out, "\\x", first);
    else if (length == 2 && first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0)
      append_escape(out, "\\u00", static_cast<unsigned char>(text[1]));
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

} // namespace sheet::formats
