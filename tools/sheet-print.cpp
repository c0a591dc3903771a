// SPDX-License-Identifier: GPL-3.0-or-later
// sheet-print: a stream as canonical text.
#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_text.h"
#include "libsheet/base/files.h"
#include "libsheet/base/tool.h"

int main(int argc, char** argv) {
  sheet::Tool tool(
      "sheet-print", "print a stream as text",
      "Prints every frame as canonical text (formats/sheet.md, section 6): every header field, every array, "
      "every number with all its digits. sheet-parse makes the same bytes from it again. Frames that say "
      "something impossible, such as a negative volume, are printed all the same; sheet-check tells.");
  std::string input = "-", output = "-";
  tool.argument("INPUT", input, "stream to read; - for standard input");
  tool.option("-o,--output", output, "FILE", "text file to write; - for standard output");
  tool.example("sheet-print run.sheet | less", "look at a stream");
  tool.example("sheet-print a.sheet | sed 's/viscosity = 100/viscosity = 50/' | sheet-parse > b.sheet",
               "another scene, to go on with");
  tool.example("sheet-print a.sheet | sed 's/^time .*/time 0/' | sheet-parse > b.sheet", "edit it");
  return tool.run(argc, argv, [&] {
    const sheet::InputFile in(input);
    sheet::OutputFile out(output, sheet::OutputFile::Content::text);
    sheet::formats::StreamReader reader(in.descriptor(), in.name(), sheet::formats::StreamReader::Values::any);
    sheet::formats::TextPrinter printer(out.descriptor(), out.name());
    sheet::formats::Frame frame;
    while (reader.read(frame)) {
      out.start();
      printer.print(frame, reader.ends());
    }
    out.start();
    printer.end(reader.ends());
    out.close();
  });
}
