// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that are no scenes at all: each is refused at its place, none crashes.
#include "libsheet/scene/document.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "scenes.h"

namespace sheet::scene {
namespace {

std::string repeat(std::string_view text, int times, std::string_view before = "", std::string_view after = "") {
  std::string result(before);
  for (int i = 0; i < times; ++i)
    result += text;
  return result.append(after);
}

TEST(Document, PlacesOfKeysAndValues) {
  const Node document = parse_toml("[a]\n  b = [1,\n 2.5]\n[[c]]\nd = {e = true}\n", "s");
  const Member& b = document.find("a")->members.at(0);
  EXPECT_EQ(b.key, "b");
  EXPECT_EQ(b.place.line, 2);
  EXPECT_EQ(b.place.column, 3);
  EXPECT_EQ(b.value.items.at(1).place.line, 3);
  EXPECT_EQ(b.value.items.at(1).place.column, 2);
  EXPECT_EQ(b.value.items.at(0).integer, 1);
  EXPECT_EQ(b.value.items.at(1).real, 2.5);
  const Node& c = document.find("c")->items.at(0);
  EXPECT_EQ(c.place.line, 4);
  EXPECT_TRUE(c.find("d")->find("e")->boolean);
  EXPECT_EQ(document.find("x"), nullptr);
}

TEST(Document, HostileTexts) {
  EXPECT_EQ(problem(repeat("a.", 100000, "", "b = 1")), "s:1:34: too many dots in a key");
  EXPECT_EQ(problem(repeat("a.", 100000, "[", "b]")), "s:1:35: too many dots in a key");
  EXPECT_EQ(problem(repeat("\",\".", 100, "x = {", "b = 1}")), "s:1:73: too many dots in a key");
  EXPECT_EQ(problem(repeat("a.", 100, "a = \"\"\"\n", "\"\"\"")),
            "s:1:5: a text over several lines has no use in a scene");
  EXPECT_EQ(problem("a = '''x'''"), "s:1:5: a text over several lines has no use in a scene");
  EXPECT_EQ(problem(std::string("a = 1\n\0", 7)), "s:2:1: a zero byte");
  EXPECT_EQ(problem(std::string((4 << 20) + 1, ' ')), "s: longer than 4194304 bytes");
  EXPECT_NE(problem(repeat("[", 100000, "a = ")).find("s:1:"), std::string::npos);
  EXPECT_NE(problem(repeat("{a=", 100000, "a = ")).find("s:1:"), std::string::npos);
  EXPECT_NE(problem(repeat("[[a]]\n", 1000)).find("s:1:3: unknown key \"a\" in the scene"), std::string::npos);
  EXPECT_EQ(problem("a² = 1"), "s:1:2: a character that has no place outside of quotes and comments");
  EXPECT_EQ(problem("a = \"\xff\""), "s:1:6: this is not UTF-8");
  EXPECT_EQ(problem("a = \"\xc0\x80\""), "s:1:6: this is not UTF-8");
  EXPECT_EQ(problem("a = \"\xed\xa0\x80\""), "s:1:6: this is not UTF-8");
  EXPECT_EQ(problem("a = \"\xe2\x82"), "s:1:6: this is not UTF-8");
  EXPECT_EQ(problem("a = 'µ'"), "s:1:6: a text with such a character needs double quotes");
  EXPECT_EQ(problem(repeat("µ", 1001, "a = \"")), "s:1:1006: too many characters that are not ASCII");
}

TEST(Document, TablesThatStandTwiceAreWrittenAsSeveral) {
  EXPECT_EQ(problem("[solid]\nshape = \"plane\"\n[solid]\nshape = \"plane\"\n"),
            "s:3:1: Error while parsing table header: cannot redefine existing table 'solid': where there are several, "
            "each is written [[solid]]");
  EXPECT_EQ(problem("[contact]\nself = true\n[contact]\nadhesion = 3\n"),
            "s:3:1: Error while parsing table header: cannot redefine existing table 'contact': a scene has one "
            "[contact], with all its keys under one heading");
}

TEST(Document, TellsHowATextWithoutQuotesIsWritten) {
  const auto ending = [](const std::string& text) {
    const std::string reason = problem(text);
    const std::size_t at = reason.rfind(": ");
    return at == reason.npos ? reason : reason.substr(at + 2);
  };
  const auto in_quotes = [](std::string_view text) {
    return fmt::format("a number with a unit is written in quotes, \"{}\"", text);
  };
  EXPECT_EQ(problem("[sheet]\nthickness = 4 mm # thick\n"),
            "s:2:15: Error while parsing key-value pair: expected a comment or whitespace, saw 'm': " +
                in_quotes("4 mm"));
  EXPECT_EQ(ending("a = 4mm"), in_quotes("4mm"));
  EXPECT_EQ(ending("a = .5 mm"), in_quotes(".5 mm"));
  EXPECT_EQ(ending("a = -9.81 m/s^2\nb = 1\n"), in_quotes("-9.81 m/s^2"));
  EXPECT_EQ(ending("a = 1e5 Pa*s"), in_quotes("1e5 Pa*s"));
  EXPECT_EQ(ending("a = [\"1 mm\", 2 mm]"), in_quotes("2 mm"));
  EXPECT_EQ(ending("a = [\"1 µm\",\n2 mm, 3]"), in_quotes("2 mm"));
  EXPECT_EQ(ending("a = {angle = 30 deg, axis = [1, 0, 0]}"), in_quotes("30 deg"));
  EXPECT_EQ(ending("a = disk"), "a text is written in quotes, \"disk\"");
  EXPECT_EQ(ending("a = 0,5"), "write a decimal point, not a comma");
  EXPECT_EQ(ending("a = 1/2"), "expected digit, saw '/'"); // neither
  EXPECT_EQ(ending("[sheet\n").find("quotes"), std::string::npos);
  EXPECT_EQ(ending("shape disk"), "a line is KEY = VALUE");
  EXPECT_EQ(ending("thickness: 0.5"), "a line is KEY = VALUE");
  EXPECT_EQ(ending("thickness =\nb = 1"), "a line is KEY = VALUE");
  for (const char* number : {".5", "-.5", "5.", "5.e-3", "[1, .5]"})
    EXPECT_EQ(ending(fmt::format("a = {}\nb = 1\n", number)),
              "a number has digits on both sides of its point, as 0.5 or 5.0");
  for (const char* text : {"\"5 mm", "'5 mm", "[\"5 mm, 3]"})
    EXPECT_EQ(ending(fmt::format("a = {}\nb = 1\n", text)),
              "a text ends on its line, with the quote that it begins with");
  EXPECT_EQ(ending("a = \"C:\\meshes\\m.obj\""),
            "a text in double quotes has \\\\ for a backslash; folders are separated by /");
  EXPECT_EQ(ending("a = True"), "true and false are written so");
  EXPECT_EQ(ending("a = 5 // metres"), "a comment begins with #");
  EXPECT_EQ(ending("a = 5 -- metres"), "a comment begins with #");
  EXPECT_TRUE(ending("a = 4 'mm'").starts_with("expected a comment or whitespace"));
}

TEST(Document, SyntaxErrorsHaveTheirPlace) {
  EXPECT_TRUE(problem("[sheet]\nshape = disk\n").starts_with("s:2:9: ")) << problem("[sheet]\nshape = disk\n");
  EXPECT_TRUE(problem("a = 1\na = 2\n").starts_with("s:2:"));
  EXPECT_EQ(problem("a = 1\na = 2\n").find('\n'), std::string::npos);
  EXPECT_EQ(problem("[}a]"), "s: not TOML");
}

// Characters that are not ASCII count as one, also in messages behind them on the line.
TEST(Document, OtherCharacters) {
  EXPECT_EQ(problem("# µ²\n" + disk + liquid + "[tear] # µ\nbelow = \"300 µm\" # ²"), "fine");
  EXPECT_EQ(problem("\xEF\xBB\xBF" + disk + liquid), "fine");
  EXPECT_EQ(problem(disk + liquid + "surface_tension = \"3 µm\"\n"),
            "s:9:19: surface_tension: expected a surface tension such as \"30 mN/m\", got a length (m)");
  EXPECT_EQ(problem(disk + liquid + "[environment]\ngravity = [\"1 µm/s²\", \"1 😀/s²\", \"3 Pa\"]\n"),
            "s:10:23: gravity: expected an acceleration such as \"9.81 m/s^2\": unknown unit \"😀\"\n"
            "s:10:33: gravity: expected an acceleration such as \"9.81 m/s^2\", got a pressure (Pa)");
  EXPECT_EQ(parse_toml("a = \"\\\\µ\\\"😀\"", "s").find("a")->text, "\\µ\"😀");
}

TEST(Document, QuotedTextsReadBack) {
  for (const std::string text : {"a", "a\"b", "a\\b", "µ²/😀", "\\\"", "a\\u0041"})
    EXPECT_EQ(parse_toml(fmt::format("a = {}", toml_text(text)), "s").find("a")->text, text);
}

// What fuzzing found: refused or read, but no crash.
TEST(Document, FoundByFuzzing) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SHEET_SOURCE_DIR "/tests/fuzz/corpus/scene")) {
    std::ostringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    EXPECT_NE(problem(text.str()), "fine") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
}

} // namespace
} // namespace sheet::scene
