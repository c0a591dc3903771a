// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace sheet::scene {

// A scene that runs as it is, with every table and key explained to users (sheet-init --example). Settings that are not
// in force follow a "#" without a blank; each such block stands for the block of the same keys, or adds what it says.
[[nodiscard]] std::string_view example();

} // namespace sheet::scene
