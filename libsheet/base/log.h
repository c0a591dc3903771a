// SPDX-License-Identifier: GPL-3.0-or-later
// Messages for people, on stderr, each line headed by the program's name. Data never goes this way.
#pragma once
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace sheet::log {

enum class Level { quiet, normal, verbose };

void set_program(std::string_view name);
[[nodiscard]] const std::string& program();
void set_level(Level level);
[[nodiscard]] Level level();

// Writes "program: message" whatever the level.
void error(std::string_view message);
// The user should know, but the work goes on; silenced by -q.
void warning(std::string_view message);
// What the user asked to be told, as a table of times; silenced by -q.
void note(std::string_view message);
// Only with -v.
void detail(std::string_view message);

template <class... Args> void warning(fmt::format_string<Args...> format, Args&&... args) {
  warning(std::string_view(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args> void note(fmt::format_string<Args...> format, Args&&... args) {
  note(std::string_view(fmt::format(format, std::forward<Args>(args)...)));
}
template <class... Args> void detail(fmt::format_string<Args...> format, Args&&... args) {
  if (level() == Level::verbose)
    detail(std::string_view(fmt::format(format, std::forward<Args>(args)...)));
}

} // namespace sheet::log
