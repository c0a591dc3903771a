// SPDX-License-Identifier: GPL-3.0-or-later
// The page that follows a run: state and curves, asked for every second, and the newest frame in sheet-view's page.
#pragma once
#include <string>

namespace sheet::watch {

extern const char* const live_html; // with {{STYLE}} and {{SCRIPT}} for the two others
extern const char* const live_css;
extern const char* const live_js;

[[nodiscard]] std::string live_page();

} // namespace sheet::watch
