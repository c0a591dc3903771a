// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-diff: compares two streams. Its exit codes are those of diff(1).
#include "libsheet/base/tool.h"
#include "libsheet/measure/compare_streams.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-diff", "compare two streams with tolerances",
      "Compares frame by frame and array by array, and prints for each array that differs how many values do, "
      "and the largest absolute and relative difference with its place. Arrays and frames that one stream "
      "lacks are differences; the order of arrays is none.\n"
      "Two numbers agree if they differ by no more than the absolute tolerance, or by no more than the "
      "relative one times the larger of them. NaN agrees with NaN.");
  std::string first, second;
  sheet::CompareOptions options;
  std::vector<std::string> arrays, ignored;
  tool.required_argument("FIRST", first, "stream to read; - for standard input");
  tool.required_argument("SECOND", second, "likewise");
  tool.option("--abs", options.floats.absolute, "NUMBER",
              "absolute tolerance of floating-point arrays, in their units");
  tool.option("--rel", options.floats.relative, "NUMBER", "relative tolerance of floating-point arrays");
  tool.option("--array", arrays, "NAME=ABS[,REL]",
              "tolerance of one array instead, also of one of integers, or of the time; may be given again and again");
  tool.option("--ignore", ignored, "NAME", "array to pass over, or time, or step; may be given again and again");
  tool.example("sheet-diff --rel 1e-9 --ignore provenance a.sheet b.sheet", "the same but for round-off?");
  tool.example("sheet-step --dt 0.01 < a.sheet | sheet-diff -q - b.sheet || echo different", "in a script");
  tool.exit_status(
      "0 the streams agree, 1 they differ, 2 trouble of any kind, also a corrupt stream: the codes of diff(1), "
      "not those of the other programs. With -q nothing is printed, and the first difference ends it.");
  bool different = false;
  const int code = tool.run(argc, argv, [&] {
    if (!(options.floats.absolute >= 0) || !(options.floats.relative >= 0))
      sheet::fail(sheet::ExitCode::usage, "tolerances must be 0 or more");
    for (const std::string& text : arrays)
      sheet::add_tolerance(options, text);
    options.ignored.insert(ignored.begin(), ignored.end());
    different = sheet::streams_differ(first, second, options);
  });
  return code != 0 ? 2 : different ? 1 : 0;
}
