// SPDX-License-Identifier: MIT
#include "formats/cpp/stream_writer.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <xxhash.h>

#include "formats/cpp/stream_layout.h"

namespace sheet::formats {

namespace {

constexpr std::array<std::byte, layout::alignment> zeros{};

// Checksum of the bytes and their zero padding to a multiple of 64.
std::uint64_t padded_checksum(const Bytes& data) {
  const std::size_t padding = layout::padded(data.size()) - data.size();
  if (padding == 0)
    return XXH3_64bits(data.data(), data.size());
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  XXH3_64bits_update(state.get(), data.data(), data.size());
  XXH3_64bits_update(state.get(), zeros.data(), padding);
  return XXH3_64bits_digest(state.get());
}

layout::ArrayEntry entry_of(const Array& array, std::uint64_t offset) {
  layout::ArrayEntry e{};
  std::copy(array.name.begin(), array.name.end(), e.name.begin());
  std::copy(array.unit.begin(), array.unit.end(), e.unit.begin());
  e.place = static_cast<std::uint8_t>(array.place);
  e.type = static_cast<std::uint8_t>(array.type);
  e.transfer = static_cast<std::uint8_t>(array.transfer);
  e.flags = array.critical ? layout::critical_bit : 0;
  e.components = array.components;
  e.rows = array.rows;
  e.offset = offset;
  e.bytes = array.data.size();
  e.checksum = padded_checksum(array.data);
  return e;
}

void write_all(int descriptor, std::vector<iovec> parts, const std::string& name) {
  constexpr std::size_t most = 1024; // IOV_MAX of Linux
  std::size_t next = 0;
  while (next < parts.size()) {
    const int count = static_cast<int>(std::min(most, parts.size() - next));
    const ssize_t written = ::writev(descriptor, &parts[next], count);
    if (written < 0) {
      if (errno == EINTR)
        continue;
      const auto kind = errno == EPIPE ? StreamError::Kind::closed : StreamError::Kind::io;
      throw StreamError(kind, fmt::format("{}: cannot write: {}", name, std::strerror(errno)));
    }
    auto rest = static_cast<std::size_t>(written);
    while (next < parts.size() && rest >= parts[next].iov_len)
      rest -= parts[next++].iov_len;
    if (next < parts.size()) {
      parts[next].iov_base = static_cast<char*>(parts[next].iov_base) + rest;
      parts[next].iov_len -= rest;
    }
  }
}

// Where the next byte of a regular file will be written; -1 for pipes and the like.
off_t end_of_file(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return -1;
  return (::fcntl(descriptor, F_GETFL) & O_APPEND) != 0 ? status.st_size : ::lseek(descriptor, 0, SEEK_CUR);
}

iovec part(const void* data, std::size_t size) { return {const_cast<void*>(data), size}; }

} // namespace

EncodedFrame::EncodedFrame(const Frame& frame) {
  if (const std::string error = find_form_error(frame); !error.empty())
    throw StreamError(StreamError::Kind::value, "cannot write frame: " + error);
  std::vector<layout::ArrayEntry> table;
  table.reserve(frame.arrays.size());
  std::uint64_t offset = sizeof(layout::FrameHeader) + frame.arrays.size() * sizeof(layout::ArrayEntry);
  for (const Array& array : frame.arrays) {
    table.push_back(entry_of(array, offset));
    offset += layout::padded(array.data.size());
  }
  if (offset > layout::max_frame_bytes)
    throw StreamError(StreamError::Kind::value, "cannot write frame: it is larger than 2^48 bytes");

  layout::FrameHeader h{};
  h.magic = layout::frame_magic;
  h.version_major = version_major;
  h.version_minor = version_minor;
  h.frame_bytes = offset;
  h.vertices = frame.vertices;
  h.triangles = frame.triangles;
  h.edges = frame.edges;
  h.time = frame.time;
  h.step = frame.step;
  h.arrays = static_cast<std::uint32_t>(frame.arrays.size());
  const std::size_t table_bytes = table.size() * sizeof(layout::ArrayEntry);
  h.table_checksum = XXH3_64bits(table.data(), table_bytes);
  h.header_checksum = XXH3_64bits(&h, offsetof(layout::FrameHeader, header_checksum));

  size_ = offset;
  head_.resize(sizeof h + table_bytes);
  std::memcpy(head_.data(), &h, sizeof h);
  if (table_bytes > 0)
    std::memcpy(head_.data() + sizeof h, table.data(), table_bytes);
}

StreamWriter::StreamWriter(int descriptor, std::string name) : StreamWriter(descriptor, std::move(name), 0) {}

StreamWriter::StreamWriter(int descriptor, std::string name, std::uint64_t frames)
    : descriptor_(descriptor), name_(std::move(name)), frames_(frames), frames_since_end_(frames) {}

void StreamWriter::write(const Frame& frame) {
  const EncodedFrame encoded(frame);
  std::vector<iovec> parts{part(encoded.head().data(), encoded.head().size())};
  for (const Array& array : frame.arrays) {
    const std::size_t size = array.data.size();
    if (size == 0)
      continue;
    parts.push_back(part(array.data.data(), size));
    if (const std::size_t padding = layout::padded(size) - size; padding > 0)
      parts.push_back(part(zeros.data(), padding));
  }
  const off_t start = end_of_file(descriptor_);
  try {
    write_all(descriptor_, std::move(parts), name_);
  } catch (const StreamError&) {
    // Whole frames only: what a full disk took of this one goes. If that fails too, readers still see the missing end.
    if (start >= 0) [[maybe_unused]]
      const int ignored = ::ftruncate(descriptor_, start);
    throw;
  }
  ++frames_;
  ++frames_since_end_;
  bytes_ += encoded.size();
}

void StreamWriter::end() {
  layout::EndMark mark{};
  mark.magic = layout::end_magic;
  mark.version_major = version_major;
  mark.version_minor = version_minor;
  mark.frames = frames_since_end_;
  mark.checksum = XXH3_64bits(&mark, offsetof(layout::EndMark, checksum));
  write_all(descriptor_, {part(&mark, sizeof mark)}, name_);
  frames_since_end_ = 0;
}

void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& name) {
  write_all(descriptor, {part(bytes.data(), bytes.size())}, name);
}

} // namespace sheet::formats
