// SPDX-License-Identifier: GPL-3.0-or-later
// How long edges are that the stage asks for, where a scene's sheets state different ones.
#include "libsheet/remesh/remesh_stage.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/write.h"
#include "libsheet/shape/build.h"

namespace sheet::remesh {
namespace {

// Thin plates beside each other, with such edges and with some of 10 mm, of two liquids or of one.
formats::Frame plates(bool two_liquids, const std::string& left = "edge_length = 0.03",
                      const std::string& right = "edge_length = 0.01") {
  const auto plate = [](const std::string& name, const std::string& edges, const std::string& x) {
    return "[[sheet]]\nname = \"" + name + "\"\nshape = \"rectangle\"\nsize = [0.3, 0.3]\nthickness = 0.001\n" + edges +
           "\ncenter = [" + x + ", 0, 0]\n";
  };
  return build_frame(scene::parse_scene(plate("left", left, "0") + plate("right", right, "1") +
                                            (two_liquids ? "[sheet.material]\nviscosity = 1\ndensity = 1000\n" : "") +
                                            "[material]\nviscosity = 100\ndensity = 1000\n",
                                        "s"));
}

// Mean edge length of what lies left, or right, of the middle [m].
double mean_edge(const formats::Frame& frame, bool left) {
  const auto x = positions(frame);
  double sum = 0, count = 0;
  for (const Corners& c : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i, ++count)
      if ((x[c[0]].x() < 0.5) == left)
        sum += (x[c[(i + 1) % 3]] - x[c[i]]).norm();
      else
        --count;
  return sum / count;
}

TEST(RemeshStage, EachSheetKeepsItsEdges) {
  for (const bool adaptive : {false, true})
    for (const bool two_liquids : {false, true}) {
      formats::Frame frame = plates(two_liquids);
      StageOptions options;
      if (adaptive) {
        options.remeshing.size.chord_error = 0.001;
        options.remeshing.size.min_edge = 0.005;
        options.remeshing.size.max_edge = 0.01;
      }
      RemeshStage(options).remesh(frame);
      EXPECT_NEAR(mean_edge(frame, true), 0.03, 0.003);
      EXPECT_NEAR(mean_edge(frame, false), 0.01, 0.001);
    }
}

// As a mesh has edges of its own, which nothing states, so do counts, of which these make edges of 11 mm in the mean.
TEST(RemeshStage, ASheetThatStatesNoEdgesKeepsItsOwn) {
  const std::string counts = "segments = [30, 30]";
  formats::Frame beside_coarse = plates(true, "edge_length = 0.03", counts),
                 beside_counts = plates(true, "segments = [10, 10]", counts);
  for (formats::Frame* frame : {&beside_coarse, &beside_counts}) {
    const double left = mean_edge(*frame, true), right = mean_edge(*frame, false);
    RemeshStage({}).remesh(*frame);
    EXPECT_NEAR(mean_edge(*frame, true), left, 0.1 * left);
    EXPECT_NEAR(mean_edge(*frame, false), right, 0.1 * right);
  }
}

TEST(RemeshStage, SheetsWithTheSameEdgesAreNotTold) {
  EXPECT_EQ(plates(true, "edge_length = 0.01").find("remesh.sheet_edge"), nullptr);
  EXPECT_NE(plates(false).find("remesh.sheet_edge"), nullptr);
}

TEST(RemeshStage, WhatTheUserSaysHoldsForAll) {
  formats::Frame frame = plates(true);
  StageOptions options;
  options.edge_length = 0.01;
  RemeshStage(options).remesh(frame);
  EXPECT_NEAR(mean_edge(frame, true), 0.01, 0.002);
}

} // namespace
} // namespace sheet::remesh
