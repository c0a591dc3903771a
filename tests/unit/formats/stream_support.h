// SPDX-License-Identifier: GPL-3.0-or-later
// Streams in memory, for tests of the reader, the writer and the text form.
#pragma once
#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "formats/cpp/stream_reader.h"
#include "formats/cpp/stream_text.h"
#include "formats/cpp/stream_writer.h"

namespace sheet::formats {

// A file without a name, at its start.
class MemoryFile {
public:
  explicit MemoryFile(std::string_view content = {}) : descriptor_(::memfd_create("stream", 0)) {
    if (descriptor_ < 0)
      throw std::runtime_error("memfd_create failed");
    write_all(descriptor_, std::as_bytes(std::span(content)), "memory");
    ::lseek(descriptor_, 0, SEEK_SET);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string content() const {
    std::string bytes(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
    if (::pread(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("pread failed");
    return bytes;
  }

private:
  int descriptor_;
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error("cannot open " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The bytes of a stream of these frames.
inline std::string encode(const std::vector<Frame>& frames) {
  MemoryFile file;
  StreamWriter writer(file.descriptor(), "memory");
  for (const Frame& frame : frames)
    writer.write(frame);
  writer.end();
  return file.content();
}

inline std::vector<Frame> decode(std::string_view bytes, StreamReader::Values values = StreamReader::Values::check) {
  const MemoryFile file(bytes);
  StreamReader reader(file.descriptor(), "memory", values);
  std::vector<Frame> frames;
  for (Frame frame; reader.read(frame);)
    frames.push_back(frame);
  return frames;
}

struct Refusal {
  StreamError::Kind kind;
  std::string message;
};

// Why `work` throws a StreamError; nothing if it does not.
template <class Work> std::optional<Refusal> refusal_of(Work&& work) {
  try {
    work();
  } catch (const StreamError& error) {
    return Refusal{error.kind(), error.what()};
  }
  return std::nullopt;
}

inline std::string print_text(std::string_view bytes) {
  const MemoryFile in(bytes), out;
  StreamReader reader(in.descriptor(), "memory", StreamReader::Values::any);
  TextPrinter printer(out.descriptor(), "memory");
  for (Frame frame; reader.read(frame);)
    printer.print(frame, reader.ends());
  printer.end(reader.ends());
  return out.content();
}

inline std::string parse_text(std::string_view text) {
  const MemoryFile in(text), out;
  TextParser parser(in.descriptor(), "memory");
  StreamWriter writer(out.descriptor(), "memory");
  Frame frame;
  for (TextParser::Item item; (item = parser.read(frame)) != TextParser::Item::nothing;)
    item == TextParser::Item::end ? writer.end() : writer.write(frame);
  return out.content();
}

template <class T>
Array array_of(std::string_view name, Place place, std::string_view unit, Transfer transfer, std::uint32_t components,
               const std::vector<T>& values, bool critical = false) {
  Array array = make_array(name, place, type_of<T>(), components, unit, transfer, values.size() / components, critical);
  std::copy(values.begin(), values.end(), array.values<T>().begin());
  return array;
}

// A frame of one triangle that obeys all rules.
inline Frame one_triangle() {
  Frame frame;
  frame.vertices = 3;
  frame.triangles = 1;
  frame.put(array_of<double>("position", Place::vertex, "m", Transfer::interpolate, 3, {0, 0, 0, 1, 0, 0, 0, 0.5, 0}));
  frame.put(array_of<std::uint32_t>("triangle", Place::triangle, "1", Transfer::drop, 3, {0, 1, 2}));
  frame.put(array_of<double>("volume", Place::triangle, "m^3", Transfer::conserve, 1, {0.001}));
  return frame;
}

// A frame without vertices.
inline Frame empty_frame() {
  Frame frame;
  frame.put(array_of<double>("position", Place::vertex, "m", Transfer::interpolate, 3, {}));
  frame.put(array_of<std::uint32_t>("triangle", Place::triangle, "1", Transfer::drop, 3, {}));
  frame.put(array_of<double>("volume", Place::triangle, "m^3", Transfer::conserve, 1, {}));
  return frame;
}

// One triangle with arrays of every place, type and rule, and the values that are hard to keep.
inline Frame rich_frame() {
  Frame frame = one_triangle();
  frame.time = 0.1;
  frame.step = std::numeric_limits<std::uint64_t>::max();
  frame.edges = 3;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  frame.put(array_of<std::int8_t>("a", Place::vertex, "1", Transfer::common, 1, {-128, 0, 127}));
  frame.put(array_of<std::uint8_t>("b", Place::triangle, "1", Transfer::copy, 2, {0, 255}));
  frame.put(array_of<std::int32_t>("c", Place::edge, "1", Transfer::drop, 1, {-2147483648, 0, 2147483647}));
  frame.put(array_of<std::uint32_t>("d", Place::frame, "kg", Transfer::copy, 4, {0, 1, 2, 4294967295}));
  frame.put(array_of<std::int64_t>("e", Place::frame, "1", Transfer::common, 1,
                                   {std::numeric_limits<std::int64_t>::min(), -1}));
  frame.put(array_of<std::uint64_t>("f", Place::edge, "1", Transfer::common, 1, {0, 1, ~std::uint64_t{0}}));
  frame.put(array_of<float>("g.h:i-j_0", Place::frame, "m/s^2", Transfer::interpolate, 1,
                            {0.1f, -0.0f, 1e-45f, 3.4028235e38f, std::bit_cast<float>(0x7fc00000u),
                             std::bit_cast<float>(0xff800001u), -std::numeric_limits<float>::infinity(), 16777216.0f,
                             0.0001f, 0.00001f}));
  frame.put(array_of<double>("h", Place::frame, "1", Transfer::conserve, 1,
                             {inf,
                              -inf,
                              nan,
                              -nan,
                              std::bit_cast<double>(0x7ff0000000000001),
                              std::bit_cast<double>(0xffffffffffffffff),
                              -0.0,
                              5e-324,
                              1.7976931348623157e308,
                              1e16,
                              1e15,
                              9999999999999998,
                              12345678901234568,
                              0.0001,
                              0.00001,
                              123.456,
                              1.5e-7,
                              -1200,
                              0.1 + 0.2,
                              2e-44,
                              1e100}));
  frame.put(array_of<double>("none", Place::frame, "1", Transfer::drop, 7, {}));
  frame.put_text("empty", "");
  frame.put_text("note", "two lines\n\n# no comment\n  | \xc3\xa4\xe2\x82\xac\xf0\x9f\x92\xa7\r\n\n");
  frame.put_text("newline", "\n");
  return frame;
}

} // namespace sheet::formats
