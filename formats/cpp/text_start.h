// SPDX-License-Identifier: MIT
// What files begin with that are not what is expected: what they are, and what to do.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace sheet::formats {

// Text without the byte order mark that some programs put before UTF-8.
[[nodiscard]] constexpr std::string_view without_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.substr(text.starts_with(mark) ? mark.size() : 0);
}

// Whether it is UTF-16, by its byte order mark or by zeros in every other of the first bytes.
[[nodiscard]] constexpr bool is_utf16(std::string_view text) {
  if (text.size() < 4)
    return false;
  const auto zeros_at = [&](std::size_t i) {
    return text[i] == 0 && text[i + 2] == 0 && text[1 - i] != 0 && text[3 - i] != 0;
  };
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || zeros_at(0) || zeros_at(1);
}

// The program that has compressed what begins so, and unpacks it with -dc; "" if none has.
[[nodiscard]] constexpr std::string_view compressor_of(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> beginnings[] = {
      {"\x28\xB5\x2F\xFD", "zstd"}, {"\x1F\x8B", "gzip"}, {{"\xFD\x37zXZ\0", 6}, "xz"}, {"BZh", "bzip2"}};
  for (const auto& [beginning, program] : beginnings)
    if (bytes.starts_with(beginning))
      return program;
  return "";
}

// Why `bytes` are no text, and what to do; "" if they may be one.
[[nodiscard]] inline std::string find_no_text(std::string_view bytes) {
  if (is_utf16(bytes))
    return "it is UTF-16, as some programs save text; save it as UTF-8, or: iconv -f UTF-16 -t UTF-8 OLD > NEW";
  const std::string program(compressor_of(bytes));
  return program.empty() ? "" : "it is compressed: " + program + " -dc OLD > NEW";
}

} // namespace sheet::formats
