// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays through a change of the mesh: every rule, row by row and for whole frames.
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/sheet/transfer.h"

namespace sheet {
namespace {

using Eigen::Vector3d;
using formats::Array;
using formats::Frame;
using formats::make_array;
using formats::Place;
using formats::Transfer;
using formats::Type;
using testing::ElementsAre;

template <class T>
Array column(const char* name, Place place, Transfer rule, const std::vector<T>& values, std::uint32_t components = 1) {
  Array array = make_array(name, place, formats::type_of<T>(), components, "1", rule, values.size() / components);
  std::copy(values.begin(), values.end(), array.template values<T>().begin());
  return array;
}

template <class T> std::vector<T> row(const Array& from, const std::vector<Parent>& parents) {
  std::vector<T> to(from.components);
  transfer_row(from, parents, reinterpret_cast<std::byte*>(to.data()));
  return to;
}

template <class T> std::vector<T> values(const Frame& frame, const char* name) {
  const auto v = frame.find(name)->values<T>();
  return {v.begin(), v.end()};
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(TransferRow, CopyTakesTheHeaviestParentTheFirstOfEquals) {
  const Array a = column<std::int32_t>("a", Place::vertex, Transfer::copy, {10, 11, 20, 21, 30, 31}, 2);
  EXPECT_THAT(row<std::int32_t>(a, {{0, 0.25, 1}, {2, 0.5, 0}, {1, 0.25, 0}}), ElementsAre(30, 31));
  EXPECT_THAT(row<std::int32_t>(a, {{2, 0.5, 0}, {1, 0.5, 1}}), ElementsAre(30, 31));
}

TEST(TransferRow, InterpolateIsTheWeightedMean) {
  const Array a = column<double>("a", Place::vertex, Transfer::interpolate, {1, 2, 4});
  EXPECT_THAT(row<double>(a, {{0, 0.5, 0}, {2, 0.25, 0}, {1, 0.25, 0}}), ElementsAre(2));
  const Array b = column<float>("b", Place::vertex, Transfer::interpolate, {1, 2, 4});
  EXPECT_THAT(row<float>(b, {{0, 0.5, 0}, {2, 0.5, 0}}), ElementsAre(2.5F));
}

TEST(TransferRow, OneParentGivesItsBits) {
  const Array a = column<double>("a", Place::vertex, Transfer::interpolate, {0.1, nan});
  EXPECT_THAT(row<double>(a, {{0, 1, 0}}), ElementsAre(0.1));
  EXPECT_THAT(row<double>(a, {{1, 1, 0}}), ElementsAre(testing::NanSensitiveDoubleEq(nan)));
}

TEST(TransferRow, ConserveSumsSharesAndNothingIsZero) {
  const Array a = column<double>("a", Place::triangle, Transfer::conserve, {8, 4});
  EXPECT_THAT(row<double>(a, {{0, 0, 0.25}, {1, 1, 0.5}}), ElementsAre(4));
  EXPECT_THAT(row<double>(a, {}), ElementsAre(0));
  EXPECT_THAT(row<double>(a, {{0, 1, 0}}), ElementsAre(0));
}

TEST(Lineage, ByVolumeWeighsParentsByWhatTheyGive) {
  Lineage lineage;
  const std::vector<Parent> parents{{0, 0.5, 0.25}, {1, 0.5, 1}}, nothing{{0, 1, 0}};
  lineage.add(parents);
  lineage.add(nothing);
  const Lineage by_volume = lineage.by_volume(std::vector<double>{8, 6});
  EXPECT_EQ(by_volume[0][0].weight, 0.25);
  EXPECT_EQ(by_volume[0][1].weight, 0.75);
  EXPECT_EQ(by_volume[1][0].weight, 1); // what has no volume yet is like its parent
}

TEST(TransferRow, CommonKeepsTheBitsOfAll) {
  const Array a = column<std::uint64_t>("a", Place::vertex, Transfer::common, {0b1101, 0b0111, 1ULL << 63 | 0b0101});
  EXPECT_THAT(row<std::uint64_t>(a, {{0, 0.5, 0}, {1, 0.5, 0}}), ElementsAre(0b0101));
  EXPECT_THAT(row<std::uint64_t>(a, {{0, 0.5, 0}, {1, 0.25, 0}, {2, 0.25, 0}}), ElementsAre(0b0101));
  EXPECT_THAT(row<std::uint64_t>(a, {{2, 1, 1}}), ElementsAre(1ULL << 63 | 0b0101));
  EXPECT_THAT(row<std::uint64_t>(a, {{0, 1, 1}, {1, 0, 1}}), ElementsAre(0b1101)); // gives of its amount only
  const Array b = column<std::int8_t>("b", Place::vertex, Transfer::common, {-1, 6});
  EXPECT_THAT(row<std::int8_t>(b, {{0, 0.5, 0}, {1, 0.5, 0}}), ElementsAre(6));
}

TEST(TransferRow, DropHasNoRows) {
  const Array a = column<double>("a", Place::vertex, Transfer::drop, {1});
  EXPECT_THROW(row<double>(a, {{0, 1, 1}}), std::logic_error);
}

// A square of two triangles with an array of each rule at each place.
//   3 -- 2
//   | \  |
//   0 -- 1
Frame square() {
  const std::vector<Vector3d> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Corners> t{{0, 1, 3}, {1, 2, 3}};
  Frame frame = make_frame(x, t, std::vector<double>{0.5, 0.25});
  frame.put(column<std::uint32_t>("name", Place::vertex, Transfer::copy, {10, 11, 12, 13}));
  frame.put(column<double>("gone", Place::vertex, Transfer::drop, {0, 0, 0, 0}));
  frame.put(column<double>("mass", Place::vertex, Transfer::conserve, {1, 2, 3, 4}));
  frame.put(column<double>("heat", Place::triangle, Transfer::interpolate, {100, 300}));
  frame.put(column<double>("warmth", Place::triangle, Transfer::mean, {300, 400}));
  frame.put(column<double>("dye", Place::triangle, Transfer::conserve, {1, 7}));
  frame.put(column<double>("note", Place::frame, Transfer::copy, {1, 2, 3}));
  frame.put(column<double>("mood", Place::frame, Transfer::drop, {1}));
  return frame;
}

// The second triangle is cut in two at a new vertex 4 in the middle of edge (1, 2); vertex 0 and the first triangle go.
void cut(Frame& frame) {
  Lineage vertices, triangles;
  vertices.keep(1);
  vertices.keep(2);
  vertices.keep(3);
  const std::vector<Parent> both{{1, 0.5, 0}, {2, 0.5, 0}};
  vertices.add(both);
  const Parent half{1, 1, 0.5};
  triangles.add({&half, 1});
  triangles.add({&half, 1});
  const std::vector<Corners> corners{{0, 3, 2}, {3, 1, 2}};
  transfer_frame(frame, vertices, triangles, corners);
}

TEST(TransferFrame, EveryArrayGoesByItsRule) {
  Frame frame = square();
  cut(frame);
  EXPECT_EQ(formats::find_form_error(frame), "");
  EXPECT_EQ(formats::find_value_error(frame), "");
  EXPECT_EQ(frame.vertices, 4);
  EXPECT_EQ(frame.triangles, 2);
  EXPECT_EQ(positions(frame)[3], Vector3d(1, 0.5, 0));
  EXPECT_EQ(triangles(frame)[1], (Corners{3, 1, 2}));
  EXPECT_THAT(values<double>(frame, "volume"), ElementsAre(0.125, 0.125));
  EXPECT_THAT(values<std::uint32_t>(frame, "name"), ElementsAre(11, 12, 13, 11));
  EXPECT_THAT(values<double>(frame, "mass"), ElementsAre(2, 3, 4, 0));
  EXPECT_THAT(values<double>(frame, "heat"), ElementsAre(300, 300));
  EXPECT_THAT(values<double>(frame, "dye"), ElementsAre(3.5, 3.5));
  EXPECT_THAT(values<double>(frame, "warmth"), ElementsAre(400, 400));
  EXPECT_THAT(values<double>(frame, "note"), ElementsAre(1, 2, 3));
  EXPECT_EQ(frame.find("gone"), nullptr);
  EXPECT_EQ(frame.find("mood"), nullptr);
}

TEST(TransferFrame, KeepingEverythingKeepsTheBitsAndTheOrder) {
  Frame frame = square();
  frame.erase("gone");
  frame.erase("mood");
  const Frame before = frame;
  Lineage vertices, kept;
  for (std::uint32_t v = 0; v < 4; ++v)
    vertices.keep(v);
  kept.keep(0);
  kept.keep(1);
  const std::vector<Corners> corners(triangles(before).begin(), triangles(before).end());
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_EQ(frame, before);
}

TEST(TransferFrame, ToNothingAndFromNothing) {
  Frame frame = square();
  transfer_frame(frame, {}, {}, {});
  EXPECT_EQ(formats::find_value_error(frame), "");
  EXPECT_EQ(frame.vertices, 0);
  frame = make_frame({}, {}, {});
  transfer_frame(frame, {}, {}, {});
  EXPECT_EQ(formats::find_form_error(frame), "");
}

TEST(TransferFrame, ArraysAtEdgesFollowTheNearestEdgeAndKeepTheirSum) {
  Frame frame = square();
  frame.edges = 5; // (0,1) (0,3) (1,2) (1,3) (2,3)
  frame.put(column<std::int32_t>("mark", Place::edge, Transfer::copy, {1, 3, 12, 13, 23}));
  frame.put(column<double>("wear", Place::edge, Transfer::conserve, {1, 2, 4, 8, 16}));
  frame.put(column<double>("lost", Place::edge, Transfer::drop, {1, 2, 3, 4, 5}));
  cut(frame);
  EXPECT_EQ(formats::find_value_error(frame), "");
  EXPECT_EQ(frame.edges, 5); // (0,2) (0,3) (1,2) (1,3) (2,3): old (1,3), halves of (1,2), (2,3), and the new one
  EXPECT_THAT(values<std::int32_t>(frame, "mark"), ElementsAre(13, 12, 23, 12, testing::AnyOf(13, 12, 23)));
  const auto wear = values<double>(frame, "wear");
  EXPECT_EQ(std::accumulate(wear.begin(), wear.end(), 0.0), 31);
  EXPECT_EQ(frame.find("lost"), nullptr);
}

// Vertex 2 hangs on the middle of edge (0, 1).
Frame with_spring(std::array<std::uint32_t, 4> vertices) {
  Frame frame = square();
  frame.put(make_array("contact_vertex", Place::frame, Type::uint32, 4, "1", Transfer::drop, 1));
  std::copy(vertices.begin(), vertices.end(), frame.find("contact_vertex")->values<std::uint32_t>().begin());
  const auto put = [&](const char* name, const char* unit, std::vector<double> v) {
    frame.put(
        make_array(name, Place::frame, Type::float64, static_cast<std::uint32_t>(v.size()), unit, Transfer::drop, 1));
    std::copy(v.begin(), v.end(), frame.find(name)->values<double>().begin());
  };
  put("contact_weight", "1", {1, -0.5, -0.5, 0});
  put("contact_normal", "1", {0, 1, 0});
  put("contact_rest", "m", {1});
  put("contact_anchor", "m", {0.5, 1, 0});
  put("contact_stiffness", "N/m", {7, 5});
  return frame;
}

TEST(TransferFrame, SpringsFollowTheLargestShare) {
  Frame frame = with_spring({2, 0, 1, 3});
  Lineage vertices, kept;
  const std::vector<std::vector<Parent>> rows{{{0, 1, 0.25}}, {{1, 1, 1}}, {{2, 1, 1}}, {{3, 1, 1}}, {{0, 1, 0.75}}};
  for (const auto& parents : rows)
    vertices.add(parents);
  kept.keep(0);
  kept.keep(1);
  const std::vector<Corners> corners{{4, 1, 3}, {1, 2, 3}};
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_THAT(values<std::uint32_t>(frame, "contact_vertex"), ElementsAre(2, 4, 1, 3));
  EXPECT_THAT(values<double>(frame, "contact_rest"), ElementsAre(1));
  EXPECT_THAT(values<double>(frame, "contact_stiffness"), ElementsAre(7, 5));
}

TEST(TransferFrame, SpringsOfVerticesThatMoveKeepTheirStrain) {
  Frame frame = with_spring({2, 0, 1, 3});
  Lineage vertices, kept;
  const std::vector<Parent> moved{{2, 0.5, 1}, {1, 0.5, 0}}; // from (1, 1) to (1, 0.5)
  vertices.keep(0);
  vertices.keep(1);
  vertices.add(moved);
  vertices.keep(3);
  kept.keep(0);
  kept.keep(1);
  const std::vector<Corners> corners{{0, 1, 3}, {1, 2, 3}};
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_THAT(values<double>(frame, "contact_rest"), ElementsAre(0.5));
  EXPECT_THAT(values<double>(frame, "contact_anchor"), ElementsAre(0.5, 0.5, 0));
}

// Vertex 4 presses on a triangle, two of whose corners become one: what is left of it is a side of the one beside.
TEST(TransferFrame, SpringsStayWhereTheirTriangleShrinksToASide) {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0},       {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                       {0.25, 0.25, 1}, {5, 0, 1}, {5, 1, 1}};
  Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}}, std::vector<double>(3, 1));
  const Frame spring = with_spring({4, 0, 1, 2});
  for (const auto& array : spring.arrays)
    if (array.name.starts_with("contact_"))
      frame.put(array);
  std::ranges::copy(std::array{1.0, -0.5, -0.25, -0.25}, frame.find("contact_weight")->values<double>().begin());
  Lineage vertices, kept;
  const std::vector<Parent> merged{{1, 1, 1}, {0, 0, 1}}; // where vertex 1 is
  vertices.add(merged);
  for (const std::uint32_t v : {2, 3, 4, 5, 6})
    vertices.keep(v);
  kept.keep(1);
  kept.keep(2);
  const std::vector<Corners> corners{{0, 2, 1}, {3, 4, 5}};
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_THAT(values<std::uint32_t>(frame, "contact_vertex"), ElementsAre(3, 0, 2, 1));
  EXPECT_THAT(values<double>(frame, "contact_weight"), ElementsAre(1, -0.75, 0, -0.25));
  // the point below moves by 0.5 along x
  EXPECT_THAT(values<double>(frame, "contact_anchor"), ElementsAre(0, 1, 0));
  EXPECT_THAT(values<double>(frame, "contact_rest"), ElementsAre(1));
  EXPECT_EQ(formats::find_value_error(frame), "");
}

// The same of the first of two edges that cross; it must not be taken for a vertex above a triangle.
TEST(TransferFrame, SpringsStayWhereTheirEdgeShrinksToAVertex) {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0},   {1, 0, 0},    {0, 1, 0}, {1, 1, 0},
                                       {0.5, 2, 1}, {0.5, -1, 1}, {5, 1, 1}};
  Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}, {1, 3, 2}, {4, 5, 6}}, std::vector<double>(3, 1));
  const Frame spring = with_spring({0, 1, 4, 5});
  for (const auto& array : spring.arrays)
    if (array.name.starts_with("contact_"))
      frame.put(array);
  std::ranges::copy(std::array{0.5, 0.5, -0.25, -0.75}, frame.find("contact_weight")->values<double>().begin());
  Lineage vertices, kept;
  const std::vector<Parent> merged{{1, 1, 1}, {0, 0, 1}}; // where vertex 1 is
  vertices.add(merged);
  for (const std::uint32_t v : {2, 3, 4, 5, 6})
    vertices.keep(v);
  kept.keep(1);
  kept.keep(2);
  const std::vector<Corners> corners{{0, 2, 1}, {3, 4, 5}};
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_THAT(values<std::uint32_t>(frame, "contact_vertex"), ElementsAre(2, 0, 3, 4));
  EXPECT_THAT(values<double>(frame, "contact_weight"), ElementsAre(0, 1, -0.25, -0.75));
  EXPECT_THAT(values<double>(frame, "contact_anchor"), ElementsAre(1, 1, 0));
  EXPECT_THAT(values<double>(frame, "contact_rest"), ElementsAre(1));
  EXPECT_EQ(formats::find_value_error(frame), "");
}

TEST(TransferFrame, SpringsGoWithAVertexOrWhereTheirFeaturesMeet) {
  Frame frame = with_spring({2, 0, 1, 3});
  cut(frame); // vertex 0 goes
  EXPECT_EQ(frame.find("contact_vertex")->rows, 0);
  EXPECT_EQ(formats::find_value_error(frame), "");

  frame = with_spring({2, 0, 1, 3});
  Lineage vertices, kept;
  const std::vector<Parent> merged{{0, 0.5, 1}, {1, 0.5, 1}};
  vertices.add(merged);
  vertices.keep(2);
  vertices.keep(3);
  const Parent all{1, 1, 1};
  kept.add({&all, 1});
  const std::vector<Corners> corners{{0, 1, 2}};
  transfer_frame(frame, vertices, kept, corners);
  EXPECT_EQ(frame.find("contact_vertex")->rows, 0);
}

} // namespace
} // namespace sheet
