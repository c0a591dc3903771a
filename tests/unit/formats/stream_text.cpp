// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/formats/stream_support.h"

namespace sheet::formats {
namespace {

constexpr std::string_view triangle_text = R"(sheet-text 1.0
frame
time 0
step 0
vertices 3
triangles 1
edges 0
array position vertex float64 3 m interpolate
0 0 0
1 0 0
0 0.5 0
array triangle triangle uint32 3 1 drop
0 1 2
array volume triangle float64 1 m^3 conserve
0.001
)";

std::string with_note(std::string_view note) {
  return std::string(triangle_text) + "array note frame text 1 1 copy\n" + std::string(note) + "end\n";
}

TEST(StreamText, OfOneTriangle) {
  EXPECT_EQ(print_text(encode({one_triangle()})), std::string(triangle_text) + "end\n");
  EXPECT_EQ(parse_text(std::string(triangle_text) + "end\n"), encode({one_triangle()}));
}

TEST(StreamText, MayBeginWithAByteOrderMark) {
  const std::string text = std::string(triangle_text) + "end\n";
  EXPECT_EQ(parse_text("\xEF\xBB\xBF" + text), parse_text(text));
}

TEST(StreamText, ComesBackBitForBit) {
  for (const std::string& bytes : {encode({}), encode({empty_frame()}), encode({rich_frame()}),
                                   encode({rich_frame(), empty_frame(), one_triangle()})})
    EXPECT_EQ(parse_text(print_text(bytes)), bytes);
}

TEST(StreamText, KeepsEndMarksOfJoinedStreams) {
  const std::string bytes = encode({}) + encode({one_triangle(), empty_frame()}) + encode({}) + encode({}) +
                            encode({rich_frame()}) + encode({});
  EXPECT_EQ(parse_text(print_text(bytes)), bytes);
  EXPECT_EQ(print_text(encode({}) + encode({})), "sheet-text 1.0\nend\nend\n");
}

TEST(StreamText, JoinsByCat) {
  const std::string one = print_text(encode({one_triangle()})), other = print_text(encode({rich_frame()}));
  EXPECT_EQ(parse_text(one + other), encode({one_triangle()}) + encode({rich_frame()}));
}

TEST(StreamText, WritesNumbersPlainlyWithinSixteenDigits) {
  Frame frame = one_triangle();
  frame.put(
      array_of<double>("x", Place::frame, "1", Transfer::copy, 1,
                       {1e15, 1e16, 0.0001, 0.00001, 123.456, 1.5e-7, -0.0, 1e100, 2.5e-310, 100, 9999999999999998}));
  frame.put(array_of<float>("y", Place::frame, "1", Transfer::copy, 1, {0.1f, 16777216.0f, 1e16f, 3e-5f}));
  const std::string text = print_text(encode({frame}));
  EXPECT_THAT(text,
              testing::HasSubstr("\n1000000000000000\n1e+16\n0.0001\n1e-05\n123.456\n1.5e-07\n-0\n1e+100\n2.5e-310\n"
                                 "100\n9999999999999998\n"));
  EXPECT_THAT(text, testing::HasSubstr("\n0.1\n16777216\n1e+16\n3e-05\n"));
}

TEST(StreamText, RandomBitsComeBack) {
  std::mt19937_64 random(1);
  std::vector<double> doubles(20000);
  std::vector<float> floats(20000);
  for (double& x : doubles)
    x = std::bit_cast<double>(random());
  for (float& x : floats)
    x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  for (int i = 0; i < 600; ++i)
    doubles.push_back(std::ldexp(1.0, i - 300));
  Frame frame = empty_frame();
  frame.put(array_of<double>("x", Place::frame, "1", Transfer::copy, 1, doubles));
  frame.put(array_of<float>("y", Place::frame, "1", Transfer::copy, 4, floats));
  const std::string bytes = encode({frame});
  EXPECT_EQ(parse_text(print_text(bytes)), bytes);
}

TEST(StreamText, MayBeWrittenByHand) {
  const std::string text =
      "# a comment\n\n \t\nsheet-text 1.0\r\n  frame\ntime  0.0\nstep\t0\n# between\nvertices 3\n"
      "triangles 1\nedges 0\narray position vertex float64 3 m interpolate\n0 0 0\n\n1e0 .0 0\n 0 5e-1 -0\n"
      "array triangle triangle uint32 3 1 drop\n0  1 2\narray volume triangle float64 1 m^3 conserve\n"
      "0.00100\narray note frame text 1 1 copy\n| a\n# no text\n| b\nend";
  Frame frame = one_triangle();
  frame.find("position")->values<double>()[8] = -0.0;
  frame.put_text("note", "a\nb");
  EXPECT_EQ(parse_text(text), encode({frame}));
}

TEST(StreamText, MayHaveCarriageReturnsAtAllLinesEnds) {
  const auto with_returns = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
      text.insert(at, "\r");
    return text;
  };
  const std::string text = with_note("| a\n|\n| b\n");
  EXPECT_EQ(parse_text(with_returns(text)), parse_text(text));
  const std::string kept = with_note("| a\r\n| b\n"); // of the text, where other lines have none
  EXPECT_EQ(print_text(parse_text(kept)), kept);
}

TEST(StreamText, TextOfNoLineAndOfOneEmptyLineIsEmpty) {
  EXPECT_EQ(parse_text(with_note("")), parse_text(with_note("|\n")));
  EXPECT_EQ(print_text(parse_text(with_note("|\n"))), with_note(""));
  EXPECT_EQ(print_text(parse_text(with_note("|\n|\n"))), with_note("|\n|\n"));
}

struct BadText {
  std::string from, to, message;
};

TEST(StreamText, RefusesWithLineAndColumn) {
  const std::string text = std::string(triangle_text) + "end\n";
  const std::vector<BadText> cases{
      {"sheet-text 1.0", "sheet-text 2.0", ":1:12: version \"2.0\" of the text form is not 1.0"},
      {"sheet-text 1.0", "sheet-text 1.", ":1:12: version \"1.\" of the text form is not 1.0"},
      {"sheet-text 1.0", "SHEETFRM", ":1:1: this is a binary sheet stream already: it needs no parsing"},
      {"sheet-text 1.0", "sheet", ":1:1: not the text form of a sheet stream: its first line is \"sheet-text 1.0\""},
      {"frame\n", "", ":2:1: \"time\" stands where \"frame\" or \"end\" is expected"},
      {"time 0", "step 0", ":3:1: \"step\" stands where \"time NUMBER\" is expected"},
      {"time 0", "time 1 2", ":3:8: \"2\" stands behind the number: remove it"},
      {"time 0", "time inf", ":7:1: the time is not finite"},
      {"step 0", "step -1", ":4:6: \"-1\" is not a uint64: whole number from 0 to 18446744073709551615"},
      {"vertices 3", "vertices 4294967297", ":7:1: 4294967297 vertices, triangles or edges are more than 2^32"},
      {"vertices 3", "vertices 4", ":12:1: \"array\" is not a float64: decimal, inf, -inf, nan or nan:BITS"},
      {"edges 0", "edges 3", ":16:1: the frame counts 3 edges but has no array at place edge"},
      {"0 0.5 0", "0 0.5", ":11:6: \"\" is not a float64: decimal, inf, -inf, nan or nan:BITS"},
      {"0 0.5 0", "0 0.5 0 0", ":11:9: \"0\" stands behind the row: remove it"},
      {"0 0.5 0", "0 1e999 0", ":11:3: \"1e999\" is not a float64: decimal, inf, -inf, nan or nan:BITS"},
      {"0 0.5 0", "0 -nan 0", ":11:3: \"-nan\" is not a float64: decimal, inf, -inf, nan or nan:BITS"},
      {"0 0.5 0", "0 nan:1 0", ":11:3: \"nan:1\" is not a float64: decimal, inf, -inf, nan or nan:BITS"},
      {"0 1 2", "0 1 -2", ":13:5: \"-2\" is not a uint32: whole number from 0 to 4294967295"},
      {"0 1 2", "0 1 2.5", ":13:5: \"2.5\" is not a uint32: whole number from 0 to 4294967295"},
      {"array volume", "array Volume", ":14:7: array \"Volume\": its name is not 1 to 47 characters of [a-z0-9_.:-]"},
      {"array volume", "array triangle", ":14:7: array \"triangle\" appears twice"},
      {"volume triangle", "volume face",
       ":14:14: \"face\" is not a place: vertex, triangle, edge, frame[ROWS] or, for text, frame"},
      {"volume triangle", "volume frame", ":14:14: how many rows? write \"frame[ROWS]\""},
      {"volume triangle", "volume frame[x]", ":14:14: \"frame[x]\" does not say how many rows: write \"frame[ROWS]\""},
      {"float64 1", "float 1",
       ":14:23: \"float\" is not a type: int8 uint8 int32 uint32 int64 uint64 float32 float64 text"},
      {"float64 1", "float64 0", ":14:7: array \"volume\": it has no components"},
      {"m^3 conserve", "m^3 keep", ":14:37: \"keep\" is not a rule: drop copy interpolate conserve common mean"},
      {"m^3 conserve", "m^3 common", ":14:7: array \"volume\": transfer \"common\" is for integers"},
      {"m^3 conserve", "m^3 conserve crit", ":14:46: \"crit\" stands where \"critical\" or nothing is expected"},
      {"end\n", "array n frame text 1 1 copy\n|x\nend\n", ":17:1: a line of text starts with \"| \""},
      {"end\n", "array n frame text 1 1 copy\n| a\xff\nend\n",
       ":18:1: array \"n\", which ends above: its byte 1 is not UTF-8"},
      {"end\n", "array n frame[1] text 1 1 copy\nend\n", ":16:9: text counts its rows itself: write \"frame\""},
      {"end\n", "end\nx\n", ":17:1: \"x\" stands where \"frame\" or \"end\" is expected"},
  };
  for (const BadText& c : cases) {
    std::string bad = text;
    bad.replace(bad.find(c.from), c.from.size(), c.to);
    const auto refusal = refusal_of([&] { parse_text(bad); });
    ASSERT_TRUE(refusal) << c.message;
    EXPECT_EQ(refusal->message, "memory" + c.message);
    EXPECT_EQ(refusal->kind, StreamError::Kind::value) << c.message;
  }
}

TEST(StreamText, CutShortIsCorrupt) {
  const std::string text = with_note("| a\n");
  EXPECT_EQ(refusal_of([&] { parse_text(""); })->message,
            "memory:1:1: cut short: the text is empty, its first line is \"sheet-text 1.0\"");
  for (std::size_t lines = 0, at = 0; (at = text.find('\n', at)) != text.npos && ++at < text.size();) {
    ++lines;
    const auto refusal = refusal_of([&] { parse_text(text.substr(0, at)); });
    ASSERT_TRUE(refusal) << lines;
    EXPECT_EQ(refusal->kind, StreamError::Kind::corrupt) << refusal->message;
    EXPECT_THAT(refusal->message, testing::StartsWith("memory:" + std::to_string(lines + 1) + ":1: cut short: "));
  }
}

TEST(StreamText, LyingCountsCostNoMemory) {
  const auto refusal = refusal_of([] {
    parse_text("sheet-text 1.0\nframe\ntime 0\nstep 0\nvertices 4294967296\ntriangles 0\nedges 0\n"
               "array x frame[18446744073709551615] uint8 4294967295 1 copy\n1 2 3\n");
  });
  ASSERT_TRUE(refusal);
  EXPECT_THAT(refusal->message, testing::StartsWith("memory:9:6: \"\" is not a uint8"));
}

TEST(StreamText, IsFast) {
  Frame frame;
  frame.vertices = 15000;
  frame.triangles = 30000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values(45000);
  for (const char* name : {"position", "velocity", "start_position"}) {
    std::generate(values.begin(), values.end(), [&] { return uniform(random); });
    const Transfer transfer = std::string_view(name) == "start_position" ? Transfer::drop : Transfer::interpolate;
    frame.put(array_of(name, Place::vertex, std::string_view(name) == "velocity" ? "m/s" : "m", transfer, 3, values));
  }
  std::vector<std::uint32_t> corners(90000);
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    corners[i] = (i / 3 + i % 3) % 15000;
  frame.put(array_of("triangle", Place::triangle, "1", Transfer::drop, 3, corners));
  values.assign(30000, 0.1);
  frame.put(array_of("volume", Place::triangle, "m^3", Transfer::conserve, 1, values));
  const std::string bytes = encode({frame});
  const auto seconds = [](auto&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::string text, back;
  std::vector<Frame> frames;
  RecordProperty("encode_ms", std::to_string(1e3 * seconds([&] { encode({frame}); })));
  RecordProperty("decode_ms", std::to_string(1e3 * seconds([&] { frames = decode(bytes); })));
  const double print = seconds([&] { text = print_text(bytes); }), parse = seconds([&] { back = parse_text(text); });
  RecordProperty("print_ms", std::to_string(1e3 * print));
  RecordProperty("parse_ms", std::to_string(1e3 * parse));
  EXPECT_EQ(back, bytes);
  EXPECT_LT(print, 2); // 0.2 s in a release build; sanitizers and busy machines are slower
  EXPECT_LT(parse, 2);
}

} // namespace
} // namespace sheet::formats
