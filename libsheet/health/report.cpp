// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/health/report.h"

#include <fmt/format.h>

namespace sheet::health {

namespace {

std::string value_text(const Kind& kind, double value) {
  return kind.told == Told::in_percent ? fmt::format("{:.2g} %", 100 * value) : fmt::format("{:.3g}", value);
}

std::string count_text(const Row& row, const Kind& kind) {
  std::string text = fmt::format("seen {:.0f} time{}", row.times, row.times == 1 ? "" : "s");
  if (row.times > 1)
    text += fmt::format(" from t = {:.4g} to {:.4g} s", row.first, row.last);
  if (!kind.counted.empty() && row.times > 1)
    text += fmt::format(", {:.4g} {} in all", row.amount, kind.counted);
  return text;
}

std::string entry(const Row& row, Verdict verdict) {
  return fmt::format("\n  {}{}\n    {}\n    remedy: {}", verdict == Verdict::serious ? "serious: " : "", sentence(row),
                     count_text(row, *find_kind(row.kind)), remedy(row));
}

} // namespace

std::string sentence(const Row& row) {
  const Kind& kind = *find_kind(row.kind);
  std::string text = fmt::format("{}: ", kind.name);
  text += fmt::format(fmt::runtime(kind.what), value_text(kind, row.worst));
  if (row.place)
    text += fmt::format(", at ({:.4g}, {:.4g}, {:.4g}) m", row.place->x(), row.place->y(), row.place->z());
  text += fmt::format(", t = {:.4g} s", row.worst_time);
  if (row.share > 0)
    text += fmt::format("; on up to {:.2g} % of the area", 100 * row.share);
  return text;
}

std::string remedy(const Row& row) { return std::string(find_kind(row.kind)->remedy); }

std::string report(const formats::Frame& frame) {
  std::string serious, noted;
  for (const Row& row : rows(frame)) {
    const Verdict found = verdict(row, frame.step);
    if (found != Verdict::slight)
      (found == Verdict::serious ? serious : noted) += entry(row, found);
  }
  return serious.empty() && noted.empty() ? std::string() : "what went wrong on the way" + serious + noted;
}

} // namespace sheet::health
