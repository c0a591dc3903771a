// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/filter.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <climits>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"

namespace sheet {

namespace {

using Clock = std::chrono::steady_clock;

// Where sheet-loop runs the stage, it wants to know the time that the stage took: a line on a descriptor that it names.
void report_time(const std::string& name, std::uint64_t frames, Clock::duration busy) {
  const char* variable = std::getenv(report_descriptor_variable);
  if (variable == nullptr)
    return;
  int descriptor = -1;
  const std::string_view text = variable;
  std::from_chars(text.data(), text.data() + text.size(), descriptor);
  if (descriptor <= STDERR_FILENO)
    return;
  const std::string line =
      fmt::format("time {} {} {} {:.6f}\n", ::getpid(), name, frames, std::chrono::duration<double>(busy).count());
  // A missing line is a missing line in a report, no more.
  [[maybe_unused]] const ssize_t ignored = ::write(descriptor, line.data(), line.size());
}

// A frame needs about what the one before it needed, so what is freed is kept, but for the largest pieces (above 32
// MiB, the most that the C library takes): fresh pages cost a twentieth of a step's time.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 16 << 20);
}

} // namespace

void declare_filter_options(Tool& tool, FilterOptions& options) {
  tool.argument("INPUT", options.input, "stream to read; - for standard input");
  tool.option("-o,--output", options.output, "FILE", "stream to write; - for standard output", Tool::Provenance::omit);
  tool.flag("--no-provenance", options.no_provenance, "leave the record of programs and options as it is",
            Tool::Provenance::omit);
}

void run_filter(const Tool& tool, const FilterOptions& options, const std::function<void(formats::Frame&)>& work) {
  keep_freed_memory();
  const InputFile input(options.input);
  OutputFile output(options.output, OutputFile::Content::binary);
  formats::StreamReader reader(input.descriptor(), input.name());
  formats::StreamWriter writer(output.descriptor(), output.name());
  const std::string line = tool.command_line();
  formats::Frame frame;
  Clock::duration busy{};
  while (reader.read(frame)) {
    const auto start = Clock::now();
    try {
      work(frame);
      if (const std::string error = find_value_error(frame); !error.empty())
        fail(ExitCode::bad_input,
             "the result is no valid frame: {}; its numbers are too large or too small to compute "
             "with (sheet-check tells more)",
             error);
    } catch (const Error& error) {
      fail(error.code(), "frame {} (step {}, time {} s): {}", reader.frames() - 1, frame.step, frame.time,
           error.what());
    }
    if (!options.no_provenance)
      record_provenance(frame, line);
    output.start();
    writer.write(frame);
    busy += Clock::now() - start;
  }
  output.start();
  writer.end();
  output.close();
  report_time(tool.name(), reader.frames(), busy);
}

bool in_ring() { return std::getenv(report_descriptor_variable) != nullptr; }

std::string beside_run(const std::string& name) {
  const char* folder = std::getenv(run_folder_variable);
  return folder == nullptr
             ? name
             : (std::filesystem::path(folder) / name).lexically_proximate(std::filesystem::current_path()).string();
}

void record_provenance(formats::Frame& frame, const std::string& line) {
  const formats::Array* old = frame.find("provenance");
  const std::string_view text = old == nullptr ? std::string_view() : old->text();
  std::string updated;
  bool found = false;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view old_line = text.substr(start, end - start);
    start = end + 1;
    const std::size_t blank = old_line.find(' ');
    if (!updated.empty())
      updated += '\n';
    if (!found && blank != std::string_view::npos && old_line.substr(blank + 1) == line) {
      std::uint64_t count = 0;
      std::from_chars(old_line.data(), old_line.data() + blank, count);
      updated += fmt::format("{} {}", count + 1, line);
      found = true;
    } else {
      updated += old_line;
    }
  }
  if (!found)
    updated += fmt::format("{}1 {}", updated.empty() ? "" : "\n", line);
  frame.put_text("provenance", updated);
}

} // namespace sheet
