// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/sheet_kinds.h"

#include <utility>

#include <fmt/format.h>

namespace sheet {

std::vector<std::string> sheet_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const scene::SheetTable& sheet : scene.sheets)
    names.push_back(sheet.name.empty() ? fmt::format("sheet {}", names.size() + 1) : sheet.name);
  return names;
}

SheetKinds::SheetKinds(std::vector<std::string> names) : names_(std::move(names)) {
  for (std::size_t i = 0; i < names_.size(); ++i)
    kinds_.push_back({names_[i], sheet_colours.kinds[i % sheet_colours.kinds.size()].colour});
  palette_.kinds = kinds_;
}

} // namespace sheet
