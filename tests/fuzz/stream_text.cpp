// SPDX-License-Identifier: GPL-3.0-or-later
// Any text: the parser accepts or refuses it with a StreamError. What it accepts, printed and parsed again, is the
// same. Seeds: formats/corpus/1.0/passed.
#include <cstdlib>
#include <utility>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "formats/cpp/stream_text.h"
#include "formats/cpp/stream_writer.h"

using namespace sheet::formats;

namespace {

struct Stream {
  std::vector<Frame> frames;
  std::vector<TextParser::Item> items;
  bool operator==(const Stream&) const = default;
};

Stream parse(int descriptor) {
  TextParser parser(descriptor, "text");
  Stream stream;
  Frame frame;
  for (TextParser::Item item; (item = parser.read(frame)) != TextParser::Item::nothing;) {
    stream.items.push_back(item);
    if (item == TextParser::Item::frame)
      stream.frames.push_back(frame);
  }
  return stream;
}

void print(const Stream& stream, int descriptor) {
  TextPrinter printer(descriptor, "text");
  std::uint64_t ends = 0;
  std::size_t next = 0;
  for (const TextParser::Item item : stream.items)
    item == TextParser::Item::end ? printer.end(++ends) : printer.print(stream.frames[next++], ends);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int in = ::memfd_create("in", 0), out = ::memfd_create("out", 0);
  const auto close = [&](int result) {
    ::close(in);
    ::close(out);
    return result;
  };
  write_all(in, std::as_bytes(std::span(data, size)), "in");
  ::lseek(in, 0, SEEK_SET);
  Stream stream;
  try {
    stream = parse(in);
  } catch (const StreamError&) {
    return close(0);
  }
  print(stream, out);
  ::lseek(out, 0, SEEK_SET);
  if (parse(out) != stream)
    std::abort();
  return close(0);
}
