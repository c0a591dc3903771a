// SPDX-License-Identifier: GPL-3.0-or-later
// The files of the folder page/, which stand in the program.
#pragma once
#include <string_view>
#include <vector>

namespace sheet::view {

struct PagePart {
  std::string_view name, text;
};
// The HTML first, then the styles, then the scripts in their order.
[[nodiscard]] const std::vector<PagePart>& page_parts();

} // namespace sheet::view
