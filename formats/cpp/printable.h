// SPDX-License-Identifier: MIT
// Text from a file, for a terminal.
#pragma once
#include <string>
#include <string_view>

namespace sheet::formats {

// The text with what would command a terminal rather than be seen on it made visible: control characters other than
// line break and tab as \x1b, those beyond ASCII as \u009b, bytes that are no UTF-8 as \xff.
[[nodiscard]] std::string printable(std::string_view text);

} // namespace sheet::formats
