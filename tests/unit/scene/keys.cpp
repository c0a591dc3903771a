// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/keys.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "libsheet/scene/example.h"
#include "libsheet/scene/reader.h"

namespace sheet::scene {
namespace {

TEST(Keys, AreListedWithKindUnitAndHelp) {
  const auto listed = listed_keys();
  const auto find = [&](std::string_view path) {
    const auto found = std::ranges::find(listed, path, &ListedKey::path);
    EXPECT_NE(found, listed.end()) << path;
    return found == listed.end() ? std::string() : fmt::format("{}, {}", kind_of(found->key), unit_of(found->key));
  };
  EXPECT_EQ(find("material.viscosity"), "viscosity, Pa*s");
  EXPECT_EQ(find("sheet.thickness"), "length or table, m");
  EXPECT_EQ(find("sheet.rotation.axis"), "number[3], ");
  EXPECT_EQ(find("hold.N.kind"), "pinned|clamped, ");
  EXPECT_EQ(find("solid.N.motion.places"), "length[][3], m");
  EXPECT_EQ(find("solid.N.motion.rate"), "turning rate or rows, rad/s");
  EXPECT_EQ(find("environment.bath.drag"), "drag, Pa*s/m");
  EXPECT_EQ(find("solid.N.file"), "file (.obj .off .ply .stl .vdb), ");
  for (const auto& [path, key] : listed)
    EXPECT_FALSE(key.help.empty() || key.help.ends_with('.') ||
                 key.help.find_first_of("\t\n") != std::string_view::npos)
        << path;
}

TEST(Keys, StandInTheExample) {
  for (const auto& [path, key] : listed_keys())
    EXPECT_NE(example().find(key.name), std::string_view::npos) << path;
}

TEST(Keys, ThatNoTableDeclaresCannotBeRead) {
  const Node table;
  Problems problems("scene", {});
  TableReader reader(table, "[tear]", *scene_keys().find("tear")->below, problems);
  EXPECT_FALSE(reader.quantity("below"));
  EXPECT_THROW((void)reader.quantity("above"), std::logic_error);
  EXPECT_THROW((void)reader.text("below"), std::logic_error);
}

TEST(Keys, NameTheFilesOfADocument) {
  const Node document = parse_toml(R"(sheet = [{shape = "disk"}, {file = "a.ply"}]
solid = [{motion = {file = "b.csv"}, file = "c.off"}]
hold = [{motion = {file = 3}}, {motion = {file = "d.csv"}}]
file = "no key"
)",
                                   "scene");
  std::string text;
  for (const auto& [name, path] : files_named_in(document))
    text += path + "=" + name + " ";
  EXPECT_EQ(text, "sheet.1.file=a.ply hold.1.motion.file=d.csv solid.0.file=c.off solid.0.motion.file=b.csv ");
}

} // namespace
} // namespace sheet::scene
