// SPDX-License-Identifier: GPL-3.0-or-later
// Which rims end in the open, of the unit square.
#include "libsheet/scene/free_faces.h"

#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {
namespace {

// By the sides' names; `prepare` sets up a scene and a frame.
std::map<std::string, double> rims(const std::function<void(Scene&, formats::Frame&)>& prepare) {
  const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  formats::Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}, std::vector<double>{0.005, 0.01});
  Scene scene;
  prepare(scene, frame);
  const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  const FreeFaces faces = free_faces(scene, frame, mesh);
  const std::map<Edge, std::string> names{
      {{0, 1}, "low"}, {{1, 2}, "right"}, {{2, 3}, "high"}, {{0, 3}, "left"}, {{0, 2}, "inner"}};
  std::map<std::string, double> result;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (faces.rims[e] > 0)
      result[names.at(mesh.edges[e])] = faces.rims[e];
  return result;
}

using Rims = std::map<std::string, double>;
const Rims open{{"low", 1}, {"right", 1}, {"high", 1}, {"left", 1}};

Rims without(const std::string& side) {
  Rims rest = open;
  rest.erase(side);
  return rest;
}

void hold(Scene& scene, formats::Frame& frame, Axes axes, const std::vector<std::size_t>& vertices) {
  Hold table;
  table.axes = axes;
  scene.holds.push_back(table);
  const auto masks = put_masks(frame, "hold");
  for (const std::size_t v : vertices)
    masks[v] |= std::uint64_t{1} << (scene.holds.size() - 1);
}

TEST(FreeFaces, HoldsCloseRimsThatTheyKeepFromMovingOutward) {
  EXPECT_EQ(rims([](Scene&, formats::Frame&) {}), open);
  const auto held = [](Axes axes, const std::vector<std::size_t>& vertices) {
    return rims([&](Scene& scene, formats::Frame& frame) { hold(scene, frame, axes, vertices); });
  };
  EXPECT_EQ(held(all_axes, {1, 2}), without("right"));
  EXPECT_EQ(held(axis_bit(0), {1, 2}), without("right"));
  EXPECT_EQ(held(axis_bit(1), {1, 2}), open);
  EXPECT_EQ(held(axis_bit(2), {0, 1, 2, 3}), open);
  EXPECT_EQ(held(all_axes, {1}), open);
}

TEST(FreeFaces, InletsAndOutflowsAreNoRims) {
  const auto with_inlet = [](std::optional<double> until) {
    return rims([&](Scene& scene, formats::Frame& frame) {
      Inflow inflow;
      inflow.until = until;
      scene.inflows.push_back(inflow);
      const auto masks = put_masks(frame, "inlet");
      masks[0] = in_inlet | at_inlet_border;
      masks[3] = in_inlet;
    });
  };
  EXPECT_EQ(with_inlet({}), without("left"));
  EXPECT_EQ(with_inlet(-1), open); // it has ended
  const auto with_outflow = [](double at) {
    return rims([&](Scene& scene, formats::Frame&) { scene.outflows.push_back({{0, at, 0}, {0, 2, 0}}); });
  };
  EXPECT_EQ(with_outflow(2.5), open);
  EXPECT_EQ(with_outflow(1.5), without("high"));
}

TEST(FreeFaces, OfWhatTouchesSolidsTheRimIsTheContactAngles) {
  const auto touching = [](std::optional<double> angle) {
    return rims([&](Scene& scene, formats::Frame& frame) {
      scene.solids.emplace_back().contact_angle = angle;
      put_touched_solids(frame, std::vector<std::int32_t>{no_solid, no_solid, 0, 0}, 1);
    });
  };
  EXPECT_EQ(touching(1), (Rims{{"low", 1}, {"left", 0.5}, {"right", 0.5}}));
  EXPECT_EQ(touching({}), rims([](Scene&, formats::Frame&) {})); // without an angle it is free
}

TEST(FreeFaces, WeldsAreNoRims) {
  EXPECT_EQ(rims([](Scene&, formats::Frame& frame) {
              ContactSpring one, other;
              one.vertices = {0, 1, 2, 3};
              other.vertices = {1, 2, 3, 0};
              one.weights = other.weights = {1, -0.25, -0.25, -0.5};
              one.since = other.since = ContactSpring::always;
              write_springs(frame, std::vector{one, other});
            }),
            without("low"));
}

} // namespace
} // namespace sheet::scene
