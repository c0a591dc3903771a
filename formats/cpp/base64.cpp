// SPDX-License-Identifier: MIT
#include "formats/cpp/base64.h"

#include <algorithm>
#include <cstdint>

namespace sheet::formats {

namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int value_of(char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  if (c == '+')
    return 62;
  return c == '/' ? 63 : -1;
}

} // namespace

void append_base64(std::string& text, std::string_view bytes) {
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= n ? alphabet[group >> (18 - 6 * k) & 63U] : '=';
  }
}

std::optional<std::string> decode_base64(std::string_view text, std::size_t count) {
  std::string bytes;
  bytes.reserve(std::min(count, text.size() / 4 * 3 + 3));
  std::uint32_t group = 0;
  int digits = 0, padding = 0;
  for (const char c : text) {
    if (bytes.size() >= count)
      break;
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t')
      continue;
    const int value = value_of(c);
    if (c == '=' ? digits + padding < 2 : value < 0 || padding > 0)
      return std::nullopt;
    padding += c == '=' ? 1 : 0;
    digits += c == '=' ? 0 : 1;
    group = group << 6 | static_cast<std::uint32_t>(c == '=' ? 0 : value);
    if (digits + padding < 4)
      continue;
    for (int k = 0; k < 3 - padding && bytes.size() < count; ++k)
      bytes += static_cast<char>(group >> (16 - 8 * k) & 255U);
    group = 0;
    digits = padding = 0;
  }
  return bytes;
}

} // namespace sheet::formats
