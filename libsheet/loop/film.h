// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a stream whose frames become pictures: once or, from a file, twice.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "formats/cpp/stream_frame.h"

namespace sheet {

struct FilmOptions {
  std::string input = "-"; // a stream's file, "-" for standard input
  std::string frames;      // ranges as parse_indices reads them; "": all
  std::string view;        // likewise: frames to survey; "": those to draw
  std::uint64_t least = 0; // pictures: the last frame is drawn again until there are so many
};

// Calls `survey` with each frame to survey if the input is a file, then `draw` with each one to draw and its number in
// the stream; `draw` tells its progress (0 to 1) and returns a line about the picture, which is shown with -v. Shows
// what part is done and the time left if stderr is a terminal. An Error thrown by either gets the number of the frame.
// Of a stream that is cut short the whole frames are drawn first. Throws Error: usage (frames counted from the end of a
// pipe), bad_input (no such frames).
void run_film(
    const FilmOptions& options, const std::function<void(const formats::Frame&)>& survey,
    const std::function<std::string(const formats::Frame&, std::uint64_t, const std::function<void(double)>&)>& draw);

} // namespace sheet
