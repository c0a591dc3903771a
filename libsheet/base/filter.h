// SPDX-License-Identifier: GPL-3.0-or-later
// The frame loop of every stage: frames in, frames out, one for one.
#pragma once
#include <functional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/base/tool.h"

namespace sheet {

struct FilterOptions {
  std::string input = "-";  // a stream's file, "-" for standard input
  std::string output = "-"; // likewise
  bool no_provenance = false;
};

// Declares INPUT, -o and --no-provenance.
void declare_filter_options(Tool& tool, FilterOptions& options);

// Reads every frame of the input, lets `work` change it, adds the tool's provenance, writes it; at the end of the input
// the end mark. An Error thrown by `work` gets the number of the frame; then the output has no end mark, so that
// everybody downstream knows that it was cut short.
void run_filter(const Tool& tool, const FilterOptions& options, const std::function<void(formats::Frame&)>& work);

// Environment variable by which sheet-loop tells its stages the descriptor for a line "time PID NAME FRAMES SECONDS".
inline constexpr const char* report_descriptor_variable = "SHEET_REPORT_FD";
// Whether sheet-loop runs this program.
[[nodiscard]] bool in_ring();

// Environment variable by which sheet-loop tells its stages the folder of the stream that they make.
inline constexpr const char* run_folder_variable = "SHEET_RUN_FOLDER";
// Where a stage puts a file of this name that belongs to the run: beside the stream that sheet-loop writes, else here.
[[nodiscard]] std::string beside_run(const std::string& name);

// Counts `line` in the frame's provenance (formats/sheet.md, section 5).
void record_provenance(formats::Frame& frame, const std::string& line);

} // namespace sheet
