// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-parse: canonical text to a stream.
#include "formats/cpp/stream_text.h"
#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"
#include "libsheet/base/tool.h"

int main(int argc, char** argv) {
  using sheet::formats::TextParser;
  sheet::Tool tool(
      "sheet-parse", "make a stream from text",
      "Reads the text that sheet-print writes, or that a person wrote (formats/sheet.md, section 6), and writes "
      "the stream. What the text cannot mean is refused with line and column.");
  std::string input = "-", output = "-";
  bool any_values = false;
  tool.argument("INPUT", input, "text file to read; - for standard input");
  tool.option("-o,--output", output, "FILE", "stream to write; - for standard output");
  tool.flag("--any-values", any_values,
            "also make frames that say something impossible, such as a negative volume: for tests");
  tool.example("sheet-print a.sheet | sheet-parse | cmp - a.sheet", "there and back");
  tool.example("sheet-parse hand-written.txt | sheet-check", "is it a good frame?");
  return tool.run(argc, argv, [&] {
    const sheet::InputFile in(input);
    sheet::OutputFile out(output, sheet::OutputFile::Content::binary);
    TextParser parser(in.descriptor(), in.name());
    sheet::formats::StreamWriter writer(out.descriptor(), out.name());
    sheet::formats::Frame frame;
    for (auto item = parser.read(frame); item != TextParser::Item::nothing; item = parser.read(frame)) {
      if (item == TextParser::Item::end) {
        out.start();
        writer.end();
        continue;
      }
      const std::string error = any_values ? std::string() : find_value_error(frame);
      if (!error.empty())
        sheet::fail(sheet::ExitCode::bad_input, "{}: frame {}: {}", in.name(), writer.frames(), error);
      out.start();
      writer.write(frame);
    }
    out.close();
  });
}
