// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/live_page.h"

#include <string_view>

#include "libsheet/view/page_parts.h"

namespace sheet::watch {

namespace {

void put(std::string& page, std::string_view mark, std::string_view text) {
  page.replace(page.find(mark), mark.size(), text);
}

} // namespace

std::string live_page() {
  std::string plots; // curves are drawn as sheet-view draws them
  for (const view::PagePart& part : view::page_parts())
    if (part.name == "plots.js")
      plots = part.text;
  std::string page = live_html;
  put(page, "{{STYLE}}", live_css);
  put(page, "{{SCRIPT}}", plots + live_js);
  return page;
}

} // namespace sheet::watch
