// SPDX-License-Identifier: MIT
// What text files begin with that is no text.
#pragma once
#include <cstddef>
#include <string_view>

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

inline constexpr const char* utf16_remedy =
    "it is UTF-16, as some programs save text; save it as UTF-8, or: iconv -f UTF-16 -t UTF-8 OLD > NEW";

} // namespace sheet::formats
