// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/material_option.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "libsheet/base/error.h"
#include "libsheet/render/slab.h"

namespace sheet::render {

void declare_materials(Tool& tool, std::vector<std::size_t>& values, std::string_view text) {
  const auto& names = liquid_names();
  tool.custom(
      "--material", "NAME[,NAME...]", fmt::format("{}; of {}", text, fmt::join(names, ", ")),
      [&](const std::string& s) {
        values.clear();
        for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
          const std::string name = s.substr(start, (end = s.find(',', start)) - start);
          const auto at = std::ranges::find(names, name);
          if (at == names.end())
            fail(ExitCode::usage, "\"{}\" is not one of {}", name, fmt::join(names, ", "));
          values.push_back(static_cast<std::size_t>(at - names.begin()));
        }
      },
      [&] {
        std::vector<std::string> given;
        for (const std::size_t value : values)
          given.push_back(names[value]);
        return fmt::format("{}", fmt::join(given, ","));
      },
      Tool::Provenance::record, names);
}

} // namespace sheet::render
