// SPDX-License-Identifier: GPL-3.0-or-later
// A page for a browser that shows streams, in one file: scripts, styles and data.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet::view {

struct ViewOptions {
  std::vector<std::string> inputs; // files of streams, "-" for standard input
  std::string output = "-";
  std::string title;                  // "": made of the names of the inputs
  std::optional<double> wanted = {};  // thickness, to show the deviation from it [m]
  std::vector<std::size_t> materials; // presets (render::liquid_names) of the scene's liquids in turn; empty: none
};

// Writes the page. Of a stream that is cut short the whole frames are in it; the error is thrown when it is written.
// Throws Error: bad_input (no frames, a solid's mesh that cannot be read), usage, io; StreamError.
void write_page(const ViewOptions& options);

// The page of a single frame; `name` is its title. Throws Error (bad_input: a solid's mesh that cannot be read).
[[nodiscard]] std::string page_of(const formats::Frame& frame, const std::string& name);

} // namespace sheet::view
