// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/loop/process_state.h"

#include <fstream>
#include <string>

namespace sheet {

std::optional<std::uint64_t> bytes_written(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/io");
  std::uint64_t value = 0;
  for (std::string name; file >> name >> value;)
    if (name == "wchar:")
      return value;
  return std::nullopt;
}

bool is_asleep(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(')'); // a name may hold anything
  return name_end != std::string::npos && text.compare(name_end, 3, ") S") == 0;
}

} // namespace sheet
