// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame's union is made with, and the frame's arrays on it.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/shape/union_mesh.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

using formats::Array;
using formats::Frame;
using formats::MeshArray;
using formats::MeshPlace;

constexpr double thick = 0.002, side = 0.02;

// A square plate of two triangles in the plane z = 0; the second is `ratio` times as thick as the first.
Frame plate(double ratio = 1) {
  const std::vector<Vector3> x{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
  const std::vector<Corners> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<double> volume{side * side / 2 * thick, side * side / 2 * thick * ratio};
  return make_frame(x, triangles, volume);
}

template <class T>
void put(Frame& frame, const char* name, formats::Place place, formats::Transfer transfer, std::vector<T> values) {
  Array array;
  array.name = name;
  array.place = place;
  array.type = formats::type_of<T>();
  array.transfer = transfer;
  array.rows = values.size();
  array.data.resize(sizeof(T) * values.size());
  std::ranges::copy(values, array.values<T>().begin());
  frame.put(std::move(array));
}

TEST(UnionMesh, IsChosenByThickness) {
  const ChosenUnion even = choose_union(plate(), {});
  EXPECT_NEAR(even.options.voxel, thick / 4, 1e-15);
  EXPECT_EQ(even.options.voxel, even.wanted_voxel);
  EXPECT_NEAR(even.options.close, thick / 4, 1e-15);
  EXPECT_NEAR(even.options.thickness, thick, 1e-15);
  EXPECT_NEAR(even.options.volume, side * side * thick, 1e-20);
  const ChosenUnion uneven = choose_union(plate(3), {});
  EXPECT_NEAR(uneven.options.voxel, thick / 4, 1e-15); // of the thinnest
  const ChosenUnion given = choose_union(plate(), {.voxel = 1e-3, .close = 0.0, .keep_voids = true});
  EXPECT_EQ(given.options.voxel, 1e-3);
  EXPECT_EQ(given.options.close, 0);
  EXPECT_TRUE(given.options.keep_voids);
}

TEST(UnionMesh, HasNoMoreVoxelsThanFit) {
  Frame thin = plate();
  for (double& volume : volumes(thin))
    volume *= 1e-2;
  const ChosenUnion chosen = choose_union(thin, {});
  EXPECT_NEAR(chosen.wanted_voxel, thick / 4e2, 1e-12);
  EXPECT_GT(chosen.options.voxel, chosen.wanted_voxel);
  // both sides have three voxels outside and half the thickness inside, and what is closed
  const double voxel = chosen.options.voxel;
  EXPECT_NEAR(2 * side * side * (3 * voxel + thick / 2e2 + thick / 4e2) / std::pow(voxel, 3) / most_voxels, 1, 0.01);
  try {
    (void)choose_union(plate(), {.voxel = 1e-7, .close = {}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("--voxel: 1e-07 m"));
    EXPECT_THAT(error.what(), testing::HasSubstr("m or more"));
  }
}

TEST(UnionMesh, RefusesVoxelsThatNothingIsLeftOn) {
  EXPECT_NO_THROW((void)choose_union(plate(), {.voxel = 1.9 * thick, .close = {}}));
  EXPECT_THROW((void)choose_union(plate(), {.voxel = 2.1 * thick, .close = {}}), Error);
  Frame vast = plate();
  positions(vast)[1].x() = 1e29; // a sheet like this has no voxel
  EXPECT_THROW((void)choose_union(vast, {}), Error);
}

TEST(UnionMesh, CarriesArraysFromTheNearestPoint) {
  Frame frame = plate();
  const auto v = velocities(frame);
  for (std::size_t i = 0; i < 4; ++i)
    v[i] = Vector3(positions(frame)[i].x(), 2 * positions(frame)[i].y(), 1);
  put<std::uint64_t>(frame, "touch", formats::Place::vertex, formats::Transfer::common, {1, 2, 4, 8});
  put<double>(frame, "colour", formats::Place::triangle, formats::Transfer::copy, {10, 20});
  const ChosenUnion chosen = choose_union(frame, {});
  const formats::ForeignMesh mesh = union_mesh(frame, unite_layers(frame, chosen.options));
  const MeshArray* const velocity = mesh.find("velocity", MeshPlace::point);
  const MeshArray* const touch = mesh.find("touch", MeshPlace::point);
  const MeshArray* const thickness = mesh.find("thickness", MeshPlace::point);
  const MeshArray* const colour = mesh.find("colour", MeshPlace::cell);
  ASSERT_TRUE(velocity != nullptr && touch != nullptr && thickness != nullptr && colour != nullptr);
  EXPECT_EQ(mesh.find("volume", MeshPlace::cell), nullptr); // a sum: it is no triangle's of this mesh
  ASSERT_GT(mesh.points.size(), 1000U);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double x = std::clamp(mesh.points[i][0], 0.0, side), y = std::clamp(mesh.points[i][1], 0.0, side);
    EXPECT_NEAR(velocity->values[3 * i], x, 1e-9);
    EXPECT_NEAR(velocity->values[3 * i + 1], 2 * y, 1e-9);
    EXPECT_DOUBLE_EQ(velocity->values[3 * i + 2], 1);
    EXPECT_NEAR(thickness->values[i], thick, 1e-15);
    if (x < 0.2 * side && y < 0.2 * side) {
      EXPECT_EQ(touch->values[i], 1);
    } else if (x > 0.8 * side && y < 0.2 * side) {
      EXPECT_EQ(touch->values[i], 2);
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& first = mesh.points[mesh.triangles[t][0]];
    if (std::abs(first[0] - first[1]) > 1e-6 && first[0] > 0 && first[1] > 0 && first[0] < side && first[1] < side) {
      EXPECT_EQ(colour->values[t], first[0] > first[1] ? 10 : 20);
    }
  }
}

TEST(UnionMesh, InterpolatesNoBits) {
  Frame frame = plate();
  put<std::uint64_t>(frame, "mask", formats::Place::vertex, formats::Transfer::common,
                     {9007199254740993U, 1, 9007199254740995U, 3});
  const formats::ForeignMesh mesh = union_mesh(frame, unite_layers(frame, choose_union(frame, {}).options));
  const MeshArray* const low = mesh.find("mask.low32", MeshPlace::point);
  ASSERT_NE(low, nullptr);
  for (const double value : low->values)
    EXPECT_TRUE(value == 1 || value == 3) << value;
}

TEST(UnionMesh, OfAnEmptyFrameIsEmpty) {
  const Frame frame = make_frame({}, {}, {});
  const formats::ForeignMesh mesh = union_mesh(frame, unite_layers(frame, choose_union(frame, {}).options));
  EXPECT_TRUE(mesh.points.empty());
  EXPECT_TRUE(mesh.triangles.empty());
}

} // namespace
} // namespace sheet
