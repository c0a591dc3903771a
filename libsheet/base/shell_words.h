// SPDX-License-Identifier: GPL-3.0-or-later
// Words as a shell reads and writes them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sheet {

// The shell's quoting, where a word needs it, on one line: 'it'\''s', $'two\nlines'.
[[nodiscard]] std::string shell_quoted(std::string_view word);

// The words of a line of which each is plain or as shell_quoted writes it, up to a comment (a word that begins with #).
[[nodiscard]] std::vector<std::string> shell_words(std::string_view line);

} // namespace sheet
