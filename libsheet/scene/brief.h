// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in what --check says.
#pragma once
#include <string>

#include <fmt/format.h>

namespace sheet::scene {

// Three digits.
[[nodiscard]] inline std::string brief(double value) { return fmt::format("{:.3g}", value); }

} // namespace sheet::scene
