// SPDX-License-Identifier: MIT
// Base64 (RFC 4648, the plain alphabet).
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sheet::formats {

void append_base64(std::string& text, std::string_view bytes);

// The first `count` bytes that the text stands for (fewer if it ends before), passing over white space; padding may
// also stand inside, between separately encoded parts. Nothing if another character is met.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view text, std::size_t count);

} // namespace sheet::formats
