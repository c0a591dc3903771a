// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes: the reader accepts or refuses them with a StreamError. What it accepts goes through text and comes back.
// Seeds: formats/corpus/1.0/*. The mutator repairs checksums, so that mutations get past them.
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>

#include "formats/cpp/stream_layout.h"
#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_text.h"
#include "formats/cpp/stream_writer.h"

using namespace sheet::formats;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

// Writes the checksum of a struct that ends with it.
template <class Struct> void repair(std::uint8_t* at) {
  const XXH64_hash_t sum = XXH3_64bits(at, sizeof(Struct) - 8);
  std::memcpy(at + sizeof(Struct) - 8, &sum, 8);
}

// Makes magic and checksums of the frame at `at` right, as far as it is there, and returns where it ends.
std::size_t repair_frame(std::uint8_t* data, std::size_t at, std::size_t size) {
  layout::FrameHeader h;
  std::memcpy(&h, data + at, sizeof h);
  const std::size_t table = at + sizeof h;
  const std::size_t table_bytes = std::min<std::size_t>(h.arrays, layout::max_arrays) * sizeof(layout::ArrayEntry);
  if (table_bytes <= size - table) {
    for (std::size_t i = table; i < table + table_bytes; i += sizeof(layout::ArrayEntry)) {
      layout::ArrayEntry e;
      std::memcpy(&e, data + i, sizeof e);
      if (e.offset >= size - at || e.bytes > size - at - e.offset || layout::padded(e.bytes) > size - at - e.offset)
        continue;
      e.checksum = XXH3_64bits(data + at + e.offset, layout::padded(e.bytes));
      std::memcpy(data + i, &e, sizeof e);
    }
    const XXH64_hash_t sum = XXH3_64bits(data + table, table_bytes);
    std::memcpy(data + at + offsetof(layout::FrameHeader, table_checksum), &sum, sizeof sum);
  }
  repair<layout::FrameHeader>(data + at);
  return h.frame_bytes >= sizeof h && h.frame_bytes < size - at ? at + h.frame_bytes : size;
}

// Goes over the stream, frame by frame.
void repair_stream(std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 0; at + sizeof(layout::EndMark) <= size;) {
    if (std::memcmp(data + at, layout::end_magic.data(), 8) == 0) {
      repair<layout::EndMark>(data + at);
      at += sizeof(layout::EndMark);
    } else if (std::memcmp(data + at, layout::frame_magic.data(), 8) == 0 && at + sizeof(layout::FrameHeader) <= size) {
      at = repair_frame(data, at, size);
    } else {
      return;
    }
  }
}

class MemoryFile {
public:
  MemoryFile() : descriptor_(::memfd_create("fuzz", 0)) {}
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }
  int rewound() const {
    ::lseek(descriptor_, 0, SEEK_SET);
    return descriptor_;
  }

private:
  int descriptor_;
};

void check(bool condition) {
  if (!condition)
    std::abort();
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (seed % 8 != 0)
    repair_stream(data, size);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile in, text, binary, text_again;
  write_all(in.rewound(), std::as_bytes(std::span(data, size)), "in");
  std::vector<Frame> frames;
  std::uint64_t ends = 0;
  try {
    StreamReader reader(in.rewound(), "in", StreamReader::Values::any);
    TextPrinter printer(text.rewound(), "text");
    for (Frame frame; reader.read(frame);) {
      check(find_form_error(frame).empty());
      static_cast<void>(find_value_error(frame));
      printer.print(frame, reader.ends());
      frames.push_back(frame);
    }
    ends = reader.ends();
    printer.end(ends);
  } catch (const StreamError& error) {
    check(error.kind() == StreamError::Kind::corrupt);
    return 0;
  }

  TextParser parser(text.rewound(), "text");
  StreamWriter writer(binary.rewound(), "binary");
  Frame frame;
  for (TextParser::Item item; (item = parser.read(frame)) != TextParser::Item::nothing;)
    item == TextParser::Item::end ? writer.end() : writer.write(frame);

  StreamReader reader(binary.rewound(), "binary", StreamReader::Values::any);
  for (const Frame& expected : frames)
    check(reader.read(frame) && frame == expected);
  check(!reader.read(frame) && reader.ends() == ends);
  return 0;
}
