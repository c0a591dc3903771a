// SPDX-License-Identifier: MIT
// Reads a sheet stream from a file descriptor, trusting nothing. Specification: formats/sheet.md.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "formats/cpp/stream_layout.h"

namespace sheet::formats {

class StreamReader {
public:
  enum class Values {
    check, // refuse frames whose standard arrays break their rules (find_value_error)
    any,   // accept every well-formed frame: for tools that tell what is wrong with it
  };
  // `name` appears in messages. The descriptor stays the caller's.
  StreamReader(int descriptor, std::string name, Values values = Values::check);

  // Reads the next frame into `frame`, reusing its memory. False at the end of the stream: an END mark with nothing
  // behind it. END marks between frames (streams joined by cat) are passed over.
  // Throws StreamError: corrupt (cut short, checksum, impossible header), value, io; the message names file, frame,
  // array and byte. After an error the reader stays at its end.
  [[nodiscard]] bool read(Frame& frame);

  // Frames read so far, and the byte behind the last one.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] std::uint64_t bytes_of_frames() const noexcept { return bytes_of_frames_; }
  // Frames since the start of the stream or the END before the last frame.
  [[nodiscard]] std::uint64_t frames_since_end() const noexcept { return frames_since_end_; }
  // END marks passed so far.
  [[nodiscard]] std::uint64_t ends() const noexcept { return ends_; }

private:
  [[noreturn]] void corrupt(std::uint64_t byte, const std::string& what);
  std::size_t fill(std::byte* to, std::size_t size);
  bool read_header(layout::FrameHeader& h);
  void read_table(const layout::FrameHeader& h, std::vector<layout::ArrayEntry>& table, Frame& frame);
  void read_payload(Array& array, const layout::ArrayEntry& entry);
  void read_end(const std::byte* start);

  int descriptor_;
  std::string name_;
  Values values_;
  std::uint64_t frames_ = 0, frames_since_end_ = 0, unended_ = 0, ends_ = 0;
  std::uint64_t position_ = 0, consumed_ = 0,
                bytes_of_frames_ = 0; // [bytes] start of this item, read, end of last frame
  bool done_ = false;
};

} // namespace sheet::formats
