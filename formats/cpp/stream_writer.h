// SPDX-License-Identifier: MIT
// Writes a sheet stream to a file descriptor. Specification: formats/sheet.md.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet::formats {

// The bytes of one frame up to its payloads; payloads follow in order, each padded with zeros to 64 bytes.
// Throws StreamError (value) if the frame's form is wrong.
class EncodedFrame {
public:
  explicit EncodedFrame(const Frame& frame);
  [[nodiscard]] std::span<const std::byte> head() const noexcept { return head_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

private:
  std::vector<std::byte> head_;
  std::uint64_t size_ = 0;
};

class StreamWriter {
public:
  // `name` appears in messages. The descriptor stays the caller's; it should be a pipe or a regular file.
  StreamWriter(int descriptor, std::string name);
  // A stream that goes on after `frames` frames which are in the file already (sheet-loop --resume).
  StreamWriter(int descriptor, std::string name, std::uint64_t frames);

  // Writes one whole frame. Throws StreamError: value (bad form), io (disk full, ...), closed (broken pipe; SIGPIPE
  // must be ignored by the program).
  void write(const Frame& frame);
  // Writes the end mark. A stream without it counts as cut short. Frames behind it belong to a stream that is joined
  // on.
  void end();

  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  // Bytes of the whole frames that have been written by this writer.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }

private:
  int descriptor_;
  std::string name_;
  std::uint64_t frames_ = 0, frames_since_end_ = 0, bytes_ = 0;
};

// Writes all bytes, through EINTR and short writes. Throws StreamError (io, closed).
void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& name);

} // namespace sheet::formats
