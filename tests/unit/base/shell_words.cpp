// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/base/shell_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sheet {
namespace {

using testing::ElementsAre;

TEST(ShellWords, ReadWhatIsQuoted) {
  for (const char* word : {"", "plain-word.1", "two words", "it's", "'", "\\", "a\\x41", "# no comment", "two\nlines",
                           "it's\ttwo\nlines \\ $x", "$'", "a | b", "\"x\"", "µ"}) {
    const std::string line = "before " + shell_quoted(word) + " after";
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_THAT(shell_words(line), ElementsAre("before", word, "after")) << line;
  }
}

TEST(ShellWords, EndAtAComment) {
  EXPECT_THAT(shell_words("  a  b#c  # from step 8"), ElementsAre("a", "b#c"));
  EXPECT_THAT(shell_words(" "), ElementsAre());
}

} // namespace
} // namespace sheet
