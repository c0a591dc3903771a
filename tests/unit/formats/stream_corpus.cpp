// SPDX-License-Identifier: GPL-3.0-or-later
// Every file of formats/corpus: those in passed/ against their text twins, those in failed/ against their messages.
#include <filesystem>
#include <regex>

#include <gtest/gtest.h>

#include "tests/unit/formats/stream_support.h"

namespace sheet::formats {
namespace {

std::vector<std::filesystem::path> corpus(const std::string& kind) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(SHEET_SOURCE_DIR "/formats/corpus/1.0/" + kind))
    if (entry.path().extension() == ".sheet")
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string twin_of(std::filesystem::path path) { return read_file(path.replace_extension(".txt")); }

TEST(StreamCorpus, PassedFilesAreReadAndWrittenBack) {
  const auto paths = corpus("passed");
  EXPECT_GE(paths.size(), 15u);
  for (const auto& path : paths) {
    SCOPED_TRACE(path);
    const std::string bytes = read_file(path);
    const auto refusal = refusal_of([&] { decode(bytes); });
    EXPECT_FALSE(refusal) << refusal->message;
    EXPECT_EQ(print_text(bytes), twin_of(path));
    const bool newer = path.string().ends_with("_newer_minor.sheet"); // is written back as version 1.0
    EXPECT_EQ(parse_text(twin_of(path)), newer ? encode(decode(bytes)) : bytes);
    EXPECT_EQ(parse_text(twin_of(path)) == bytes, !newer);
  }
}

TEST(StreamCorpus, FailedFilesAreRefusedWithTheirMessage) {
  const auto paths = corpus("failed");
  EXPECT_GE(paths.size(), 80u);
  for (const auto& path : paths) {
    SCOPED_TRACE(path);
    const auto refusal = refusal_of([&] { decode(read_file(path)); });
    ASSERT_TRUE(refusal);
    const int exit_code = refusal->kind == StreamError::Kind::corrupt ? 4 : 3;
    EXPECT_EQ(refusal->message + "\nexit code " + std::to_string(exit_code) + "\n", "memory: " + twin_of(path));
  }
}

// Section 9 of the specification shows a file of the corpus byte by byte.
TEST(StreamCorpus, HexDumpOfTheSpecificationIsRight) {
  const std::string page = read_file(SHEET_SOURCE_DIR "/formats/sheet.md");
  std::string dumped;
  const std::regex line(" *([0-9a-f]{8}: )((?:[0-9a-f]{2} ){16}) .*");
  std::size_t next = 0;
  for (std::size_t at = page.find("\n## 9."); at != page.npos; at = page.find('\n', at + 1)) {
    std::smatch match;
    const std::string text = page.substr(at + 1, page.find('\n', at + 1) - at - 1);
    if (!std::regex_match(text, match, line))
      continue;
    EXPECT_EQ(std::stoul(match[1].str(), nullptr, 16), next);
    for (std::size_t i = 0; i < 16; ++i)
      dumped += static_cast<char>(std::stoul(match[2].str().substr(3 * i, 2), nullptr, 16));
    next += 16;
  }
  EXPECT_EQ(dumped, read_file(SHEET_SOURCE_DIR "/formats/corpus/1.0/passed/0003_one_triangle.sheet"));
}

} // namespace
} // namespace sheet::formats
