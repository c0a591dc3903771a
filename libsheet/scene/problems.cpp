// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/problems.h"

#include <algorithm>
#include <tuple>

#include "libsheet/base/error.h"

namespace sheet::scene {
namespace {

// Insertions, deletions, replacements and swaps of neighbours that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

} // namespace

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

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t longest = 40;
  if (word.size() > longest)
    return {};
  std::string_view best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3 + 1);
  for (const std::string_view candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least || (distance == least && best.empty() && distance < candidate.size())) {
      best = candidate;
      least = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (const auto near = nearest(word, known); !near.empty())
    return fmt::format("; did you mean \"{}\"?", near);
  if (known.empty())
    return "";
  std::string list;
  for (const auto name : known)
    list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
  return "; known: " + list;
}

} // namespace sheet::scene
