// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/log.h"

#include <algorithm>

#include <unistd.h>

#include "formats/cpp/printable.h"

namespace sheet::log {

namespace {

struct State {
  std::string program = "sheet";
  Level level = Level::normal;
};

State& state() {
  static State the_state;
  return the_state;
}

// One write a message, so that lines of several programs on one terminal do not mix.
void write_lines(std::string_view message) {
  std::string text;
  std::size_t start = 0;
  while (start <= message.size()) {
    const std::size_t end = std::min(message.find('\n', start), message.size());
    text += state().program;
    text += ": ";
    text += formats::printable(message.substr(start, end - start));
    text += '\n';
    start = end + 1;
  }
  // Nothing can be done where even stderr is gone.
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

} // namespace

void set_program(std::string_view name) { state().program = name; }
const std::string& program() { return state().program; }
void set_level(Level level) { state().level = level; }
Level level() { return state().level; }

void error(std::string_view message) { write_lines(message); }

void warning(std::string_view message) {
  if (state().level != Level::quiet)
    write_lines(message);
}

void note(std::string_view message) { warning(message); }

void detail(std::string_view message) {
  if (state().level == Level::verbose)
    write_lines(message);
}

} // namespace sheet::log
