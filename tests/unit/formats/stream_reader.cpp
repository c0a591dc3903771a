// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader refuses, and at which cost. Lies with correct checksums: formats/corpus (stream_corpus.cpp).
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/unit/formats/stream_support.h"

namespace sheet::formats {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(StreamReader, RoundTrips) {
  std::vector<Frame> frames{one_triangle(), empty_frame(), rich_frame(), Frame(), one_triangle()};
  frames[3] = empty_frame();
  for (int i = 3; i < 4096; ++i)
    frames[3].put_text("n" + std::to_string(i), i % 2 == 0 ? "" : "x");
  EXPECT_EQ(decode(encode(frames)), frames);
  EXPECT_EQ(encode(decode(encode(frames))), encode(frames));
  EXPECT_TRUE(decode(encode({})).empty());
}

TEST(StreamReader, ArrayOfLargerFrameDoesNotShowInTheNext) {
  Frame frame = one_triangle();
  frame.put_text("note", std::string(100000, 'x'));
  Frame next = one_triangle();
  next.put_text("note", "y");
  EXPECT_EQ(decode(encode({frame, next, frame})), (std::vector{frame, next, frame}));
}

TEST(StreamReader, TakesPipesThatDeliverInPieces) {
  const std::string bytes = encode({rich_frame(), one_triangle()});
  for (const std::size_t piece : {std::size_t{1}, std::size_t{63}, std::size_t{1000}}) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread feeder([&] {
      for (std::size_t at = 0; at < bytes.size(); at += piece)
        write_all(ends[1], std::as_bytes(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at))), "pipe");
      ::close(ends[1]);
    });
    StreamReader reader(ends[0], "pipe");
    std::vector<Frame> frames;
    for (Frame frame; reader.read(frame);)
      frames.push_back(frame);
    feeder.join();
    ::close(ends[0]);
    EXPECT_EQ(frames, (std::vector{rich_frame(), one_triangle()}));
  }
}

TEST(StreamReader, CountsFramesBytesAndEnds) {
  const std::string one = encode({one_triangle(), one_triangle()});
  const MemoryFile file(one + encode({}) + encode({one_triangle()}) + encode({}));
  StreamReader reader(file.descriptor(), "memory");
  Frame frame;
  EXPECT_TRUE(reader.read(frame) && reader.read(frame));
  EXPECT_EQ(reader.frames(), 2u);
  EXPECT_EQ(reader.frames_since_end(), 2u);
  EXPECT_EQ(reader.ends(), 0u);
  EXPECT_EQ(reader.bytes_of_frames(), one.size() - 64);
  EXPECT_TRUE(reader.read(frame));
  EXPECT_EQ(reader.frames(), 3u);
  EXPECT_EQ(reader.frames_since_end(), 1u);
  EXPECT_EQ(reader.ends(), 2u);
  EXPECT_FALSE(reader.read(frame));
  EXPECT_FALSE(reader.read(frame));
  EXPECT_EQ(reader.frames_since_end(), 1u);
  EXPECT_EQ(reader.ends(), 4u);
  EXPECT_EQ(reader.bytes_of_frames(), one.size() + 64 + (one.size() - 64) / 2);
}

TEST(StreamReader, RefusesEveryProperPrefixWithAPlace) {
  const std::string bytes = encode({rich_frame(), empty_frame(), one_triangle()});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto refusal = refusal_of([&] { decode(std::string_view(bytes).substr(0, size)); });
    ASSERT_TRUE(refusal) << size;
    EXPECT_EQ(refusal->kind, StreamError::Kind::corrupt) << refusal->message;
    EXPECT_THAT(refusal->message, MatchesRegex("memory: frame [0-3], byte " + std::to_string(size) + ": .*"));
    EXPECT_THAT(refusal->message, testing::AnyOf(HasSubstr("cut short"), HasSubstr("empty")));
  }
}

TEST(StreamReader, RefusesEveryChangeOfAByteWithAPlace) {
  const std::string bytes = encode({one_triangle(), one_triangle()});
  const MemoryFile file(bytes);
  const std::size_t head = 512, frame = (bytes.size() - 64) / 2; // header and table, whole frame
  std::size_t tried = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const bool payload = at < 2 * frame && at % frame >= head;
    for (int flip = 1; flip < 256; flip += payload ? 51 : 1) {
      const char changed = static_cast<char>(bytes[at] ^ flip);
      ASSERT_EQ(::pwrite(file.descriptor(), &changed, 1, static_cast<off_t>(at)), 1);
      ::lseek(file.descriptor(), 0, SEEK_SET);
      const auto refusal = refusal_of([&] {
        StreamReader reader(file.descriptor(), "memory");
        for (Frame read; reader.read(read);) {
        }
      });
      ASSERT_TRUE(refusal) << "byte " << at << " xor " << flip;
      ASSERT_EQ(refusal->kind, StreamError::Kind::corrupt) << refusal->message;
      ASSERT_EQ(refusal->message.rfind("memory: frame ", 0), 0u) << refusal->message;
      ASSERT_NE(refusal->message.find(", byte "), std::string::npos) << refusal->message;
      ++tried;
    }
    ASSERT_EQ(::pwrite(file.descriptor(), &bytes[at], 1, static_cast<off_t>(at)), 1);
  }
  EXPECT_GT(tried, 270000u);
}

// A process with little room for more memory reads all failed files of the corpus; some of them announce 2^40 bytes.
TEST(StreamReaderDeathTest, LyingHeadersCostNoMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer needs address space without limit";
#endif
  const auto read_all_failed = [] {
    std::vector<std::string> streams;
    for (const auto& entry : std::filesystem::directory_iterator(SHEET_SOURCE_DIR "/formats/corpus/1.0/failed"))
      if (entry.path().extension() == ".sheet")
        streams.push_back(read_file(entry.path()));
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t room = pages * 4096 + (64u << 20);
    const rlimit limit{room, room};
    if (::setrlimit(RLIMIT_AS, &limit) != 0)
      std::_Exit(2);
    for (const std::string& bytes : streams)
      if (!refusal_of([&] { decode(bytes); }))
        std::_Exit(3);
    std::_Exit(streams.size() > 80 ? 0 : 4);
  };
  EXPECT_EXIT(read_all_failed(), testing::ExitedWithCode(0), "");
}

TEST(StreamReader, ReadsAFrameLargerThanItsFirstPortionOfMemory) {
  Frame frame = one_triangle();
  frame.put(make_array("bulk", Place::frame, Type::uint8, 1, "1", Transfer::copy, (40u << 20) + 1));
  std::memset(frame.find("bulk")->data.data(), 7, frame.find("bulk")->data.size());
  const std::string bytes = encode({frame});
  EXPECT_EQ(decode(bytes).at(0), frame);
  const std::size_t cut = 33u << 20;
  EXPECT_THAT(refusal_of([&] { decode(std::string_view(bytes).substr(0, cut)); })->message,
              HasSubstr("array \"bulk\": cut short"));
}

TEST(StreamReader, StaysAtItsEndAfterAnError) {
  const MemoryFile file(encode({one_triangle()}) + "x" + encode({one_triangle()}));
  StreamReader reader(file.descriptor(), "memory");
  Frame frame;
  EXPECT_TRUE(reader.read(frame));
  EXPECT_TRUE(refusal_of([&] { static_cast<void>(reader.read(frame)); }));
  EXPECT_FALSE(reader.read(frame));
  EXPECT_EQ(reader.frames(), 1u);
}

TEST(StreamReader, AnyValuesIfAskedFor) {
  Frame frame = one_triangle();
  frame.find("volume")->values<double>()[0] = -1;
  frame.find("position")->values<double>()[0] = std::numeric_limits<double>::quiet_NaN();
  const std::string bytes = encode({frame});
  EXPECT_EQ(decode(bytes, StreamReader::Values::any).size(), 1u);
  EXPECT_EQ(refusal_of([&] { decode(bytes); })->kind, StreamError::Kind::value);
  EXPECT_EQ(find_value_error(decode(bytes, StreamReader::Values::any)[0]), "array \"position\": row 0 is not finite");
}

TEST(StreamReader, TellsWhatTheSystemSays) {
  StreamReader reader(-1, "nowhere");
  Frame frame;
  const auto refusal = refusal_of([&] { static_cast<void>(reader.read(frame)); });
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->kind, StreamError::Kind::io);
  EXPECT_EQ(refusal->message, "nowhere: cannot read: Bad file descriptor");
}

} // namespace
} // namespace sheet::formats
