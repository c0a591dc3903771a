// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/example.h"

#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/write.h"

namespace sheet::scene {
namespace {

// A run of settings without a blank line or a remark between them, and the table that they are in.
struct Block {
  bool active;
  std::string table;
  std::vector<std::string> lines;
};

std::vector<Block> blocks() {
  std::vector<Block> result;
  std::istringstream in{std::string(example())};
  std::string line, table;
  bool open = false;
  while (std::getline(in, line)) {
    const bool option = line.size() > 1 && line[0] == '#' && line[1] != ' ';
    const bool active = !line.empty() && line[0] != '#';
    if (!option && !active) {
      open = false;
      continue;
    }
    const std::string setting = option ? line.substr(1) : line;
    if (active && setting[0] == '[')
      table = setting.substr(0, setting.find(']') + 1);
    if (!open || result.back().active != active)
      result.push_back({active, table, {}});
    result.back().lines.push_back(setting);
    open = true;
  }
  return result;
}

std::string key_of(const std::string& line) { return line.substr(0, line.find(' ')); }

std::set<std::string> keys_of(const Block& block) {
  std::set<std::string> keys;
  std::string table = block.table;
  for (const auto& line : block.lines)
    if (line[0] == '[')
      table = line.substr(0, line.find(']') + 1);
    else
      keys.insert(table + key_of(line));
  return keys;
}

// The scene with one block of options in force: active blocks with a key in common give way, and what is left is set.
std::string with(const Block& option) {
  std::map<std::string, std::string> tables;
  std::vector<std::string> lists; // [[...]] with what follows
  const auto keys = keys_of(option);
  const bool mesh = keys.contains("[sheet]file"), segments = keys.contains("[sheet]segments");
  const auto put = [&](const Block& block) {
    std::string table = block.table;
    for (const auto& line : block.lines) {
      if (line.starts_with("[["))
        lists.push_back(line + "\n"), table = "[[";
      else if (line[0] == '[')
        table = line.substr(0, line.find(']') + 1), tables[table];
      else if (table.starts_with("[["))
        lists.back() += line + "\n";
      else
        tables[table] += line + "\n";
    }
  };
  for (const Block& block : blocks()) {
    if (!block.active)
      continue;
    bool replaced = false;
    const bool list = block.lines.front().starts_with("[[");
    for (const auto& key : keys_of(block))
      replaced = replaced || (!list && keys.contains(key)) ||
                 ((mesh || segments) && key == "[sheet]edge_length"); // meshes and counts need none
    Block rest = block;
    if (replaced)
      std::erase_if(rest.lines, [](const std::string& line) { return line[0] != '['; });
    put(rest);
  }
  put(option);
  if (keys.contains("[model]faces"))
    tables["[material]"] += "surface_tension = 0.04\n"; // without which it is refused
  std::string text;
  for (const auto& [table, lines] : tables)
    text += table + "\n" + lines;
  for (const auto& list : lists)
    text += list;
  return text;
}

TEST(Example, IsAScene) {
  const Scene scene = parse_scene(example(), "example");
  EXPECT_EQ(scene.solids.size(), 1U);
  EXPECT_EQ(parse_scene(to_toml(scene), "canonical"), scene);
}

TEST(Example, EveryOptionIsAScene) {
  int options = 0;
  for (const Block& block : blocks()) {
    if (block.active)
      continue;
    ++options;
    const std::string text = with(block);
    try {
      const Scene scene = parse_scene(text, "example");
      EXPECT_EQ(parse_scene(to_toml(scene), "canonical"), scene);
      EXPECT_NE(scene, parse_scene(example(), "example")) << text;
    } catch (const Error& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(options, 25);
}

// What the canonical text of all options together writes is what the example explains.
TEST(Example, ShowsEveryKeyThatIsWritten) {
  const std::string text(example());
  for (const Block& block : blocks()) {
    std::istringstream canonical(to_toml(parse_scene(block.active ? text : with(block), "example")));
    std::string line;
    while (std::getline(canonical, line))
      if (!line.empty() && line[0] != '[') {
        EXPECT_NE(text.find(key_of(line) + " = "), std::string::npos) << line;
      }
  }
}

} // namespace
} // namespace sheet::scene
