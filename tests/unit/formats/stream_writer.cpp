// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/formats/stream_support.h"

namespace sheet::formats {
namespace {

TEST(StreamWriter, JoinsStreams) {
  const MemoryFile file;
  StreamWriter writer(file.descriptor(), "memory");
  writer.write(one_triangle());
  writer.end();
  writer.end();
  writer.write(empty_frame());
  writer.write(one_triangle());
  writer.end();
  EXPECT_EQ(file.content(), encode({one_triangle()}) + encode({}) + encode({empty_frame(), one_triangle()}));
  EXPECT_EQ(writer.frames(), 3u);
  EXPECT_EQ(writer.bytes(), file.content().size() - 3 * 64);
}

TEST(StreamWriter, GoesOnWhereAStreamWasCutOff) {
  const std::string whole = encode({one_triangle(), one_triangle()});
  const MemoryFile file(whole.substr(0, (whole.size() - 64) / 2));
  ::lseek(file.descriptor(), 0, SEEK_END);
  StreamWriter writer(file.descriptor(), "memory", 1);
  writer.write(one_triangle());
  writer.end();
  EXPECT_EQ(file.content(), whole);
}

TEST(StreamWriter, RefusesFramesOfBadForm) {
  const std::vector<std::pair<void (*)(Frame&), std::string>> cases{
      {[](Frame& f) { f.time = std::numeric_limits<double>::quiet_NaN(); }, "the time is not finite"},
      {[](Frame& f) { f.vertices = 4; }, "array \"position\": it has 3 rows, the frame has 4 at place vertex"},
      {[](Frame& f) { f.edges = 3; }, "the frame counts 3 edges but has no array at place edge"},
      {[](Frame& f) { f.edges = (std::uint64_t{1} << 32) + 1; },
       "4294967297 vertices, triangles or edges are more than 2^32"},
      {[](Frame& f) { f.arrays[2].name = "position"; }, "array \"position\" appears twice"},
      {[](Frame& f) { f.arrays[2].name = ""; }, "array \"\": its name is not 1 to 47 characters of [a-z0-9_.:-]"},
      {[](Frame& f) { f.arrays[2].name = std::string(48, 'a'); },
       "array \"" + std::string(48, 'a') + "\": its name is not 1 to 47 characters of [a-z0-9_.:-]"},
      {[](Frame& f) { f.arrays[2].unit = std::string(24, 'm'); },
       "array \"volume\": its unit is not 1 to 23 printable characters without blanks (\"1\" for none)"},
      {[](Frame& f) { f.arrays[2].data.resize(7); },
       "array \"volume\": it has 7 bytes, its rows and components need another number"},
      {[](Frame& f) { f.put_text("note", "\xed\xa0\x80"); }, "array \"note\": its byte 0 is not UTF-8"},
      {[](Frame& f) { f.put_text("note", "\xf4\x90\x80\x80"); }, "array \"note\": its byte 0 is not UTF-8"},
      {[](Frame& f) { f.put_text("note", "ab\xe2\x82"); }, "array \"note\": its byte 2 is not UTF-8"},
      {[](Frame& f) { f.put_text("note", std::string_view("ab\0", 3)); },
       "array \"note\": its byte 2 is zero, text has none"},
      {[](Frame& f) {
         for (int i = 0; i < 4096; ++i)
           f.put_text(std::to_string(i), "");
       },
       "4099 arrays are more than the 4096 that a frame may have"},
  };
  for (const auto& [spoil, message] : cases) {
    Frame frame = one_triangle();
    spoil(frame);
    const auto refusal = refusal_of([&] { encode({frame}); });
    ASSERT_TRUE(refusal) << message;
    EXPECT_EQ(refusal->message, "cannot write frame: " + message);
    EXPECT_EQ(refusal->kind, StreamError::Kind::value);
  }
}

TEST(StreamWriter, TellsAFullDiskFromAClosedPipe) {
  const int full = ::open("/dev/full", O_WRONLY);
  const auto disk = refusal_of([&] { StreamWriter(full, "full").write(one_triangle()); });
  ::close(full);
  ASSERT_TRUE(disk);
  EXPECT_EQ(disk->kind, StreamError::Kind::io);
  EXPECT_EQ(disk->message, "full: cannot write: No space left on device");

  const auto old = std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  const auto pipe = refusal_of([&] { StreamWriter(ends[1], "pipe").write(one_triangle()); });
  const auto text = refusal_of([&] { TextPrinter(ends[1], "pipe").print(one_triangle()); });
  ::close(ends[1]);
  std::signal(SIGPIPE, old);
  ASSERT_TRUE(pipe && text);
  EXPECT_EQ(pipe->kind, StreamError::Kind::closed);
  EXPECT_EQ(text->kind, StreamError::Kind::closed);
}

TEST(StreamValues, EdgesAreCounted) {
  Frame frame = one_triangle();
  frame.vertices = 4;
  frame.triangles = 2;
  frame.put(
      array_of<double>("position", Place::vertex, "m", Transfer::interpolate, 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
  frame.put(array_of<std::uint32_t>("triangle", Place::triangle, "1", Transfer::drop, 3, {0, 1, 2, 2, 1, 3}));
  frame.put(array_of<double>("volume", Place::triangle, "m^3", Transfer::conserve, 1, {1, 1}));
  frame.edges = 5;
  frame.put(array_of<double>("energy", Place::edge, "J", Transfer::drop, 1, {1, 2, 3, 4, 5}));
  EXPECT_EQ(find_value_error(frame), "");
  frame.edges = 6;
  frame.put(array_of<double>("energy", Place::edge, "J", Transfer::drop, 1, {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(find_form_error(frame), "");
  EXPECT_EQ(find_value_error(frame), "the frame counts 6 edges, its triangles have 5");
}

} // namespace
} // namespace sheet::formats
