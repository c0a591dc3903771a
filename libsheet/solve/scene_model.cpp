// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/scene_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/base/error.h"
#include "libsheet/base/overloaded.h"
#include "libsheet/energy/overshoot.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/longest_edges.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/heat/surroundings.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/free_faces.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/scene/inner_faces.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/scene/rolls.h"
#include "libsheet/sheet/account.h"
#include "libsheet/sheet/directors.h"
#include "libsheet/sheet/overshoot.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/corners.h"
#include "libsheet/solve/bath_reach.h"
#include "libsheet/solve/held_rims.h"
#include "libsheet/solve/pressure_laws.h"

namespace sheet {

namespace {

using formats::Array;
using formats::Frame;

// By a scene's motion, and by that of a belt's surface [m/s].
void move(Hold& hold, const scene::Motion& motion, const Vector3& surface_velocity = Vector3::Zero()) {
  hold.motion = [=](double from, double to) {
    const Eigen::Isometry3d moved = scene::motion_between(motion, from, to);
    return RigidMotion{moved.linear(), moved.translation() + (to - from) * surface_velocity};
  };
  hold.velocity = [=](double t, const Vector3& x) -> Vector3 {
    return scene::velocity_at(motion, t, x) + surface_velocity;
  };
}

// Vertices whose mask has bit i.
std::vector<std::uint32_t> with_bit(std::span<const std::uint64_t> masks, std::size_t i) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < masks.size(); ++v)
    if ((masks[v] >> i & 1) != 0)
      vertices.push_back(v);
  return vertices;
}

void add_holds(const Scene& scene, const Frame& frame, const Connectivity& mesh, Model& model) {
  const auto masks = sheet::masks(frame, "hold");
  for (std::size_t i = 0; i < scene.holds.size(); ++i) {
    const scene::Hold& table = scene.holds[i];
    if (!in_force(table, frame.time))
      continue;
    Hold hold;
    hold.vertices = with_bit(masks, i);
    if (hold.vertices.empty())
      continue;
    hold.axes = table.axes;
    if (table.clamped)
      for (std::uint32_t e = 0; e < mesh.edges.size(); ++e)
        if (((masks[mesh.edges[e][0]] & masks[mesh.edges[e][1]]) >> i & 1) != 0)
          hold.clamped_edges.push_back(e);
    if (!std::holds_alternative<scene::Fixed>(table.motion))
      move(hold, table.motion);
    model.holds.push_back(std::move(hold));
  }
}

// What sticks to a solid moves with it, and with its belt; where its belt does not run along the surface (beyond an
// edge of it), with the belt's part along the surface: a hold for each such vertex.
void add_stuck(const solid::Solids* solids, std::size_t i, const scene::Solid& solid,
               std::vector<std::uint32_t> vertices, const Frame& frame, Model& model) {
  std::vector<std::uint32_t> others;
  if (solids != nullptr && !solid.surface_velocity.isZero(0))
    std::erase_if(vertices, [&](std::uint32_t v) {
      const Vector3 normal = solids->at(i, positions(frame)[v], frame.time).normal;
      const bool beyond = solids->belt_velocity(i, normal) != solid.surface_velocity;
      if (beyond)
        others.push_back(v);
      return beyond;
    });
  const auto add = [&](std::vector<std::uint32_t> held, const Vector3& belt) {
    Hold hold;
    move(hold, solid.motion, belt);
    hold.vertices = std::move(held);
    if (!hold.vertices.empty())
      model.holds.push_back(std::move(hold));
  };
  add(std::move(vertices), solid.surface_velocity);
  for (const std::uint32_t v : others)
    add({v}, solids->belt_velocity(i, solids->at(i, positions(frame)[v], frame.time).normal));
}

// Along which liquid flows: motion and belt as for what sticks.
Wall wall_of(const std::shared_ptr<const solid::Solids>& solids, std::size_t i, std::vector<std::uint32_t> touching,
             const Hold& moved) {
  const scene::Solid& solid = solids->scene(i);
  Wall wall;
  wall.vertices = std::move(touching);
  wall.solid = static_cast<std::uint32_t>(i);
  wall.slip_length = solid.contact == SolidContact::slip ? free_slip : solid.slip_length;
  wall.wetting = solid.contact_angle ? 1 - std::cos(*solid.contact_angle) : 2;
  wall.hollow = std::holds_alternative<scene::SolidMesh>(solid.shape);
  wall.nearest = [solids, i](double t, const Vector3& x) {
    const solid::SolidPoint point = solids->at(i, x, t);
    return WallPoint{point.distance, point.normal};
  };
  wall.beyond = [solids, i](double t, const Vector3& x, double reach) {
    return solids->shape(i).distance(solids->pose(i, t).inverse() * x, reach) >= reach;
  };
  wall.motion = moved.motion;
  wall.velocity = moved.velocity;
  return wall;
}

// The solids that nothing flows along in this step: they may face those that something does.
void add_facing(const Scene& scene, const std::shared_ptr<const solid::Solids>& solids, std::span<const char> listed,
                Model& model) {
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (listed[i] == 0) {
      Hold hold;
      move(hold, scene.solids[i].motion, scene.solids[i].surface_velocity);
      model.walls.push_back(wall_of(solids, i, {}, hold));
    }
}

// Vertices around which the sheet is thinner than a thousandth of its mean thickness. A wall's drag on so thin a film
// lets nothing move along it, and what little the film is must not ask for iterations.
std::vector<char> thin_films(const Frame& frame) {
  constexpr double thin = 1e-3;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto volume = volumes(frame);
  std::vector<double> volumes_at(x.size(), 0), areas_at(volumes_at);
  double all = 0, whole = 0;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const double area = TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
    all += volume[t];
    whole += area;
    for (const auto v : corners[t]) {
      volumes_at[v] += volume[t];
      areas_at[v] += area;
    }
  }
  std::vector<char> films(x.size());
  for (std::size_t v = 0; v < films.size(); ++v)
    films[v] = volumes_at[v] * whole < thin * all * areas_at[v];
  return films;
}

// Of the triangles around each vertex [m].
std::vector<double> thickness_at(const Frame& frame) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  return thickness_around(x.size(), corners, volumes(frame), [&](std::uint32_t t) {
    return TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
  });
}

// Of the vertices that stick to solid i, takes away those that lie between it and another solid which leaves them no
// room, and gives them: they flow out from there, without slip.
std::vector<std::uint32_t> take_squeezed(const solid::Solids& solids, std::size_t i, const Frame& frame,
                                         std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> squeezed;
  const auto x = positions(frame);
  const std::vector<double> thickness = thickness_at(frame), edges = longest_edges(x, triangles(frame));
  std::erase_if(vertices, [&](std::uint32_t v) {
    const bool no_room = solids.squeezed(i, x[v], frame.time, thickness[v], edges[v]);
    if (no_room)
      squeezed.push_back(v);
    return no_room;
  });
  return squeezed;
}

// Of each vertex, the solid in whose corner with the one that it touches it turns (corners.h), or no_solid.
std::vector<std::int32_t> turning(const Scene& scene, const Frame& frame, const solid::Solids* solids,
                                  std::vector<std::int32_t> touched) {
  if (solids == nullptr || !flows_on_solids(scene) || !scene.environment.gravity)
    return std::vector<std::int32_t>(touched.size(), no_solid);
  for (std::int32_t& solid : touched)
    if (solid != no_solid && scene.solids[static_cast<std::size_t>(solid)].contact == SolidContact::stick)
      solid = no_solid;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const std::vector<double> thickness = thickness_at(frame), edges = longest_edges(x, corners);
  return solid::turned_to(*solids, {x, corners, thickness, edges, touched, frame.time, *scene.environment.gravity});
}

// What touches a solid moves with its surface, without slip [Batty et al. 2012, section 3.5], or flows along it. Gives
// whether anything touches.
bool add_touching(const Scene& scene, const Frame& frame, const Connectivity& mesh,
                  const std::shared_ptr<const solid::Solids>& solids, Model& model) {
  std::vector<std::vector<std::uint32_t>> touching(scene.solids.size());
  const auto touched = touched_solids(frame, scene.solids.size());
  for (std::uint32_t v = 0; v < touched.size(); ++v)
    if (touched[v] != no_solid)
      touching[static_cast<std::size_t>(touched[v])].push_back(v);
  const Array* forces = frame.find("touch_force");
  const std::vector<char> films = flows_on_solids(scene) ? thin_films(frame) : std::vector<char>{};
  const std::vector<std::int32_t> turned_to = turning(scene, frame, solids.get(), touched);
  std::vector<char> listed(touching.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (touching[i].empty())
      continue;
    any = true;
    const scene::Solid& solid = scene.solids[i];
    Hold hold;
    move(hold, solid.motion, solid.surface_velocity);
    if (solid.contact == SolidContact::stick) {
      std::vector<std::uint32_t> squeezed;
      if (solids_squeeze(scene))
        squeezed = take_squeezed(*solids, i, frame, touching[i]);
      add_stuck(solids.get(), i, solid, std::move(touching[i]), frame, model);
      if (squeezed.empty())
        continue;
      touching[i] = std::move(squeezed);
    }
    hold.of_wall = true;
    HeldRims rims;
    if (solid.contact == SolidContact::flow && !solid.receding)
      rims = held_rims(scene, frame, mesh, touching[i], turned_to);
    hold.vertices = std::move(rims.wholly);
    if (solid.contact == SolidContact::flow)
      std::ranges::copy_if(touching[i], std::back_inserter(hold.vertices), [&](std::uint32_t v) { return films[v]; });
    model.walls.push_back(wall_of(solids, i, std::move(touching[i]), hold));
    Wall& wall = model.walls.back();
    wall.rims = std::move(rims.out);
    if (forces != nullptr)
      for (const std::uint32_t v : wall.vertices)
        wall.forces.push_back(forces->values<Vector3>()[v]);
    for (const std::uint32_t v : wall.vertices)
      wall.turned_to.push_back(turned_to[v]);
    listed[i] = 1;
    if (!hold.vertices.empty())
      model.holds.push_back(std::move(hold));
  }
  if (!model.walls.empty())
    add_facing(scene, solids, listed, model);
  return any;
}

// Whether what flows may touch two solids.
bool flows_in_corners(const Scene& scene) { return scene.solids.size() > 1 && flows_on_solids(scene); }

// What is in an inlet that fans out moves each vertex its own way, and does not turn: a hold for each.
void add_fan(const scene::InletVelocity& velocity, const Frame& frame, const Hold& inlet, Model& model) {
  const auto starts = positions(frame);
  Hold hold;
  hold.clamped_edges = inlet.clamped_edges;
  for (const std::uint32_t v : inlet.vertices) {
    hold.vertices = {v};
    hold.motion = [velocity, x = starts[v]](double from, double to) {
      return RigidMotion{.shift = velocity.way(from, to, x)};
    };
    hold.velocity = [velocity, x = starts[v]](double t, const Vector3&) { return velocity.at(t, x); };
    model.holds.push_back(hold);
    hold.clamped_edges.clear();
  }
}

// What is in an inlet moves as liquid flows in there, and does not turn.
void add_inlets(const Scene& scene, const Frame& frame, const Connectivity& mesh, Model& model) {
  const auto masks = sheet::masks(frame, "inlet");
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    if (!in_force(scene.inflows[i], frame.time))
      continue;
    Hold hold;
    for (std::uint32_t v = 0; v < masks.size(); ++v)
      if ((of_inlet(masks[v], i) & in_inlet) != 0)
        hold.vertices.push_back(v);
    if (hold.vertices.empty())
      continue;
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e)
      if ((of_inlet(masks[mesh.edges[e][0]] & masks[mesh.edges[e][1]], i) & in_inlet) != 0)
        hold.clamped_edges.push_back(e);
    const scene::InletVelocity velocity = scene::inlet_velocity(frame, scene, i);
    if (velocity.fans_out()) {
      add_fan(velocity, frame, hold, model);
      continue;
    }
    move(hold, scene::Translating{velocity.common});
    model.holds.push_back(std::move(hold));
  }
}

// As they are at the start of the step, so that a run that is gone on with has the same.
ModelFaces faces_of(const Scene& scene, const Frame& frame, const Connectivity& mesh) {
  // Of free faces what is less adds 5e-5 to their area. What lies on something levels for as long as a run goes on.
  constexpr LeastSlope least_slope{.free = 0.02, .on_something = 1e-4};
  FreeFaces faces = scene::free_faces(scene, frame, mesh);
  std::vector<SlopedEdge> slopes = sloped_edges(mesh, positions(frame), volumes(frame), faces, least_slope);
  return {std::move(faces.rims), std::move(slopes)};
}

heat::Surroundings surroundings(const scene::HeatedFace& face, double t, const Vector3& x) {
  return {value_at(face.transfer, t, x), value_at(face.ambient, t, x), face.emissivity, value_at(face.radiant, t, x)};
}

void set_surroundings(const scene::HeatedFace& face, heat::Face which, HeatModel& model) {
  if (is_constant(face.transfer) && is_constant(face.ambient) && is_constant(face.radiant))
    model.surroundings[which] = surroundings(face, 0, Vector3::Zero());
  else
    model.local_surroundings[which] = [face](double t, const Vector3& x) { return surroundings(face, t, x); };
}

// With the solids that the sheet touches.
HeatModel heat_of(const Scene& scene, const Frame& frame, const std::shared_ptr<const solid::Solids>& solids) {
  HeatModel model;
  model.capacity = scene.material.density * scene.heat->specific_heat;
  if (const FrameLiquids liquids(scene, frame); liquids.several())
    for (std::size_t t = 0; t < frame.triangles; ++t)
      model.capacities.push_back(liquids.density(t) * scene.heat->specific_heat);
  model.conductivity = scene.heat->conductivity;
  const bool alike = scene.heat->upper == scene.heat->lower && scene.solids.empty();
  if (scene.heat->profile)
    model.profile = alike ? heat::even_modes(*scene.heat->profile) : heat::all_modes(*scene.heat->profile);
  else if (model.conductivity > 0)
    model.profile = heat::parabola();
  set_surroundings(scene.heat->upper, heat::upper, model);
  set_surroundings(scene.heat->lower, heat::lower, model);
  model.viscous = scene.heat->viscous_heating;
  const auto touched = touched_solids(frame, scene.solids.size());
  for (std::size_t i = 0; i < scene.solids.size(); ++i) {
    WarmWall wall;
    for (std::uint32_t v = 0; v < touched.size(); ++v)
      if (touched[v] == static_cast<std::int32_t>(i))
        wall.vertices.push_back(v);
    wall.conductance = scene.solids[i].contact_conductance;
    if (const auto& temperature = scene.solids[i].temperature)
      wall.temperature = [timed = *temperature](double t) { return scene::value_at(timed, t); };
    wall.normal = [solids, i](double t, const Vector3& x) { return solids->at(i, x, t).normal; };
    model.walls.push_back(std::move(wall));
  }
  return model;
}

OuterFlow air_of(const scene::Air& air) {
  return {.density = air.density,
          .drag = air.drag_coefficient,
          .friction = air.friction_coefficient,
          .wind = [wind = air.wind](double t) { return scene::value_at(wind, t); }};
}

// Vertices that touch a solid or another layer, which no flow around the sheet reaches.
std::vector<char> covered(const Scene& scene, const Frame& frame, const Model& model) {
  std::vector<char> covered(frame.vertices, 0);
  const auto touched = touched_solids(frame, scene.solids.size());
  for (std::size_t v = 0; v < touched.size(); ++v)
    covered[v] = touched[v] != no_solid ? 1 : 0;
  for (const ContactSpring& spring : model.contacts)
    for (const std::uint32_t v : spring.vertices)
      covered[v] = 1;
  return covered;
}

// What air does not reach: it is covered, or the bath stands above it. What floats, up to its thickness under the
// level, it reaches on the upper face alone.
void put_shelter_from_air(const Scene& scene, const Frame& frame, const Connectivity& mesh, Model& model) {
  OuterFlow& air = *model.air;
  air.sheltered = covered(scene, frame, model);
  if (!scene.environment.bath)
    return;
  const auto x = positions(frame);
  const Vector3 up = -scene.environment.gravity->normalized();
  const std::vector<double> h = thickness_around(x.size(), mesh.triangles, volumes(frame), [&](std::uint32_t t) {
    const Corners& c = mesh.triangles[t];
    return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  });
  air.one_face.assign(x.size(), 0);
  for (std::size_t v = 0; v < x.size(); ++v) {
    const double height = up.dot(x[v]) - scene.environment.bath->level;
    if (height < -h[v])
      air.sheltered[v] = 1;
    else if (height < 0)
      air.one_face[v] = 1;
  }
}

// What a bath does not resist, as it is not there, or something else is in between.
std::vector<char> sheltered_from_bath(const Scene& scene, const Frame& frame, const Model& model) {
  std::vector<char> sheltered = covered(scene, frame, model);
  const BathSurface surface(model.gravity, model.bath->level, model.bath_reach);
  const auto x = positions(frame);
  for (std::uint32_t v = 0; v < x.size(); ++v)
    if (!surface.wets(v, x[v]))
      sheltered[v] = 1;
  return sheltered;
}

// Whom the bath resists; no flow if that is none. What is not wet on both faces has no friction: `drag` is what holds
// it back along the bath. Without inertia such does not move across the bath for long, while what has gone under would
// glide without end.
void put_bath_flow(const Scene& scene, const Frame& frame, Model& model) {
  OuterFlow& flow = *model.bath_flow;
  flow.sheltered = sheltered_from_bath(scene, frame, model);
  flow.slides.assign(frame.vertices, 1);
  for (std::size_t v = 0; v < model.bath_reach.size(); ++v)
    flow.slides[v] = model.bath_reach[v] == BathReach::around ? 0 : 1;
  for (std::size_t v = 0; v < flow.slides.size() && !model.has_inertia(); ++v)
    flow.sheltered[v] = flow.sheltered[v] != 0 || flow.slides[v] != 0 ? 1 : 0;
  if (std::ranges::all_of(flow.sheltered, [](char s) { return s != 0; }))
    model.bath_flow.reset();
}

// Nothing comes over a rim that is held, or that liquid enters by, nor over what the bath clings to.
std::vector<BathReach> reach_of_bath(const Frame& frame, const Connectivity& mesh, const Model& model) {
  std::vector<char> shut(frame.vertices, model.bath->clings ? 1 : 0);
  for (const Hold& hold : model.holds)
    for (const std::uint32_t v : hold.vertices)
      shut[v] = 1;
  return bath_reach({mesh, positions(frame), volumes(frame), model.contacts, std::move(shut)},
                    -model.gravity.normalized(), model.bath->level);
}

// What a model has of a scene in any frame.
Model numbers_of(const Scene& scene, Bending bending, bool arcs) {
  Model model;
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  model.liquid = liquids[0];
  model.other_liquids.assign(liquids.begin() + 1, liquids.end());
  model.inertia = scene.model.inertia;
  model.bending = scene.model.bending ? bending : Bending::none;
  model.arcs = arcs;
  if (scene.environment.gravity)
    model.gravity = *scene.environment.gravity;
  model.bath = scene.environment.bath;
  if (scene.environment.air)
    model.air = air_of(*scene.environment.air);
  if (model.bath && model.has_weight() && !model.bath->clings)
    model.bath_flow = OuterFlow{.name = "bath resistance",
                                .density = model.bath->density,
                                .drag = scene::Air().drag_coefficient,
                                .friction = scene::Air().friction_coefficient};
  model.contacts_adhere = scene.contact && contacts_adhere(scene);
  model.contacts_flow = layers_flow(scene);
  return model;
}

// Of each solid all that it does to the sheet.
void put_solid_forces(const HoldingForces& reactions, std::span<const std::int32_t> touched, std::size_t solids,
                      Frame& frame) {
  if (solids == 0)
    return;
  Array array = formats::make_standard_array("solid_force", solids);
  const auto force = array.values<Vector3>();
  for (std::size_t v = 0; v < touched.size(); ++v)
    if (touched[v] != no_solid)
      force[static_cast<std::size_t>(touched[v])] += reactions.all[v];
  for (const auto& [solid, more] : reactions.more)
    force[solid] += more;
  frame.put(std::move(array));
}

} // namespace

State state_of(const Frame& frame, std::shared_ptr<const Connectivity> mesh) {
  State state;
  state.mesh = std::move(mesh);
  const auto x = positions(frame), v = velocities(frame);
  state.positions.assign(x.begin(), x.end());
  if (v.empty())
    state.velocities.assign(x.size(), Vector3::Zero());
  else
    state.velocities.assign(v.begin(), v.end());
  const auto volume = volumes(frame);
  state.volumes.assign(volume.begin(), volume.end());
  if (const Array* angles = frame.find("director_angle")) {
    const auto angle = angles->values<double>();
    state.director_angles.assign(angle.begin(), angle.end());
  }
  if (const Array* liquids = frame.find("liquid")) {
    const auto numbers = liquids->values<std::uint32_t>();
    state.liquids.assign(numbers.begin(), numbers.end());
  }
  const auto take = [&](std::string_view name, std::vector<double>& to) {
    if (const Array* array = frame.find(name)) {
      const auto values = array->values<double>();
      to.assign(values.begin(), values.end());
    }
  };
  take("temperature", state.temperatures);
  take("temperature_rate", state.temperature_rates);
  take("temperature_mode", state.temperature_modes);
  take("temperature_mode_rate", state.temperature_mode_rates);
  state.gas = gas_of(frame);
  state.time = frame.time;
  return state;
}

void make_up_for_overshoot(const Frame& frame, const Model& model, State& state) {
  const std::vector<Overshoot> all = overshoots(frame);
  if (all.empty())
    return;
  std::vector<Overshoot> held(frame.vertices);
  const auto touched = touched_solids(frame);
  for (const Hold& hold : model.holds)
    if (hold.axes == all_axes)
      for (const std::uint32_t v : hold.vertices)
        if (touched[v] != no_solid)
          held[v] = all[v];
  for (const ContactSpring& spring : model.contacts)
    for (const std::uint32_t v : spring.vertices)
      held[v] = {};
  make_up_for(state, std::move(held));
}

void put_state(const State& state, Frame& frame) {
  Array start = formats::make_standard_array("start_position", frame.vertices);
  std::copy_n(positions(frame).begin(), frame.vertices, start.values<Vector3>().begin());
  frame.put(std::move(start));
  put_number(frame, "start_time", frame.time);
  std::copy(state.positions.begin(), state.positions.end(), positions(frame).begin());
  std::copy(state.velocities.begin(), state.velocities.end(), velocities(frame).begin());
  std::copy(state.volumes.begin(), state.volumes.end(), volumes(frame).begin());
  const auto put_of_triangles = [&](std::string_view name, const std::vector<double>& values) {
    if (values.empty())
      return;
    Array array = formats::make_standard_array(name, frame.triangles,
                                               static_cast<std::uint32_t>(values.size() / frame.triangles));
    std::ranges::copy(values, array.values<double>().begin());
    frame.put(std::move(array));
  };
  put_of_triangles("temperature", state.temperatures);
  put_of_triangles("temperature_rate", state.temperature_rates);
  put_of_triangles("temperature_mode", state.temperature_modes);
  put_of_triangles("temperature_mode_rate", state.temperature_mode_rates);
  put_director_angles(state.director_angles, frame);
  put_gas(state.gas, frame);
  frame.time = state.time;
  put_overshoots(state.to_make_up, frame);
  ++frame.step;
}

void put_heat_moved(const State& state, Frame& frame) {
  if (state.temperatures.empty())
    return;
  const HeatMoved& moved = state.heat_moved;
  const std::array amounts{moved.generated, moved.upper, moved.lower, moved.solids};
  add_to_account(frame, "heat.moved", "J", amounts);
}

void put_reactions(const HoldingForces& reactions, bool of_holds, std::size_t solids, Frame& frame) {
  for (const char* name : {"touch_force", "touch_load", "hold_force", "solid_force"})
    frame.erase(name);
  if (reactions.all.empty())
    return;
  const auto touched = touched_solids(frame, solids);
  if (of_holds) {
    Array held = formats::make_standard_array("hold_force", frame.vertices);
    const auto holds = sheet::holds(frame);
    for (std::size_t v = 0; v < holds.size(); ++v)
      if (holds[v] != 0)
        held.values<Vector3>()[v] = reactions.all[v];
    frame.put(std::move(held));
    put_solid_forces(reactions, touched, solids, frame);
  }
  const auto put = [&](const char* name, const std::vector<Vector3>& forces) {
    Array array = formats::make_standard_array(name, frame.vertices);
    for (std::size_t v = 0; v < forces.size(); ++v)
      array.values<Vector3>()[v] = touched[v] != no_solid ? forces[v] : Vector3(Vector3::Zero());
    frame.put(std::move(array));
  };
  put("touch_force", reactions.all);
  if (!reactions.external.empty())
    put("touch_load", reactions.external);
}

Model model_of(const Scene& scene, const Frame& frame, const Connectivity& mesh, Bending bending, bool arcs,
               const std::shared_ptr<const solid::Solids>& solids) {
  Model model = numbers_of(scene, bending, arcs);
  if (scene.environment.pressure)
    model.pressures = pressure_laws(scene, frame, mesh, solids.get());
  const bool touching = add_touching(scene, frame, mesh, solids,
                                     model); // first: along the axes that a [[hold]] prescribes that one counts
  add_holds(scene, frame, mesh, model);
  add_inlets(scene, frame, mesh, model);
  if (scene.model.faces)
    model.faces = faces_of(scene, frame, mesh);
  if (scene.heat)
    model.heat = heat_of(scene, frame, solids);
  model.contacts = read_springs(frame); // as sheet-collide has set them up
  if (model.greatest_tension() > 0)
    model.inner_faces = inner_faces(scene, frame);
  if (model.bath && model.gravity.squaredNorm() > 0)
    model.bath_reach = reach_of_bath(frame, mesh, model);
  if (model.bath_flow)
    put_bath_flow(scene, frame, model);
  if (model.air)
    put_shelter_from_air(scene, frame, mesh, model);
  // Between two steps what has come to a roll is not held by it: there the end of a step is no better than its middle.
  if (scene.model.forces && !scene::has_rolls(scene))
    model.reactions = Reactions::at_end;
  else if (scene::has_rolls(scene) ||
           (touching && ((scene.contact && scene.contact->adhesion) || holds_rims(scene) || flows_in_corners(scene))))
    model.reactions = Reactions::of_stage;
  model.external_reactions = touching && scene.contact && scene.contact->adhesion && flows_on_solids(scene);
  return model;
}

Model model_of(const Scene& scene) {
  Model model = numbers_of(scene, Bending::mid_edge, true);
  if (scene.environment.pressure)
    model.pressures.push_back(pressure_law(scene.environment));
  for (const scene::Solid& solid : scene.solids)
    if (solid.contact != SolidContact::stick) {
      Wall wall;
      wall.slip_length = solid.contact == SolidContact::slip ? free_slip : solid.slip_length;
      model.walls.push_back(std::move(wall));
    }
  if (scene.model.faces)
    model.faces.emplace();
  model.may_squeeze = solids_squeeze(scene) || flows_in_corners(scene);
  if (scene.contact && scene.contact->self)
    model.contacts.resize(1);
  return model;
}

double next_event(const Scene& scene, double t) {
  double next = std::numeric_limits<double>::infinity();
  const auto consider = [&](double event) {
    if (event > t)
      next = std::min(next, event);
  };
  const auto consider_motion = [&](const scene::Motion& motion) {
    for (const double event : scene::events(motion))
      consider(event);
  };
  for (const scene::Hold& hold : scene.holds) {
    consider_motion(hold.motion);
    if (hold.until)
      consider(*hold.until);
  }
  const auto consider_rows = [&](const auto* timed) {
    if (timed != nullptr && timed->entries.size() > 1)
      for (const auto& entry : timed->entries)
        consider(entry.time);
  };
  const auto pointer_to = [](const auto& optional) { return optional ? &*optional : nullptr; };
  for (const scene::Solid& solid : scene.solids) {
    consider_motion(solid.motion);
    consider_rows(pointer_to(solid.temperature));
  }
  for (const scene::Inflow& inflow : scene.inflows) {
    consider_rows(pointer_to(inflow.temperature));
    consider_motion(scene::Translating{inflow.velocity});
    consider_rows(&inflow.radial_velocity);
    if (inflow.until)
      consider(*inflow.until);
  }
  for (const scene::SheetTable& sheet : scene.sheets)
    if (sheet.enters)
      consider(*sheet.enters);
  if (scene.environment.air)
    consider_rows(&scene.environment.air->wind);
  if (scene.heat)
    for (const scene::HeatedFace* face : {&scene.heat->upper, &scene.heat->lower})
      for (const scene::Varying* varying : {&face->ambient, &face->transfer, &face->radiant})
        consider_rows(std::get_if<scene::Timed<double>>(&varying->over));
  return next;
}

} // namespace sheet
