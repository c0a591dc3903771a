// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of CSV [RFC 4180].
#pragma once
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace sheet {

// "nan" whatever the NaN's sign; else the shortest text that reads back as the same double.
[[nodiscard]] inline std::string csv_number(double x) { return std::isnan(x) ? "nan" : fmt::format("{}", x); }

// In quotes where it needs them.
[[nodiscard]] inline std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

} // namespace sheet
