// SPDX-License-Identifier: GPL-3.0-or-later
// Flow curves as measured, in the scene and by file.
#include <string>

#include <gtest/gtest.h>

#include "libsheet/scene/write.h"
#include "tests/unit/scene/scenes.h"

namespace sheet::scene {
namespace {

class CurveFile : public FolderOfScene {
protected:
  Scene read(const std::string& rows) {
    return read_beside("curve.csv", rows, disk + "[material]\ndensity = 1000\nlaw = \"table\"\nfile = \"curve.csv\"\n");
  }
  // Behind the place in the scene and the file's folder.
  std::string fault(const std::string& rows) {
    try {
      (void)read(rows);
      return "fine";
    } catch (const Error& error) {
      const std::string text = error.what();
      const std::size_t place = text.find("file: "), file = text.find("curve.csv");
      EXPECT_TRUE(text.find("scene.toml:") != std::string::npos && place != std::string::npos) << text;
      return file != std::string::npos ? text.substr(file + 9) : text.substr(place + 6);
    }
  }
};

TEST_F(CurveFile, IsTheListsOfTheScene) {
  const Scene scene = read("# measured\r\nviscosity [P], rate [1/s]\n900, 0.1\n 800,1\n\n300, 10\n90, 1e2\n");
  const Scene lists = parse_scene(disk + "[material]\ndensity = 1000\nlaw = \"table\"\nrates = [0.1, 1, 10, "
                                         "100]\nviscosities = [90, 80, 30, \"9 Pa*s\"]\n",
                                  "s");
  EXPECT_EQ(scene, lists);
  EXPECT_EQ(parse_scene(to_toml(scene), "s"), scene); // it needs the file no more
}

TEST_F(CurveFile, TellsWhatIsWrongAndWhere) {
  EXPECT_EQ(fault(""), ":1: it holds no rows; the first line names the columns, such as rate [1/s], viscosity [Pa*s]");
  EXPECT_EQ(fault("rate, viscosity\n1, 4\n2, 3\n3, 2\n"), ":1: a table takes four rows or more");
  EXPECT_EQ(fault("rate, viscosity\n1, 4\n1, 3\n3, 2\n4, 2\n"), ":3: rates must increase from each row to the next");
  EXPECT_EQ(fault("rate, viscosity\n1, 4\n2, -3\n3, 2\n4, 2\n"), ":3: a rate and a viscosity are positive");
  EXPECT_EQ(fault("#\nrate\n1\n"), ":2: column \"viscosity\" is missing");
  EXPECT_EQ(fault("rate, viscosities\n1, 4\n"), ":1: unknown column \"viscosities\"; did you mean \"viscosity\"?");
  EXPECT_EQ(fault("rate [Hz], viscosity [m]\n1, 4\n"),
            ":1: column \"viscosity\": expected a viscosity such as \"100 Pa*s\", got a length (m)");
  EXPECT_EQ(fault("rate, viscosity\n1, 200\n2, 20\n3, 2\n4, 1\n").substr(0, 27), "in its rows the stress fall");
}

TEST(CurveInAFrame, NamesNoFile) {
  try {
    (void)parse_scene(disk + "[material]\ndensity = 1000\nlaw = \"table\"\nfile = \"curve.csv\"\n", "s");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("rows by file need a scene that is a file"), std::string::npos);
  }
}

} // namespace
} // namespace sheet::scene
