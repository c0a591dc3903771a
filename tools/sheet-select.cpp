// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-select: picks frames of a stream.
#include <utility>

#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"
#include "libsheet/base/tool.h"
#include "libsheet/loop/select.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-select", "pick frames of a stream",
      "Writes the frames that are asked for, unchanged and in their order, as they come: memory is needed only "
      "for what counts from the end. Reading stops when no frame to come can be meant. Indices start at 0. "
      "Without --index, --time and --last all frames are meant; --every and --first then choose from what is "
      "meant.\nOf a stream that was cut short, as by a run that failed, what --index, --time and --last mean of its "
      "whole frames is written as a whole stream, with its end mark, and the exit code is 4 all the same. Without "
      "them, what is written is cut short, too.");
  std::string input = "-", output = "-", indices, times;
  sheet::SelectOptions options;
  bool last = false;
  tool.argument("INPUT", input, "stream to read; - for standard input");
  tool.option("--index,--frames", indices, "LIST",
              std::string("frames by index, as sheet-render --frames takes them, ") + sheet::indices_help);
  tool.option(
      "--time", times, "LIST",
      "frames by time in seconds: 0.5 is the frame nearest to it, 1:2 all from 1 to 2; also 1: and :2, and lists "
      "of these");
  tool.flag("--last", last, "the last frame");
  tool.option("--every", options.every, "N", "every N-th of these frames, starting with the first");
  tool.option("--first", options.first, "N", "the first N of these frames");
  tool.option("-o,--output", output, "FILE", "stream to write; - for standard output");
  tool.example("sheet-select --last run.sheet > end.sheet", "where it ended");
  tool.example("sheet-select --time 0:2 --every 10 run.sheet | sheet-info", "a closer look");
  tool.example("sheet-select --index=-5- run.sheet", "the last five frames");
  return tool.run(argc, argv, [&] {
    if (options.every < 1 || options.first.value_or(1) < 1)
      sheet::fail(sheet::ExitCode::usage, "--every and --first need a number from 1 up");
    if (!indices.empty())
      options.indices = sheet::parse_indices(indices);
    if (!times.empty())
      options.times = sheet::parse_times(times);
    if (last)
      options.indices.push_back({-1, -1});
    const sheet::InputFile in(input);
    sheet::OutputFile out(output, sheet::OutputFile::Content::binary);
    sheet::formats::StreamReader reader(in.descriptor(), in.name());
    sheet::formats::StreamWriter writer(out.descriptor(), out.name());
    sheet::Selector selector(options, [&](const sheet::formats::Frame& frame) {
      out.start();
      writer.write(frame);
    });
    sheet::formats::Frame frame;
    const auto end = [&] {
      out.start();
      writer.end();
      out.close();
    };
    const auto next = [&] {
      try {
        return reader.read(frame);
      } catch (const sheet::formats::StreamError&) {
        selector.cut_short();
        if (writer.frames() > 0 && (!options.indices.empty() || !options.times.empty()))
          end();
        throw;
      }
    };
    while (next() && selector.add(std::exchange(frame, {})))
      continue;
    selector.end();
    end();
  });
}
