// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/packed_frame.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sheet::view {
namespace {

// Two triangles with edges of `edge` and its diagonal.
formats::Frame square(double edge, double away = 0) {
  const std::vector<Eigen::Vector3d> x = {{away, 0, 0}, {away + edge, 0, 0}, {away + edge, edge, 0}, {away, edge, 0}};
  const std::vector<Corners> corners = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<double> volumes(2, 0.005 * edge * edge * edge);
  return make_frame(x, corners, volumes);
}

TEST(FramePacker, RoundsByLessThanAThousandthOfAnEdge) {
  for (const double edge : {1e-9, 3e-4, 0.7, 1.0, 5e8}) {
    FramePacker packer;
    const FrameDescription d = packer.pack(square(edge)).description;
    EXPECT_LT(d.position_step / 2, edge / 1000);
    EXPECT_GT(d.position_step, edge / 10000);
    EXPECT_EQ(std::exp2(std::round(std::log2(d.position_step))), d.position_step);
  }
}

// A strip of 20 squares of side 1, the last of which is but `least` long.
formats::Frame strip(double least) {
  std::vector<Eigen::Vector3d> x;
  std::vector<Corners> corners;
  for (std::uint32_t i = 0; i <= 20; ++i) {
    const double at = i < 20 ? i : 19 + least;
    x.insert(x.end(), {{at, 0, 0}, {at, 1, 0}});
    if (i > 0)
      corners.insert(corners.end(), {{2 * i - 2, 2 * i, 2 * i + 1}, {2 * i - 2, 2 * i + 1, 2 * i - 1}});
  }
  return make_frame(x, corners, std::vector<double>(corners.size(), 1e-3));
}

TEST(FramePacker, RoundsByLessThanAThousandthOfTheShortestEdgeUnlessThatIsASliver) {
  const auto error = [](double least) { return FramePacker().pack(strip(least)).description.position_step / 2; };
  EXPECT_GT(error(1), 0.2 / 1000);
  for (const double least : {0.5, 0.2, 0.126})
    EXPECT_LT(error(least), least / 1000);
  for (const double least : {0.124, 1e-3, 0.0}) {
    EXPECT_LT(error(least), 0.125 / 1000);
    EXPECT_GT(error(least), 0.125 / 3000);
  }
}

TEST(FramePacker, TakesALargerStepFarAway) {
  FramePacker packer;
  const double away = 1e12;
  const FrameDescription d = packer.pack(square(1e-3, away)).description;
  EXPECT_LT(away / d.position_step, 0x1p31);
  EXPECT_DOUBLE_EQ(d.low[0], away);
}

TEST(FramePacker, SaysAMeshOnce) {
  FramePacker packer;
  formats::Frame frame = square(1);
  const PackedFrame first = packer.pack(frame);
  EXPECT_FALSE(first.description.same_mesh);
  EXPECT_FALSE(first.description.position_follows);
  positions(frame)[2].z() += 0.01;
  const PackedFrame second = packer.pack(frame);
  EXPECT_TRUE(second.description.same_mesh);
  EXPECT_TRUE(second.description.position_follows);
  EXPECT_LT(second.text.size(), first.text.size());
}

TEST(FramePacker, TellsThicknessSpeedAndVolume) {
  FramePacker packer;
  formats::Frame frame = square(2);
  const FrameDescription still = packer.pack(frame).description;
  EXPECT_FALSE(still.moves);
  for (Eigen::Vector3d& v : velocities(frame))
    v = {3, 0, 4};
  const FrameDescription d = packer.pack(frame).description;
  EXPECT_TRUE(d.moves);
  EXPECT_FALSE(d.velocity_follows);
  const auto range = [&](std::string_view name) {
    return d.fields[static_cast<std::size_t>(&field_named(name) - fields().data())].range;
  };
  EXPECT_DOUBLE_EQ(range("speed").low, 5);
  EXPECT_DOUBLE_EQ(range("thickness").high, 0.02);
  EXPECT_DOUBLE_EQ(d.volume, 0.08);
  EXPECT_LE(d.velocity_step, 5.0 / 16384);
}

TEST(FramePacker, SaysFiniteStepsOfVelocitiesWithoutBound) {
  FramePacker packer;
  formats::Frame frame = square(1);
  velocities(frame)[0] = {1e200, -1e300, 1};
  const FrameDescription d = packer.pack(frame).description;
  EXPECT_TRUE(std::isfinite(d.velocity_step) && d.velocity_step > 0);
}

TEST(FramePacker, TakesAFrameWithoutTriangles) {
  FramePacker packer;
  EXPECT_EQ(packer.pack(make_frame({}, {}, {})).description.triangles, 0U);
}

} // namespace
} // namespace sheet::view
