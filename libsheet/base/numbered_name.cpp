// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/numbered_name.h"

#include <cctype>
#include <charconv>
#include <filesystem>

#include "libsheet/base/error.h"

namespace sheet {

NumberedName::NumberedName(const std::string& pattern) {
  std::string* part = &before_;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      *part += pattern[i];
      continue;
    }
    if (++i < pattern.size() && pattern[i] == '%') {
      *part += '%';
      continue;
    }
    const std::size_t start = i;
    while (i < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[i])) != 0)
      ++i;
    Number number;
    std::from_chars(pattern.data() + start, pattern.data() + i, number.width);
    if (i == pattern.size() || pattern[i] != 'd' || i - start > 3 || number_)
      fail(ExitCode::usage, "\"{}\": one %d, such as %04d, may stand for the frame's number; %% is a percent sign",
           pattern);
    number.fill = pattern[start] == '0' ? '0' : ' ';
    number_ = number;
    part = &after_;
  }
}

std::string NumberedName::of(std::uint64_t index) const {
  if (!number_)
    return before_;
  std::string digits = std::to_string(index);
  if (digits.size() < number_->width)
    digits.insert(0, number_->width - digits.size(), number_->fill);
  return before_ + digits + after_;
}

std::string NumberedName::collection(const std::string& ending) const {
  const std::filesystem::path all(before_ + after_);
  std::string stem = std::filesystem::path(before_).filename().string();
  while (!stem.empty() && std::string_view("_-. ").find(stem.back()) != std::string_view::npos)
    stem.pop_back();
  return (all.parent_path() / ((stem.empty() ? "frames" : stem) + ending)).string();
}

} // namespace sheet
