// SPDX-License-Identifier: GPL-3.0-or-later
// From frame and scene to the model: holds, their release and motion, vertices that touch solids, contact springs.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/scene_model.h"
#include "libsheet/solve/step_stage.h"

namespace sheet {
namespace {

using formats::Array;
using formats::Frame;
using formats::make_array;
using formats::Place;
using formats::Transfer;
using formats::Type;

constexpr const char* scene_text = R"(
[sheet]
shape = "rectangle"
size = [2, 1]
edge_length = 0.5
thickness = 0.1
[material]
viscosity = 10
density = 1000
[[hold]]
region = "x_min"
kind = "clamped"
until = 0.5
[[hold]]
region = "x_max"
motion = {kind = "translating", velocity = [[0, 0, 0, 0], [0.25, 2, 0, 0]]}
[[solid]]
shape = "plane"
normal = [0, 1, 0]
surface_velocity = [0, 0, 3]
)";

// Two squares side by side: vertices 0 1 2 at z = 0, 3 4 5 at z = -1.
Frame two_squares() {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, -1}, {1, 0, -1}, {2, 0, -1}};
  const std::vector<Corners> t{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  Frame frame = make_frame(x, t, std::vector<double>(4, 0.05));
  frame.put_text("scene", scene_text);
  return frame;
}

void put_masks(Frame& frame, const char* name, std::vector<std::uint64_t> masks) {
  Array array = make_array(name, Place::vertex, Type::uint64, 1, "1", Transfer::common, frame.vertices);
  std::copy(masks.begin(), masks.end(), array.values<std::uint64_t>().begin());
  frame.put(std::move(array));
}

void put_column(Frame& frame, const char* name, const char* unit, std::uint32_t components,
                std::vector<double> values) {
  Array array =
      make_array(name, Place::frame, Type::float64, components, unit, Transfer::drop, values.size() / components);
  std::copy(values.begin(), values.end(), array.values<double>().begin());
  frame.put(std::move(array));
}

// Vertex 2 hangs on the point between vertices 0 and 1, one metre to the side at rest.
void put_spring(Frame& frame) {
  Array vertices = make_array("contact_vertex", Place::frame, Type::uint32, 4, "1", Transfer::drop, 1);
  const std::array<std::uint32_t, 4> v{2, 0, 1, 3};
  std::copy(v.begin(), v.end(), vertices.values<std::uint32_t>().begin());
  frame.put(std::move(vertices));
  put_column(frame, "contact_weight", "1", 4, {1, -0.5, -0.5, 0});
  put_column(frame, "contact_normal", "1", 3, {1, 0, 0});
  put_column(frame, "contact_rest", "m", 1, {1.75});
  put_column(frame, "contact_anchor", "m", 3, {1.5, 0, 0});
  put_column(frame, "contact_stiffness", "N/m", 2, {7, 5});
}

TEST(SceneModel, HoldsAreInForceUntilTheirTime) {
  Frame frame = two_squares();
  put_masks(frame, "hold", {1, 0, 2, 1, 0, 2});
  const Scene scene = parse_scene(scene_text, "test");
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  Model model = model_of(scene, frame, mesh, Bending::mid_edge, false);
  ASSERT_EQ(model.holds.size(), 2u);
  EXPECT_EQ(model.holds[0].vertices, (std::vector<std::uint32_t>{0, 3}));
  ASSERT_EQ(model.holds[0].clamped_edges.size(), 1u);
  EXPECT_EQ(mesh.edges[model.holds[0].clamped_edges[0]], (Edge{0, 3}));
  EXPECT_TRUE(model.holds[1].clamped_edges.empty());
  // Velocity 8 t until 0.25 s, then 2 m/s.
  EXPECT_NEAR(model.holds[1].moved(0, 0.25).shift.x(), 0.25, 1e-15);
  EXPECT_NEAR(model.holds[1].moved(0.25, 1.25).shift.x(), 2, 1e-15);
  frame.time = 0.5;
  model = model_of(scene, frame, mesh, Bending::mid_edge, false);
  ASSERT_EQ(model.holds.size(), 1u);
  EXPECT_EQ(model.holds[0].vertices, (std::vector<std::uint32_t>{2, 5}));
}

TEST(SceneModel, EventsAreKinksAndReleases) {
  const Scene scene = parse_scene(scene_text, "test");
  EXPECT_EQ(next_event(scene, 0), 0.25);
  EXPECT_EQ(next_event(scene, 0.25), 0.5);
  EXPECT_TRUE(std::isinf(next_event(scene, 0.5)));
}

TEST(SceneModel, RowsOfSurroundingsAreEventsAndVaryThem) {
  Frame frame = two_squares();
  const std::string text = std::string(scene_text) +
                           "[heat]\nspecific_heat = 1000\ntemperature = 400\nambient = 300\ntransfer = 20\n"
                           "upper = {ambient = [[0, 300], [0.125, 500]]}\n";
  put_temperatures(std::vector<double>(frame.triangles, 400), frame);
  const Scene scene = parse_scene(text, "test");
  EXPECT_EQ(next_event(scene, 0), 0.125);
  const Model model = model_of(scene, frame, connect(frame.vertices, triangles(frame)), Bending::mid_edge, false);
  ASSERT_TRUE(model.heat && model.heat->local_surroundings[heat::upper]);
  EXPECT_EQ(model.heat->local_surroundings[heat::upper](0.0625, Vector3::Zero()),
            (heat::Surroundings{20, 400, 0, 400}));
  EXPECT_FALSE(model.heat->local_surroundings[heat::lower]);
  EXPECT_EQ(model.heat->surroundings[heat::lower], (heat::Surroundings{20, 300, 0, 300}));
}

TEST(SceneModel, WhatTouchesASolidMovesWithItsSurface) {
  Frame frame = two_squares();
  put_masks(frame, "touch", {1, 1, 0, 1, 1, 0});
  frame.put_text("scene", scene_text);
  StepStageOptions options;
  options.dt = 0.125;
  StepStage stage(options);
  stage.step(frame);
  const auto x = positions(static_cast<const Frame&>(frame));
  for (const int v : {0, 1, 3, 4})
    EXPECT_NEAR(x[v].z() - (v < 3 ? 0 : -1), 0.375, 1e-12);
  const auto velocity = velocities(static_cast<const Frame&>(frame));
  EXPECT_NEAR(velocity[0].z(), 3, 1e-9);
  EXPECT_EQ(frame.time, 0.125);
  EXPECT_EQ(frame.step, 1u);
}

// A plate that speeds up by 4 m/s² carries the sheet upwards: what it gives each vertex is its mass times (g + 4 m/s²).
TEST(SceneModel, TheForceOfASolidIsWrittenWhereTheSheetMayComeOff) {
  const std::string text = std::string(scene_text) +
                           "motion = {kind = \"translating\", velocity = [[0, 0, 0, 0], [1, 0, 4, "
                           "0]]}\n[environment]\ngravity = [0, -9.81, 0]\n[contact]\nself = false\n";
  for (const bool releases : {true, false})
    for (const Scheme scheme : {Scheme::sdirk2, Scheme::backward_euler}) {
      Frame frame = two_squares();
      put_masks(frame, "touch", {1, 1, 1, 1, 1, 1});
      frame.put_text("scene", text + (releases ? "adhesion = 5\n" : ""));
      for (Vector3& v : velocities(frame))
        v = Vector3(0, 0, 3); // the belt's
      StepStageOptions options;
      options.dt = 0.125;
      options.scheme = scheme;
      StepStage(options).step(frame);
      const Array* force = frame.find("touch_force");
      ASSERT_EQ(force != nullptr, releases);
      if (!releases)
        continue;
      EXPECT_EQ(formats::find_value_error(frame), "");
      std::vector<double> mass(6, 0);
      for (const Corners& c : triangles(frame))
        for (const auto corner : c)
          mass[corner] += 1000 * 0.05 / 3;
      for (std::size_t v = 0; v < 6; ++v)
        EXPECT_LT((force->values<Vector3>()[v] - mass[v] * Vector3(0, 13.81, 0)).norm(), 1e-9 * mass[v]) << v;
    }
  Frame free = two_squares();
  put_masks(free, "touch", {1, 1, 0, 1, 1, 0});
  free.put_text("scene", text + "adhesion = 5\n");
  StepStageOptions options;
  options.dt = 0.125;
  StepStage stage(options);
  stage.step(free);
  EXPECT_EQ(free.find("touch_force")->values<Vector3>()[2], Vector3(0, 0, 0));
  put_masks(free, "touch", {0, 0, 0, 0, 0, 0});
  stage.step(free);
  EXPECT_EQ(free.find("touch_force"), nullptr); // nor is the old one left
}

// What sticks to the end of a belt, along which the belt does not run, stays there.
TEST(SceneModel, ABeltStandsAtTheFacesAlongWhichItDoesNotRun) {
  Frame frame = two_squares();
  std::string text = scene_text;
  text.replace(text.find("shape = \"plane\"\nnormal = [0, 1, 0]"), 34,
               "shape = \"box\"\nsize = [8, 2, 0.5]\ncenter = [0, -1, 0]\n#");
  frame.put_text("scene", text); // from z = -0.25 to 0.25, its top at y = 0
  positions(frame)[4] = {1, -0.5, 0.25};
  put_masks(frame, "touch", {1, 1, 0, 1, 1, 0});
  const Scene scene = parse_scene(text, "scene");
  const Model model = model_of(scene, frame, connect(frame.vertices, triangles(frame)), Bending::none, false,
                               std::make_shared<const solid::Solids>(scene));
  Vector3 top = Vector3::Zero(), end = Vector3::Constant(9);
  for (const Hold& hold : model.holds)
    for (const std::uint32_t v : hold.vertices)
      if (v == 0)
        top = hold.velocity_at(0, positions(frame)[v]);
      else if (v == 4)
        end = hold.velocity_at(0, positions(frame)[v]);
  EXPECT_EQ(top, Vector3(0, 0, 3));
  EXPECT_LT(end.norm(), 1e-12);
}

// Where a [[hold]] prescribes an axis of what touches, the solid has the others.
TEST(SceneModel, AHoldCountsBeforeASolid) {
  Frame frame = two_squares();
  put_masks(frame, "touch", {1, 1, 1, 1, 1, 1});
  put_masks(frame, "hold", {4, 4, 4, 4, 4, 4});
  frame.put_text("scene", std::string(scene_text) + "[[hold]]\nregion = \"rim\"\naxes = \"z\"\n");
  StepStageOptions options;
  options.dt = 0.125;
  StepStage(options).step(frame);
  EXPECT_EQ(positions(static_cast<const Frame&>(frame))[0].z(), 0);
  EXPECT_EQ(velocities(static_cast<const Frame&>(frame))[0].z(), 0);
}

TEST(SceneModel, WhatIsInTheInletMovesAtTheInflowsVelocityUntilItEnds) {
  Frame frame = two_squares();
  put_masks(frame, "inlet", {3, 3, 3, 1, 1, 0});
  const std::string text = std::string(scene_text) +
                           "[inflow]\nregion = \"z_max\"\nvelocity = [[0, 0, 0, 0], [2, 0, -1, -4]]\nuntil = 1.5\n";
  frame.put_text("scene", text);
  const Scene scene = parse_scene(text, "test");
  EXPECT_EQ(next_event(scene, 0.5), 1.5);
  EXPECT_EQ(next_event(scene, 1.5), 2);
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const Model model = model_of(scene, frame, mesh, Bending::mid_edge, false);
  ASSERT_EQ(model.holds.size(), 1u);
  EXPECT_EQ(model.holds[0].vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(model.holds[0].clamped_edges.size(), 6u); // (0,1) (0,3) (0,4) (1,2) (1,4) (3,4)
  const std::vector<Vector3> before(positions(frame).begin(), positions(frame).end());
  StepStageOptions options;
  options.dt = 0.25;
  StepStage stage(options); // it ends at the kink of a hold, too
  stage.step(frame);
  const auto x = positions(static_cast<const Frame&>(frame));
  for (int v = 0; v < 5; ++v) // the velocity is t (0, -1/2, -2)
    EXPECT_LT((x[v] - before[v] - 0.5 * 0.25 * 0.25 * Vector3(0, -0.5, -2)).norm(), 1e-15) << v;
  EXPECT_LT((velocities(static_cast<const Frame&>(frame))[3] - 0.25 * Vector3(0, -0.5, -2)).norm(), 1e-12);
  frame.time = 1.5;
  EXPECT_TRUE(model_of(scene, frame, mesh, Bending::mid_edge, false).holds.empty());
}

TEST(SceneModel, WhatFansOutMovesEachVertexItsOwnWay) {
  Frame frame = two_squares();
  put_masks(frame, "inlet", {3, 3, 3, 0, 0, 0});
  const std::string text = std::string(scene_text) + "[inflow]\nregion = \"z_max\"\nvelocity = [0, -1, 0]\n"
                                                     "radial_velocity = [[0, 2], [3, 8]]\n";
  const Scene scene = parse_scene(text, "test");
  EXPECT_EQ(next_event(scene, 1), 3);
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const Model model = model_of(scene, frame, mesh, Bending::mid_edge, false);
  ASSERT_EQ(model.holds.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 x = positions(static_cast<const Frame&>(frame))[i], out = (i == 0 ? 0.0 : 1.0) * Vector3::UnitX();
    EXPECT_EQ(model.holds[i].vertices, std::vector{static_cast<std::uint32_t>(i)});
    EXPECT_EQ(model.holds[i].clamped_edges.size(), i == 0 ? 2u : 0u); // (0,1) (1,2)
    EXPECT_LT((model.holds[i].moved(0, 1)(x) - x - 3 * out - Vector3(0, -1, 0)).norm(), 1e-15);
    EXPECT_LT((model.holds[i].velocity_at(1, x) - 4 * out - Vector3(0, -1, 0)).norm(), 1e-15);
  }
}

TEST(SceneModel, AirDoesNotReachWhatTouchesOrIsUnderABath) {
  Frame frame = two_squares();
  put_masks(frame, "touch", {0, 1, 0, 0, 0, 0});
  const std::string text = std::string(scene_text) + "[environment]\ngravity = [0, 0, -9.81]\n"
                                                     "bath = {density = 2000, level = -0.5}\n"
                                                     "air = {density = 1.2, wind = [[0, 0, 0, 0], [2, 4, 0, 0]]}\n";
  const Scene scene = parse_scene(text, "test");
  EXPECT_EQ(next_event(scene, 1), 2);
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const Model model = model_of(scene, frame, mesh, Bending::mid_edge, false);
  ASSERT_TRUE(model.air);
  EXPECT_EQ(model.air->sheltered, (std::vector<char>{0, 1, 0, 1, 1, 1}));
  EXPECT_EQ(model.air->wind(1), Vector3(2, 0, 0));
}

TEST(SceneModel, AirRubsOnTheUpperFaceOfWhatFloats) {
  const Frame frame = two_squares();
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const auto air_over = [&](double level) {
    const std::string text = std::string(scene_text) + fmt::format("[environment]\ngravity = [0, 0, -9.81]\n"
                                                                   "bath = {{density = 2000, level = {}}}\n"
                                                                   "air = {{density = 1.2}}\n",
                                                                   level);
    return *model_of(parse_scene(text, "test"), frame, mesh, Bending::mid_edge, false).air;
  };
  const OuterFlow afloat = air_over(1e-9); // the first three lie in it, the others far below
  EXPECT_EQ(afloat.sheltered, (std::vector<char>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(afloat.one_face, (std::vector<char>{1, 1, 1, 0, 0, 0}));
  const OuterFlow above = air_over(-100);
  EXPECT_EQ(above.sheltered, std::vector<char>(6, 0));
  EXPECT_EQ(above.one_face, std::vector<char>(6, 0));
}

TEST(SceneModel, ABathHoldsBackWhatMovesInIt) {
  Frame frame = two_squares();
  put_masks(frame, "touch", {0, 1, 0, 0, 0, 0});
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const auto model = [&](double level) {
    return model_of(parse_scene(std::string(scene_text) + fmt::format("[environment]\ngravity = [0, 0, -9.81]\n"
                                                                      "bath = {{density = 2000, level = {}}}\n",
                                                                      level),
                                "test"),
                    frame, mesh, Bending::mid_edge, false);
  };
  EXPECT_FALSE(model(-100).bath_flow); // nothing is in it
  const Model under = model(100);
  EXPECT_EQ(under.bath_flow->density, 2000);
  EXPECT_EQ(under.bath_flow->sheltered, (std::vector<char>{0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(under.bath_flow->slides, (std::vector<char>{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(model(1e-9).bath_flow->slides, (std::vector<char>{1, 1, 1, 0, 0, 0})); // one is afloat
  const std::string creeping =
      "[environment]\ngravity = [0, 0, -9.81]\nbath = {density = 2, level = 1e-9}\n[model]\ninertia = false\n";
  const Model slow =
      model_of(parse_scene(std::string(scene_text) + creeping, "test"), frame, mesh, Bending::mid_edge, false);
  ASSERT_TRUE(slow.bath_flow);
  EXPECT_EQ(slow.bath_flow->sheltered, (std::vector<char>{1, 1, 1, 0, 0, 0}));
}

// What a vertex overshot counts where a solid holds it and no contact spring pulls at it. A step uses it up, and says
// that it started where the frame had the vertex.
TEST(SceneModel, WhatWasOvershotIsPutBackOnce) {
  Frame frame = two_squares();
  put_masks(frame, "touch", {0, 1, 0, 1, 0, 0});
  const Vector3 by(0, -0.125, 0);
  Array array = formats::make_standard_array("touch_overshoot", frame.vertices);
  for (Vector3& x : array.values<Vector3>())
    x = by;
  frame.put(std::move(array));
  const auto mesh = std::make_shared<const Connectivity>(connect(frame.vertices, triangles(frame)));
  const Scene scene = parse_scene(scene_text, "test");
  Model model = model_of(scene, frame, *mesh, Bending::mid_edge, false);
  State state = state_of(frame, mesh);
  make_up_for_overshoot(frame, model, state);
  const auto x = positions(static_cast<const Frame&>(frame));
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_EQ(state.to_make_up[v].way, v == 1 || v == 3 ? by : Vector3(Vector3::Zero())) << v;

  ContactSpring spring;
  spring.vertices = {3, 4, 5, 0};
  model.contacts.push_back(spring);
  state = state_of(frame, mesh);
  make_up_for_overshoot(frame, model, state);
  EXPECT_EQ(state.to_make_up[1].way, by);
  EXPECT_TRUE(state.to_make_up[3].way.isZero(0));

  const std::vector<Vector3> before(x.begin(), x.end());
  StepStageOptions options;
  options.dt = 0.125;
  StepStage(options).step(frame);
  EXPECT_EQ(frame.find("touch_overshoot"), nullptr);
  const auto start = frame.find("start_position")->values<Vector3>();
  EXPECT_TRUE(std::equal(before.begin(), before.end(), start.begin()));
  EXPECT_LT((positions(static_cast<const Frame&>(frame))[1] - (before[1] + Vector3(0, 0, 3 * 0.125))).norm(), 1e-15);
}

TEST(SceneModel, ContactSpringsPush) {
  Frame frame = two_squares();
  put_spring(frame);
  ASSERT_EQ(formats::find_value_error(frame), "");
  const Scene scene = parse_scene(scene_text, "test");
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const Model model = model_of(scene, frame, mesh, Bending::none, false);
  ASSERT_EQ(model.contacts.size(), 1u);
  const ContactSpring& spring = model.contacts[0];
  EXPECT_EQ(spring.vertices[0], 2u);
  EXPECT_EQ(spring.stiffness[0], 7);
  EXPECT_EQ(spring.stiffness[1], 5);
  EXPECT_FALSE(model.contacts_adhere);
  // Compressed by 0.25 m at rest: it pushes vertex 2 along +x, and all momentum stays zero.
  StepStageOptions options;
  options.dt = 0.01;
  StepStage stage(options);
  stage.step(frame);
  Vector3 momentum = Vector3::Zero();
  const auto v = velocities(static_cast<const Frame&>(frame));
  std::vector<double> mass(6, 0);
  for (const Corners& c : triangles(frame))
    for (const auto corner : c)
      mass[corner] += 1000 * 0.05 / 3;
  for (std::size_t i = 0; i < v.size(); ++i)
    momentum += mass[i] * v[i];
  EXPECT_GT(v[2].x(), 0);
  EXPECT_LT(v[0].x(), 0);
  // Round-off of positions of 2 m, seen as velocities over the step of 0.01 s.
  const double total = 1000 * 4 * 0.05, round_off = std::numeric_limits<double>::epsilon() * 2 / 0.01;
  EXPECT_LT(momentum.norm(), total * round_off);
  EXPECT_GT(mass[2] * v[2].norm(), 1e6 * total * round_off);
}

TEST(StepStage, LandsOnOutputTimesAndEvents) {
  Frame frame = two_squares();
  put_masks(frame, "hold", {1, 0, 2, 1, 0, 2});
  put_number(frame, "next_output_time", 0.3);
  StepStageOptions options;
  options.dt = 0.1;
  StepStage stage(options);
  std::vector<double> times;
  while (frame.time < 0.3) {
    stage.step(frame);
    times.push_back(frame.time);
  }
  ASSERT_EQ(times.size(), 4u); // three equal steps to the kink at 0.25, one to 0.3
  EXPECT_NEAR(times[0], 0.25 / 3, 1e-15);
  EXPECT_EQ(times[2], 0.25);
  EXPECT_EQ(times[3], 0.3);
}

TEST(StepStage, RefusesWhatItCannotStep) {
  const auto message = [](Frame frame, StepStageOptions options) {
    StepStage stage(options);
    try {
      stage.step(frame);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  StepStageOptions fixed;
  fixed.dt = 0.1;
  Frame frame = two_squares();
  frame.erase("scene");
  EXPECT_NE(message(frame, fixed).find("make it with sheet-init"), std::string::npos);
  Frame endless = two_squares();
  endless.time = 1; // behind all events
  EXPECT_NE(message(endless, {}).find("let sheet-loop stamp it"), std::string::npos);
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {5, 5, 5}};
  Frame lonely = make_frame(x, std::vector<Corners>{{0, 1, 2}}, std::vector<double>{0.1});
  lonely.put_text("scene", scene_text);
  EXPECT_NE(message(lonely, fixed).find("vertex 3 belongs to no triangle"), std::string::npos);
  fixed.tolerance = 1e-3;
  EXPECT_THROW(StepStage{fixed}, Error);
  fixed.tolerance.reset();
  fixed.dt = -1;
  EXPECT_THROW(StepStage{fixed}, Error);
}

std::string refusal(Frame frame) {
  StepStageOptions options;
  options.dt = 0.1;
  try {
    StepStage(options).step(frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(StepStage, RefusesTrianglesOfNoLiquidOfTheScene) {
  Frame frame = two_squares();
  frame.put_text("scene", R"(
    [[sheet]]
    shape = "disk"
    radius = 1
    edge_length = 0.5
    thickness = 0.1
    [[sheet]]
    shape = "disk"
    radius = 1
    center = [0, 0, 1]
    edge_length = 0.5
    thickness = 0.1
    [sheet.material]
    viscosity = 20
    density = 2000
    [material]
    viscosity = 10
    density = 1000
  )");
  EXPECT_NE(refusal(frame).find("does not say which triangle is of which"), std::string::npos);
  frame.put(formats::make_standard_array("liquid", frame.triangles));
  EXPECT_EQ(refusal(frame), "no error");
  frame.find("liquid")->values<std::uint32_t>()[2] = 2;
  EXPECT_NE(refusal(frame).find("triangle 2 is of liquid 2"), std::string::npos);
}

// The greatest number that there is, too: rows of gas were made up to that.
TEST(StepStage, RefusesAnEnclosureThatThereCannotBe) {
  Frame frame = two_squares();
  frame.put_text("scene", R"(
    [sheet]
    shape = "sphere"
    radius = 1
    edge_length = 0.5
    thickness = 0.1
    [material]
    viscosity = 10
    density = 1000
    [environment]
    pressure = {law = "gas", amount = 1, ambient = 1000}
  )");
  put_enclosures(std::vector<std::uint32_t>{1, 1, 0, 1}, frame);
  EXPECT_EQ(refusal(frame), "no error");
  put_enclosures(std::vector<std::uint32_t>{1, 1, 0, std::numeric_limits<std::uint32_t>::max()}, frame);
  EXPECT_NE(refusal(frame).find("there is no enclosure 4294967295"), std::string::npos);
}

// Memory that has held something else is what the next arrays are made of.
void leave_nans_in_memory(std::size_t bytes) {
  std::vector<formats::Bytes> blocks(100);
  for (formats::Bytes& block : blocks) {
    block.resize(bytes);
    std::fill_n(block.data(), bytes, std::byte{0xff});
  }
}

TEST(Reactions, OfWhatIsNotHeldAreZero) {
  for (const bool with_holds : {true, false}) {
    Frame frame = two_squares();
    frame.erase("hold");
    if (with_holds)
      sheet::put_masks(frame, "hold")[1] = 1;
    HoldingForces forces;
    forces.all.assign(frame.vertices, Vector3(1, 2, 3));
    leave_nans_in_memory(frame.vertices * sizeof(Vector3));
    put_reactions(forces, true, 0, frame);
    const auto held = frame.find("hold_force")->values<Vector3>();
    for (std::size_t v = 0; v < held.size(); ++v)
      EXPECT_EQ(held[v], with_holds && v == 1 ? Vector3(1, 2, 3) : Vector3(0, 0, 0)) << v;
  }
}

// Of two solids the first touches three vertices, and the second squeezes or pushes something.
TEST(Reactions, OfSolidsAreSumsOfWhatTouchesThemAndOfMore) {
  Frame frame = two_squares();
  HoldingForces forces;
  forces.all.assign(frame.vertices, Vector3(1, 2, 3));
  forces.more = {{1, Vector3(0, 0, -5)}, {0, Vector3(0, 0, 10)}};
  put_touched_solids(frame, std::vector<std::int32_t>{0, 0, 0, no_solid, no_solid, no_solid}, 2);
  put_reactions(forces, true, 2, frame);
  const auto of_solid = frame.find("solid_force")->values<Vector3>();
  ASSERT_EQ(of_solid.size(), 2u);
  EXPECT_EQ(of_solid[0], Vector3(3, 6, 19));
  EXPECT_EQ(of_solid[1], Vector3(0, 0, -5));
  put_reactions(forces, false, 2, frame);
  EXPECT_EQ(frame.find("solid_force"), nullptr);
}

TEST(Arrays, StartAsZeros) {
  leave_nans_in_memory(800);
  const Array array = make_array("anything", Place::vertex, Type::float64, 1, "1", Transfer::copy, 100);
  for (const double x : array.values<double>())
    EXPECT_EQ(x, 0);
}

} // namespace
} // namespace sheet
