// SPDX-License-Identifier: GPL-3.0-or-later
// What the stage does with frames, good and bad.
#include "libsheet/collide/collide_stage.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {
namespace {

using formats::Frame;

constexpr const char* physics =
    "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n[material]\n"
    "viscosity = 3\ndensity = 1000\n";

// A triangle flies from z = 1 to `end` through another one at z = 0.
Frame two_triangles(double end, const std::string& more) {
  std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, end}, {0.5, 0.2, end}, {0.2, 0.5, end}};
  const std::vector<Corners> t = {{0, 1, 2}, {3, 4, 5}};
  const std::vector<double> volumes = {0.005, 0.001};
  Frame frame = make_frame(x, t, volumes);
  formats::Array start = formats::make_array("start_position", formats::Place::vertex, formats::Type::float64, 3, "m",
                                             formats::Transfer::drop, 6);
  for (std::size_t v = 3; v < 6; ++v) {
    velocities(frame)[v] = Vector3(0, 0, (end - 1) / 0.1);
    x[v].z() = 1;
  }
  std::copy(x.begin(), x.end(), start.values<Vector3>().begin());
  frame.put(std::move(start));
  put_number(frame, "start_time", 0.2);
  frame.time = 0.3;
  frame.put_text("scene", physics + more);
  return frame;
}

std::string error_of(Frame frame) {
  try {
    CollideStage().step(frame);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "";
}

TEST(CollideStage, KeepsTrianglesFromPassing) {
  Frame frame = two_triangles(-1, "[contact]\n");
  CollideStage().step(frame);
  EXPECT_EQ(formats::find_value_error(frame), "");
  const auto x = positions(static_cast<const Frame&>(frame));
  for (std::size_t v = 3; v < 6; ++v)
    EXPECT_GT(x[v].z(), x[0].z());
  EXPECT_NE(frame.find("contact_vertex"), nullptr);
  // what the flying triangle had
  Vector3 momentum = Vector3::Zero();
  for (std::size_t v = 0; v < 6; ++v)
    momentum += (v < 3 ? 5.0 : 1.0) / 3 * velocities(static_cast<const Frame&>(frame))[v];
  EXPECT_LT((momentum - Vector3(0, 0, -20)).norm(), 1e-11);
}

// What is held, or in the inlet, goes its way; the other gives way.
TEST(CollideStage, WhatIsPrescribedGoesItsWay) {
  for (const char* name : {"hold", "inlet"}) {
    Frame frame = two_triangles(-1, "[contact]\n[inflow]\nregion = \"rim\"\nvelocity = [0, 0, 1]\nthickness = 1\n"
                                    "[[hold]]\nregion = \"rim\"\n");
    const auto bits = put_masks(frame, name);
    std::fill(bits.begin() + 3, bits.end(), 1);
    CollideStage().step(frame);
    const auto x = positions(static_cast<const Frame&>(frame));
    for (std::size_t v = 0; v < 3; ++v)
      EXPECT_LT(x[v].z(), -1) << name;
    for (std::size_t v = 3; v < 6; ++v)
      EXPECT_EQ(x[v].z(), -1) << name;
  }
}

// An inlet's border goes on with what has come in, and sheet-emit puts it back: what flies through where it comes from
// is kept out of there.
TEST(CollideStage, BordersOfInletsAreKeptClear) {
  Frame frame = two_triangles(0.5, "[contact]\nself = true\n[inflow]\nregion = \"rim\"\nvelocity = [0, 0, 3]\n");
  const auto bits = put_masks(frame, "inlet");
  auto start = frame.find("start_position")->values<Vector3>();
  auto now = positions(frame);
  for (std::size_t v = 3; v < 6; ++v) { // an inlet's strip above, whose border has gone up from below
    bits[v] = in_inlet | (v == 3 ? at_inlet_border : 0);
    start[v] = now[v] = Vector3(now[v].x(), now[v].y(), v == 3 ? 0.3 : 0.45);
    velocities(frame)[v] = Vector3::Zero();
  }
  now[3].z() = 0.6;
  for (std::size_t v = 0; v < 3; ++v) { // and the triangle below rises past that place, but not as far as the border
    now[v].z() = 0.35;
    velocities(frame)[v].z() = 3.5;
  }
  CollideStage stage;
  stage.step(frame);
  EXPECT_EQ(now[3].z(), 0.6);
  EXPECT_LT(0.6 * now[0].z() + 0.2 * now[1].z() + 0.2 * now[2].z(), 0.3); // under the border's place
}

TEST(CollideStage, WhatTheSceneDoesNotHaveIsLeftAlone) {
  for (const char* more : {"", "[contact]\nself = false\n"}) {
    Frame frame = two_triangles(-1, more);
    frame.erase("start_position");
    const Frame before = frame;
    CollideStage().step(frame);
    EXPECT_EQ(frame, before);
  }
}

TEST(CollideStage, SolidsAlone) {
  Frame frame = two_triangles(-1, "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -0.5]\n");
  CollideStage().step(frame);
  EXPECT_EQ(formats::find_value_error(frame), "");
  const auto x = positions(static_cast<const Frame&>(frame));
  EXPECT_EQ(x[0].z(), 0); // it has been passed through
  EXPECT_GT(x[3].z(), -0.5);
  EXPECT_EQ(frame.find("contact_vertex"), nullptr);
  EXPECT_EQ(frame.find("touch")->values<std::uint64_t>()[3], 1u);
}

TEST(CollideStage, BadFrames) {
  Frame frame = two_triangles(-1, "[contact]\n");
  frame.erase("start_position");
  EXPECT_THAT(error_of(frame), testing::HasSubstr("start_position"));
  frame = two_triangles(-1, "[contact]\n");
  frame.erase("start_time");
  EXPECT_THAT(error_of(frame), testing::HasSubstr("right behind sheet-step"));
  put_number(frame, "start_time", 0.3);
  EXPECT_THAT(error_of(frame), testing::HasSubstr("start_time before 0.3 s"));
  frame = two_triangles(-1, "[contact]\n");
  frame.erase("scene");
  EXPECT_THAT(error_of(frame), testing::HasSubstr("no scene"));
  frame = two_triangles(-1, "[contact]\n");
  for (std::size_t v = 3; v < 6; ++v)
    frame.find("start_position")->values<Vector3>()[v].z() = v == 3 ? -0.5 : 0.5;
  EXPECT_THAT(error_of(frame), testing::HasSubstr("triangles 0 and 1"));
  frame = two_triangles(-1, "[contact]\n");
  frame.find("triangle")->values<Corners>()[1] = {0, 1, 3};
  EXPECT_THAT(error_of(frame), testing::HasSubstr("same direction"));
}

// A frame is complete: a new program goes on like one that has seen all of the run.
// What the stage has made safe is checked again where someone has changed it since.
TEST(CollideStage, ChecksWhatChangedBetweenSteps) {
  const auto next = [](Frame frame) {
    const auto x = positions(static_cast<const Frame&>(frame));
    std::copy(x.begin(), x.end(), frame.find("start_position")->values<Vector3>().begin());
    put_number(frame, "start_time", 0.3);
    frame.time = 0.4;
    return frame;
  };
  CollideStage stage;
  Frame first = two_triangles(0.5, "[contact]\n");
  stage.step(first);
  Frame changed = next(first);
  changed.find("start_position")->values<Vector3>()[5].z() = -1; // through the other triangle
  EXPECT_THROW(stage.step(changed), Error);
  Frame turned = next(first); // the same triangles under other numbers, one of them through the other
  auto corners = turned.find("triangle")->values<Corners>();
  std::swap(corners[0], corners[1]);
  turned.find("start_position")->values<Vector3>()[0].z() = 1;
  EXPECT_THROW(stage.step(turned), Error);
  Frame same = next(first);
  EXPECT_NO_THROW(stage.step(same));
}

TEST(CollideStage, HasNoMemoryThatMatters) {
  CollideStage old;
  Frame first = two_triangles(-1, "[contact]\n"), again = first;
  old.step(first);
  CollideStage().step(again);
  EXPECT_EQ(first, again);
  const auto next = [](Frame frame) {
    std::copy_n(positions(static_cast<const Frame&>(frame)).begin(), 6,
                frame.find("start_position")->values<Vector3>().begin());
    put_number(frame, "start_time", frame.time);
    frame.time += 0.1;
    for (std::size_t v = 3; v < 6; ++v)
      positions(frame)[v].z() -= 0.5;
    return frame;
  };
  Frame second = next(first), fresh = second;
  old.step(second);
  CollideStage().step(fresh);
  EXPECT_EQ(second, fresh);
}

} // namespace
} // namespace sheet::collide
