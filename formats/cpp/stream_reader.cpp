// SPDX-License-Identifier: MIT
#include "formats/cpp/stream_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fmt/core.h>
#include <unistd.h>
#include <xxhash.h>

#include "formats/cpp/stream_layout.h"
#include "formats/cpp/text_start.h"

namespace sheet::formats {

namespace {

// Memory is asked for in portions no larger than this until the bytes have really arrived.
constexpr std::uint64_t first_portion = 16u << 20;

template <std::size_t N> bool padded_text(const std::array<char, N>& field, std::string& text) {
  const auto end = std::find(field.begin(), field.end(), '\0');
  text.clear();
  if (end == field.end() || std::any_of(end, field.end(), [](char c) { return c != '\0'; }))
    return false;
  text.assign(field.begin(), end);
  return true;
}

template <std::size_t N> bool all_zero(const std::array<std::uint8_t, N>& bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; });
}

// For messages: a name that may hold anything.
std::string printable(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

// What stands where a frame should: `head` is its first bytes, `first` whether nothing was before.
std::string what_else(std::string_view head, bool first) {
  if (const std::string program(compressor_of(head)); !program.empty())
    return fmt::format("this is {0}-compressed: read it through {0} -dc", program);
  if (head.starts_with("sheet-text"))
    return "this is the text form: read it through sheet-parse";
  const bool text = std::ranges::all_of(head, [](char c) { return (c & 0xE0) != 0 || (c >= '\t' && c <= '\r'); });
  return fmt::format("not a sheet stream: a frame starts with SHEETFRM{}",
                     first && text ? "; this is text: of a scene, sheet-init makes the first frame" : "");
}

std::string find_version_error(std::uint16_t major, std::uint32_t critical_flags) {
  if (major != version_major)
    return fmt::format("format version {} is not {}: a newer sheet is needed", major, version_major);
  if (critical_flags != 0)
    return fmt::format("critical flags {:#x} are unknown to version {}.{}: a newer sheet is needed", critical_flags,
                       version_major, version_minor);
  return {};
}

// What the header says beyond what find_header_error sees of a frame.
std::string find_layout_error(const layout::FrameHeader& h) {
  if (const std::string error = find_version_error(h.version_major, h.critical_flags); !error.empty())
    return error;
  if (h.version_minor <= version_minor && (h.reserved_a != 0 || !all_zero(h.reserved_b)))
    return "reserved bytes of the frame header are not zero";
  if (h.arrays > layout::max_arrays)
    return fmt::format("{} arrays are more than the {} that a frame may have", h.arrays, layout::max_arrays);
  const std::uint64_t head = sizeof(layout::FrameHeader) + h.arrays * sizeof(layout::ArrayEntry);
  if (h.frame_bytes < head || h.frame_bytes > layout::max_frame_bytes || h.frame_bytes % layout::alignment != 0)
    return fmt::format("a frame of {} bytes cannot be", h.frame_bytes);
  return {};
}

// Fills everything of `array` but its data.
std::string read_entry(const layout::ArrayEntry& e, const layout::FrameHeader& h, std::uint64_t offset, Array& array) {
  if (!padded_text(e.name, array.name))
    return "its name does not end";
  if (!padded_text(e.unit, array.unit))
    return "its unit does not end";
  if (e.place > static_cast<std::uint8_t>(Place::frame))
    return fmt::format("place {} is unknown", e.place);
  if (e.type < static_cast<std::uint8_t>(Type::int8) || e.type > static_cast<std::uint8_t>(Type::text))
    return fmt::format("type {} is unknown", e.type);
  if (e.transfer > static_cast<std::uint8_t>(Transfer::mean))
    return fmt::format("transfer rule {} is unknown", e.transfer);
  if ((e.flags & ~layout::critical_bit) != 0)
    return fmt::format("flags {:#x} are unknown", e.flags);
  if (h.version_minor <= version_minor && !all_zero(e.reserved))
    return "reserved bytes are not zero";
  array.place = static_cast<Place>(e.place);
  array.type = static_cast<Type>(e.type);
  array.transfer = static_cast<Transfer>(e.transfer);
  array.critical = (e.flags & layout::critical_bit) != 0;
  array.components = e.components;
  array.rows = e.rows;
  const unsigned __int128 bytes = static_cast<unsigned __int128>(e.rows) * e.components * size_of(array.type);
  if (bytes != e.bytes)
    return fmt::format("{} rows of {} {} are not {} bytes", e.rows, e.components, name_of(array.type), e.bytes);
  if (e.offset != offset)
    return fmt::format("it starts at byte {} of the frame, {} expected", e.offset, offset);
  if (e.bytes > h.frame_bytes - offset)
    return fmt::format("its {} bytes do not fit into the frame", e.bytes);
  return {};
}

} // namespace

StreamReader::StreamReader(int descriptor, std::string name, Values values)
    : descriptor_(descriptor), name_(std::move(name)), values_(values) {}

void StreamReader::corrupt(std::uint64_t byte, const std::string& what) {
  done_ = true;
  throw StreamError(StreamError::Kind::corrupt, fmt::format("{}: frame {}, byte {}: {}", name_, frames_, byte, what));
}

// Reads up to `size` bytes; fewer only at the end of the input.
std::size_t StreamReader::fill(std::byte* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(descriptor_, to + done, size - done);
    if (got == 0)
      break;
    if (got < 0) {
      if (errno == EINTR)
        continue;
      done_ = true;
      throw StreamError(StreamError::Kind::io, fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
    }
    done += static_cast<std::size_t>(got);
  }
  consumed_ += done;
  return done;
}

void StreamReader::read_payload(Array& array, const layout::ArrayEntry& entry) {
  const std::uint64_t start = consumed_, size = layout::padded(entry.bytes);
  const auto fail = [&](std::uint64_t byte, const std::string& what) {
    corrupt(byte, fmt::format("array \"{}\": {}", array.name, what));
  };
  array.data.resize(0);
  for (std::uint64_t have = 0; have < size;) {
    const std::uint64_t portion = std::min(size - have, std::max(have, first_portion));
    array.data.resize(have + portion);
    const std::size_t got = fill(array.data.data() + have, portion);
    have += got;
    if (got < portion)
      fail(consumed_, fmt::format("cut short, {} of {} bytes are there", have, size));
  }
  if (XXH3_64bits(array.data.data(), size) != entry.checksum)
    fail(start, "checksum mismatch");
  for (std::uint64_t i = entry.bytes; i < size; ++i)
    if (array.data.data()[i] != std::byte{0})
      fail(start + i, "padding is not zero");
  array.data.resize(entry.bytes);
  if (const std::string error = find_data_error(array); !error.empty())
    fail(start, error);
}

// `start` is the 64 bytes of the mark.
void StreamReader::read_end(const std::byte* start) {
  layout::EndMark mark;
  std::memcpy(&mark, start, sizeof mark);
  if (XXH3_64bits(&mark, offsetof(layout::EndMark, checksum)) != mark.checksum)
    corrupt(position_, "end mark: checksum mismatch");
  if (const std::string error = find_version_error(mark.version_major, mark.critical_flags); !error.empty())
    corrupt(position_, error);
  if (mark.version_minor <= version_minor && !all_zero(mark.reserved))
    corrupt(position_, "reserved bytes of the end mark are not zero");
  if (mark.frames != unended_)
    corrupt(position_, fmt::format("end mark counts {} frames, there are {}", mark.frames, unended_));
  ++ends_;
  unended_ = 0;
}

// Reads up to the header of the next frame into `h`, over END marks. False at the end of the stream.
bool StreamReader::read_header(layout::FrameHeader& h) {
  auto* raw = reinterpret_cast<std::byte*>(&h);
  for (bool after_end = false;; after_end = true) {
    position_ = consumed_;
    const std::size_t got = fill(raw, sizeof(layout::EndMark));
    if (got == 0 && after_end) {
      done_ = true;
      return false;
    }
    if (got == 0)
      corrupt(consumed_,
              frames_ == 0 ? "the stream is empty: not even an end mark" : "the stream was cut short: no end mark");
    const std::string_view head(reinterpret_cast<const char*>(raw), got);
    const std::string_view frame_magic(layout::frame_magic.data(), 8), end_magic(layout::end_magic.data(), 8);
    if (head.starts_with(end_magic)) {
      if (got < sizeof(layout::EndMark))
        corrupt(consumed_, "the end mark is cut short");
      read_end(raw);
      continue;
    }
    if (frame_magic.starts_with(head) || end_magic.starts_with(head))
      corrupt(consumed_, "the stream was cut short: a frame or end mark has just begun");
    if (!head.starts_with(frame_magic))
      corrupt(position_, what_else(head, position_ == 0));
    constexpr std::size_t rest = sizeof h - sizeof(layout::EndMark);
    if (got < sizeof(layout::EndMark) || fill(raw + sizeof(layout::EndMark), rest) < rest)
      corrupt(consumed_, "the frame header is cut short");
    break;
  }
  if (XXH3_64bits(&h, offsetof(layout::FrameHeader, header_checksum)) != h.header_checksum)
    corrupt(position_, "frame header: checksum mismatch");
  if (const std::string error = find_layout_error(h); !error.empty())
    corrupt(position_, error);
  return true;
}

// Reads the table into `table` and everything of `frame` but the arrays' data; both are found to be well-formed.
void StreamReader::read_table(const layout::FrameHeader& h, std::vector<layout::ArrayEntry>& table, Frame& frame) {
  table.resize(h.arrays);
  const std::size_t table_bytes = table.size() * sizeof(layout::ArrayEntry);
  if (fill(reinterpret_cast<std::byte*>(table.data()), table_bytes) < table_bytes)
    corrupt(consumed_, "the array table is cut short");
  if (XXH3_64bits(table.data(), table_bytes) != h.table_checksum)
    corrupt(position_ + sizeof h, "array table: checksum mismatch");

  frame.time = h.time;
  frame.step = h.step;
  frame.vertices = h.vertices;
  frame.triangles = h.triangles;
  frame.edges = h.edges;
  frame.arrays.resize(h.arrays);
  if (const std::string error = find_header_error(frame); !error.empty())
    corrupt(position_, error);
  std::uint64_t offset = sizeof h + table_bytes;
  for (std::size_t i = 0; i < table.size(); ++i) {
    Array& array = frame.arrays[i];
    std::string error = read_entry(table[i], h, offset, array);
    if (error.empty())
      error = find_entry_error(array, frame);
    if (!error.empty())
      corrupt(position_ + sizeof h + i * sizeof(layout::ArrayEntry),
              fmt::format("array {} \"{}\": {}", i, printable(array.name), error));
    offset += layout::padded(table[i].bytes);
  }
  if (offset != h.frame_bytes)
    corrupt(position_, fmt::format("the frame has {} bytes, its arrays need {}", h.frame_bytes, offset));
  if (const std::string error = find_table_error(frame); !error.empty())
    corrupt(position_, error);
  if (const std::string error = find_critical_error(frame); !error.empty())
    corrupt(position_, error);
}

bool StreamReader::read(Frame& frame) {
  layout::FrameHeader h;
  if (done_ || !read_header(h))
    return false;
  std::vector<layout::ArrayEntry> table;
  read_table(h, table, frame);
  for (std::size_t i = 0; i < table.size(); ++i)
    read_payload(frame.arrays[i], table[i]);
  if (values_ == Values::check)
    if (const std::string error = find_value_error(frame); !error.empty()) {
      done_ = true;
      throw StreamError(StreamError::Kind::value, fmt::format("{}: frame {}: {}", name_, frames_, error));
    }
  ++frames_;
  frames_since_end_ = ++unended_;
  bytes_of_frames_ = consumed_;
  return true;
}

} // namespace sheet::formats
