// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-pass: a stage that changes nothing; measures what a ring costs by itself, and checks a stream on its way.
#include "libsheet/base/filter.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-pass", "pass frames through unchanged",
      "Reads, checks and writes every frame. It stands for a stage where one is to be left out, checks a stream on "
      "its way, and measures what a ring of programs costs by itself.");
  sheet::FilterOptions filter;
  sheet::declare_filter_options(tool, filter);
  tool.example("sheet-pass run.sheet > /dev/null && echo whole", "is the stream whole?");
  return tool.run(argc, argv, [&] { sheet::run_filter(tool, filter, [](sheet::formats::Frame&) {}); });
}
