// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-check: is a stream valid, down to the last triangle?
#include <fmt/format.h>

#include "formats/cpp/printable.h"
#include "formats/cpp/stream_reader.h"
#include "libsheet/base/files.h"
#include "libsheet/base/tool.h"
#include "libsheet/measure/check_report.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-check", "check every frame of a stream for all that may be wrong",
      "Looks for broken rules of the format, values that are not finite, wrong indices, volumes that are not "
      "positive, unused vertices, duplicate triangles, edges and vertices where the sheet is no manifold, "
      "inconsistent orientation, degenerate triangles, and triangles that intersect, all of it exactly. "
      "Prints what it finds, and nothing if all is well.\n"
      "Neighbours may meet in the vertex or edge that they share and nowhere else; other triangles may not "
      "even touch.");
  std::string input = "-";
  sheet::CheckOptions options;
  std::int64_t examples = 5;
  bool json = false, no_intersections = false;
  tool.argument("INPUT", input, "stream to read; - for standard input");
  tool.flag("--no-intersections", no_intersections, "do not look for triangles that intersect");
  tool.option("--examples", examples, "N", "places to name for each kind of problem in a frame");
  tool.flag("--json", json, "print a JSON document: an array with an object for each frame");
  tool.section("kinds", sheet::check_kinds());
  tool.example("sheet-check run.sheet && echo valid", "is all well?");
  tool.example("sheet-init a.toml | sheet-check --json", "for a program");
  tool.exit_status("0 all is well, 3 something is wrong with a frame, 4 the stream is truncated or corrupt, 1 internal "
                   "error, 2 wrong usage, 6 input or output error.");
  return tool.run(argc, argv, [&] {
    if (examples < 0)
      sheet::fail(sheet::ExitCode::usage, "--examples: {} is negative", examples);
    options.examples = static_cast<std::size_t>(examples);
    options.intersections = !no_intersections;
    const sheet::InputFile in(input);
    sheet::OutputFile out("-", sheet::OutputFile::Content::text);
    sheet::formats::StreamReader reader(in.descriptor(), in.name(), sheet::formats::StreamReader::Values::any);
    sheet::formats::Frame frame;
    std::uint64_t bad = 0;
    std::string separator = "[\n";
    while (reader.read(frame)) {
      const std::vector<sheet::Finding> findings = sheet::check(frame, options);
      bad += findings.empty() ? 0 : 1;
      out.write(json ? separator + sheet::findings_json(frame, reader.frames() - 1, findings)
                     : sheet::formats::printable(sheet::findings_text(frame, reader.frames() - 1, findings)));
      separator = ",\n";
    }
    if (json)
      out.write(reader.frames() == 0 ? "[]\n" : "\n]\n");
    out.close();
    if (bad > 0)
      sheet::fail(sheet::ExitCode::bad_input, "{}: something is wrong with {} of {} frames", in.name(), bad,
                  reader.frames());
  });
}
