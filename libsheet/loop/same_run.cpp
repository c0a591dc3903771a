// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/same_run.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace sheet {

namespace {

std::string text_of(const formats::Frame& frame, const char* name) {
  const formats::Array* array = frame.find(name);
  return array == nullptr ? std::string() : std::string(array->text());
}

// Each command of the provenance, and how often it ran.
std::map<std::string, std::uint64_t> commands_of(const formats::Frame& frame) {
  std::map<std::string, std::uint64_t> counts;
  std::istringstream lines(text_of(frame, "provenance"));
  std::uint64_t count = 0;
  for (std::string command; lines >> count && std::getline(lines, command);)
    counts[command] += count;
  return counts;
}

} // namespace

bool same_run(const formats::Frame& older, const formats::Frame& newer) {
  const auto before = commands_of(older), after = commands_of(newer);
  for (const auto& [command, count] : before) {
    const auto it = after.find(command);
    if (it == after.end() || it->second < count)
      return false;
  }
  return text_of(older, "scene") == text_of(newer, "scene") || std::any_of(after.begin(), after.end(), [&](auto& line) {
           return line.first.find(" --set ") != std::string::npos && !before.contains(line.first);
         });
}

} // namespace sheet
