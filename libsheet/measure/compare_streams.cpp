// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/compare_streams.h"

#include <fmt/core.h>

#include "formats/cpp/stream_reader.h"
#include "libsheet/base/error.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"

namespace sheet {

bool streams_differ(const std::string& first, const std::string& second, const CompareOptions& options) {
  if (first == "-" && second == "-")
    fail(ExitCode::usage, "standard input cannot be both streams");
  const InputFile in_a(first), in_b(second);
  OutputFile out("-", OutputFile::Content::text);
  formats::StreamReader a(in_a.descriptor(), in_a.name()), b(in_b.descriptor(), in_b.name());
  formats::Frame frame_a, frame_b;
  const bool quiet = log::level() == log::Level::quiet;
  bool different = false, more_a = a.read(frame_a), more_b = b.read(frame_b);
  for (; more_a && more_b; more_a = a.read(frame_a), more_b = b.read(frame_b)) {
    for (const std::string& line : compare(frame_a, frame_b, options)) {
      different = true;
      if (!quiet)
        out.write(fmt::format("frame {}: {}\n", a.frames() - 1, line));
    }
    if (different && quiet)
      return true;
  }
  if (more_a != more_b) {
    different = true;
    while (more_a && a.read(frame_a)) // to count them
      continue;
    while (more_b && b.read(frame_b))
      continue;
    if (!quiet)
      out.write(fmt::format("{} frames in the first, {} in the second\n", a.frames(), b.frames()));
  }
  out.close();
  return different;
}

} // namespace sheet
