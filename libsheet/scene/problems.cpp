// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/problems.h"

#include <algorithm>
#include <tuple>

#include "libsheet/base/edit_distance.h"
#include "libsheet/base/error.h"

namespace sheet::scene {

void Problems::throw_if_any() {
  if (found_.empty())
    return;
  constexpr std::size_t most = 100;
  const auto key = [](const Problem& p) { return std::tuple(p.place.set, p.place.line, p.place.column); };
  std::stable_sort(found_.begin(), found_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::string text;
  for (std::size_t i = 0; i < found_.size() && i < most; ++i) {
    const auto& [place, reason] = found_[i];
    if (i > 0)
      text += '\n';
    if (place.set >= 0)
      text += fmt::format("--set {}: {}", sets_[static_cast<std::size_t>(place.set)], reason);
    else if (place.line > 0)
      text += fmt::format("{}:{}:{}: {}", name_, place.line, place.column, reason);
    else
      text += fmt::format("{}: {}", name_, reason);
  }
  if (found_.size() > most)
    text += fmt::format("\n{}: {} more problems", name_, found_.size() - most);
  throw Error(ExitCode::bad_input, text);
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (const auto near = nearest_word(word, known); !near.empty())
    return fmt::format("; did you mean \"{}\"?", near);
  if (known.empty())
    return "";
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (std::ranges::count(known.first(i), known[i]) == 0) // single tables and lists of them share names
      list += fmt::format("{}{}", list.empty() ? "" : ", ", known[i]);
  return "; known: " + list;
}

} // namespace sheet::scene
