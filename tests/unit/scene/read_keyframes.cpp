// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a motion in the scene and by file.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "libsheet/scene/write.h"
#include "tests/unit/scene/scenes.h"

namespace sheet::scene {
namespace {

const std::string ball = "[[solid]]\nshape = \"sphere\"\nradius = 0.1\n";

class MotionFile : public FolderOfScene {
protected:
  // A disk, with a solid that moves as the file says.
  Scene read(const std::string& rows, const std::string& solid = ball) {
    return read_beside("arm.csv", rows,
                       disk + liquid + solid + "motion = {kind = \"keyframed\", file = \"arm.csv\"}\n");
  }
  // Behind the place in the scene and the file's folder.
  std::string fault(const std::string& rows) {
    try {
      (void)read(rows);
      return "fine";
    } catch (const Error& error) {
      const std::string text = error.what();
      const std::size_t file = text.find("arm.csv");
      EXPECT_TRUE(text.find("scene.toml:12:") != std::string::npos && file != std::string::npos) << text;
      return text.substr(file + 7);
    }
  }
};

TEST_F(MotionFile, IsTheListsOfTheScene) {
  const Scene scene = read("# an arm\r\ntime [ms], x [mm], y [mm], z [mm], qw, qx [1], qy, qz\r\n"
                           "0, 100, 0, -50, 1, 0, 0, 0\n\n  500,+200, 0, 1e1,-0.8, 0, -0.6, 0\n");
  const std::string box =
      "[[solid]]\nshape = \"sphere\"\nradius = 0.1\ncenter = [0.1, 0, -0.05]\n"
      "motion = {kind = \"keyframed\", times = [0, \"0.5 s\"], places = [[0.1, 0, \"-5 cm\"], [0.2, "
      "0, 0.01]], rotations = [[1, 0, 0, 0], [0.8, 0, 0.6, 0]]}";
  EXPECT_EQ(scene, parse_scene(disk + liquid + box, "s"));
  EXPECT_EQ(parse_scene(to_toml(scene), "s"), scene); // it needs the file no more
}

TEST_F(MotionFile, AndSceneMayBeginWithAByteOrderMark) {
  const std::string rows = "time, x, y, z\n0, 0, 0, 0\n1, 1, 0, 0\n", mark = "\xEF\xBB\xBF";
  const Scene plain = read(rows);
  EXPECT_EQ(read(mark + rows), plain);
  std::ofstream(folder_ / "marked.toml") << mark << std::ifstream(folder_ / "scene.toml").rdbuf();
  EXPECT_EQ(read_scene(folder_ / "marked.toml"), plain);
  std::string utf16 = "\xFF\xFE";
  for (const char c : rows)
    utf16 += {c, '\0'};
  EXPECT_EQ(fault(utf16).substr(0, 15), ": it is UTF-16,");
}

TEST_F(MotionFile, ASolidThatDoesNotSayWhereItIsIsThere) {
  const std::string rows = "qw, qx, qy, qz, time, z, y, x\n0.8, 0, 0, 0.6, -1, 3, 2, 1\n0.8, 0, 0, 0.6, 1, 5, 2, 1\n";
  const std::string box = "[[solid]]\nshape = \"box\"\nsize = [1, 1, 1]\n";
  const Solid there = read(rows, box).solids[0];
  EXPECT_LT((there.center - Vector3d(1, 2, 4)).norm(), 1e-15);
  EXPECT_LT((there.rotation->axis * there.rotation->angle - Vector3d(0, 0, 2 * std::atan2(0.6, 0.8))).norm(), 1e-15);
  const Solid said = read(rows, box + "center = [0, 0, 0]\nrotation = {axis = [1, 0, 0], angle = 0}\n").solids[0];
  EXPECT_EQ(said.center, Vector3d(0, 0, 0));
  EXPECT_EQ(said.rotation->angle, 0);
}

TEST_F(MotionFile, NearlyUnitQuaternionsAreMadeUnit) {
  const Scene scene =
      read("time, qw, qx, qy, qz\n0, 1.0009, 0, 0, 0\n1, 0.6, 0, 0.8, 0\n2, 0, 0, 1, 0", ball + "center = [0, 7, 0]\n");
  const auto& motion = std::get<Keyframed>(scene.solids[0].motion);
  EXPECT_EQ(motion.frames->rotations()[0].w(), 1);
  EXPECT_EQ(motion.frames->center(), Vector3d(0, 7, 0)); // the solid's
}

TEST_F(MotionFile, ErrorsNameTheLine) {
  const std::string head = "time, x, y, z\n0, 0, 0, 0\n";
  const std::string turn = "time, qw, qx, qy, qz\n0, 1, 0, 0, 0\n";
  for (const auto& [rows, expected] : std::vector<std::pair<std::string, std::string>>{
           {"", ":1: it holds no rows; the first line names the columns, such as time [s], x [m], y [m], z [m]"},
           {"time, x, y\n", ":1: column \"z\" is missing"},
           {"x, y, z\n", ":1: column \"time\" is missing"},
           {"time, qw, qx, qy\n", ":1: column \"qz\" is missing"},
           {"time\n0\n1\n", ":1: neither x, y, z nor qw, qx, qy, qz: nothing would move"},
           {"times, x, y, z\n", ":1: unknown column \"times\"; did you mean \"time\"?"},
           {"time, a, b, c\n", ":1: unknown column \"a\"; known: time, x, y, z, qw, qx, qy, qz"},
           {"0, 0, 0, 0\n", ":1: the first line names the columns, such as time [s], x [m], y [m], z [m]"},
           {"time [s];x [m];y [m];z [m]\n0;0;0;0\n",
            ":1: columns are separated by commas, not by semicolons; numbers have a decimal point"},
           {"time\tx\ty\tz\n", ":1: columns are separated by commas, not by tabs; numbers have a decimal point"},
           {"time, x, x, y, z\n", ":1: column \"x\" stands there twice"},
           {"time, x [s], y, z\n", ":1: column \"x\": expected a length such as \"2.5 mm\", got a time (s)"},
           {"time, x [m, y, z\n", ":1: column \"x [m\": a unit stands in brackets, such as x [m]"},
           {head + "1, 2, 3\n", ":3: 3 values, but the first line names 4 columns"},
           {head + "\n1, 2, nan, 3\n", ":4: column \"y\": \"nan\" is not a finite number"},
           {head + "1, 2, , 3\n", ":3: column \"y\": \"\" is not a finite number"},
           {head + "1, 2, 3m, 3\n", ":3: column \"y\": \"3m\" is not a finite number"},
           {head + "0, 1, 1, 1\n", ":3: times must increase, but 0 s follows 0 s"},
           {head + "# and\n-1, 1, 1, 1\n", ":4: times must increase, but -1 s follows 0 s"},
           {head, ":2: a motion takes two rows or more"},
           {"time, x, y, z\n", ":1: a motion takes two rows or more"},
           {turn + "1, 1, 0.1, 0, 0\n", ":3: a rotation is a unit quaternion, but this one has the norm 1.005"},
           {turn + "1, 0, 0, 0, 1\n",
            ":3: from the row before it turns by half a turn, so there is no telling which way "
            "round: give more rows"}})
    EXPECT_EQ(fault(rows), expected) << rows;
}

TEST_F(MotionFile, HasABoundOfRows) {
  std::string rows = "time, x, y, z\n";
  for (int i = 0; i < 16000; ++i)
    rows += std::to_string(i) + ".123456789012345, 0.1234567890123456, -1.234567890123456e-7, 0.9876543210987654\n";
  EXPECT_EQ(fault(rows), "fine");
  const Scene scene = read(rows);
  EXPECT_EQ(parse_scene(to_toml(scene), "s"), scene);
  EXPECT_EQ(fault(rows + "16000, 0, 0, 0\n"), ":16002: more than 16000 rows: every frame of a run carries them; take "
                                              "every n-th; what stands between is found by interpolation");
  const std::string motion = "motion = {kind = \"keyframed\", file = \"arm.csv\"}\n";
  EXPECT_THROW((void)read(rows, ball + motion + ball), Error); // two of them
}

TEST(Keyframed, ListsThatAreWrong) {
  const auto fault = [](const std::string& keys) {
    return problem(disk + liquid + ball + "motion = {kind = \"keyframed\", " + keys + "}\n");
  };
  EXPECT_EQ(fault("times = [0, 1], places = [[0, 0, 0], [1, 0, 0]]"), "fine");
  EXPECT_EQ(fault("times = [0, 1]"),
            "s:12:10: missing key \"places\" in motion, such as places = [[0, 0, 0], [0, 0.1, 0], "
            "[0, 0.1, 0.1]]");
  EXPECT_EQ(fault("places = [[0, 0, 0], [1, 0, 0]]"),
            "s:12:10: missing key \"times\" in motion, such as times = [0, \"0.5 s\", \"1 s\"]");
  EXPECT_EQ(fault("times = [0, 1], places = [[0, 0, 0]]"), "s:12:56: places: 1 of them, but 2 times");
  EXPECT_EQ(fault("times = [0, 0], places = [[0, 0, 0], [1, 0, 0]]"),
            "s:12:43: times: times must increase, but 0 s follows 0 s");
  EXPECT_EQ(fault("times = [0, 1, 2], places = [[0, 0, 0], [1, 0, 0], [1e308, 0, 0]]"),
            "s:12:46: times: from the row before it moves by inf m in 1 s, a velocity beyond the range of numbers");
  EXPECT_EQ(fault("times = [0, 1e-320], rotations = [[1, 0, 0, 0], [0, 1, 0, 0]]"),
            "s:12:43: times: from the row before it moves by 0 m in 1e-320 s, a velocity beyond the range of numbers");
  EXPECT_EQ(fault("times = [0, 1], rotations = [[1, 0, 0], [1, 0, 0]]"),
            "s:12:60: rotations: expected unit quaternions [w, x, y, z]");
  EXPECT_EQ(fault("times = [], places = []"), "s:12:39: times: a motion takes two rows or more");
  EXPECT_EQ(fault("times = [0, 1], places = [[0, 0, 0], [1, 0, 0]], center = [0, 0, 0]"),
            "s:12:80: key \"center\" has no meaning in motion: it turns about the places");
  EXPECT_EQ(fault("file = \"arm.csv\", times = [0, 1]"),
            "s:12:38: file: rows by file need a scene that is a file; here they stand in the scene: times, places, "
            "rotations\ns:12:49: key \"times\" has no meaning in motion: the rows are those of the file");
  EXPECT_EQ(fault("velocity = [0, 0, 1], times = [0, 1], places = [[0, 0, 0], [1, 0, 0]]"),
            "s:12:31: key \"velocity\" has no meaning in motion: a keyframed motion takes file, or times with places, "
            "rotations or both; interpolation");
}

TEST(Keyframed, InterpolationIsReadAndWritten) {
  const auto text = [](const std::string& motion) { return disk + liquid + ball + "motion = {" + motion + "}\n"; };
  const std::string rows = "kind = \"keyframed\", times = [0, 1], places = [[0, 0, 0], [1, 0, 0]]";
  const auto interpolation = [](const Scene& scene) {
    return std::get<Keyframed>(scene.solids.at(0).motion).frames->interpolation();
  };
  EXPECT_EQ(interpolation(parse_scene(text(rows), "s")), Interpolation::smooth);
  for (const auto& [word, wanted] :
       {std::pair("smooth", Interpolation::smooth), {"linear", Interpolation::linear}, {"step", Interpolation::step}}) {
    const Scene scene = parse_scene(text(rows + ", interpolation = \"" + word + "\""), "s");
    EXPECT_EQ(interpolation(scene), wanted);
    EXPECT_EQ(parse_scene(to_toml(scene), "s"), scene);
  }
  EXPECT_EQ(problem(text("kind = \"translating\", velocity = [0, 0, 1], interpolation = \"linear\"")),
            "s:12:55: key \"interpolation\" has no meaning in motion: a translating motion takes velocity");
}

} // namespace
} // namespace sheet::scene
