// SPDX-License-Identifier: MIT
// Byte layout of the stream, version 1 (formats/sheet.md, section 3): the same structs serve reader and writer.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sheet::formats::layout {

static_assert(std::endian::native == std::endian::little, "the stream is little endian and so must the machine be");

inline constexpr std::array<char, 8> frame_magic{'S', 'H', 'E', 'E', 'T', 'F', 'R', 'M'};
inline constexpr std::array<char, 8> end_magic{'S', 'H', 'E', 'E', 'T', 'E', 'N', 'D'};
inline constexpr std::uint64_t alignment = 64;
inline constexpr std::uint32_t max_arrays = 4096;
inline constexpr std::uint64_t max_rows = std::uint64_t{1} << 32;        // vertex indices are 32 bits wide
inline constexpr std::uint64_t max_frame_bytes = std::uint64_t{1} << 48; // keeps every sum below 2^64
inline constexpr std::uint8_t critical_bit = 1;

struct FrameHeader {
  std::array<char, 8> magic;
  std::uint16_t version_major, version_minor;
  std::uint32_t critical_flags;
  std::uint64_t frame_bytes;
  std::uint64_t vertices, triangles, edges;
  double time;
  std::uint64_t step;
  std::uint32_t arrays;
  std::uint32_t reserved_a;
  std::uint64_t table_checksum;
  std::array<std::uint8_t, 40> reserved_b;
  std::uint64_t header_checksum; // of the 120 bytes before it
};
static_assert(sizeof(FrameHeader) == 128 && offsetof(FrameHeader, header_checksum) == 120);

struct ArrayEntry {
  std::array<char, 48> name; // padded with zeros, at least one
  std::array<char, 24> unit;
  std::uint8_t place, type, transfer, flags;
  std::uint32_t components;
  std::uint64_t rows;
  std::uint64_t offset; // from the start of the frame
  std::uint64_t bytes;
  std::uint64_t checksum; // of the bytes and their zero padding
  std::array<std::uint8_t, 16> reserved;
};
static_assert(sizeof(ArrayEntry) == 128 && offsetof(ArrayEntry, reserved) == 112);

struct EndMark {
  std::array<char, 8> magic;
  std::uint16_t version_major, version_minor;
  std::uint32_t critical_flags;
  std::uint64_t frames; // since the start of the stream or the END before
  std::array<std::uint8_t, 32> reserved;
  std::uint64_t checksum; // of the 56 bytes before it
};
static_assert(sizeof(EndMark) == 64 && offsetof(EndMark, checksum) == 56);

[[nodiscard]] constexpr std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + alignment - 1) / alignment * alignment;
}

} // namespace sheet::formats::layout
