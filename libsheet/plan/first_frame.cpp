// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/first_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/collide/collide_stage.h"
#include "libsheet/energy/gas.h"
#include "libsheet/flow/emit.h"
#include "libsheet/flow/inlet.h"
#include "libsheet/flow/inlet_checks.h"
#include "libsheet/flow/tear.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/box.h"
#include "libsheet/geometry/capped_volume.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/plan/mesh_warnings.h"
#include "libsheet/remesh/mesh.h"
#include "libsheet/scene/level_planes.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/scene/write.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"
#include "libsheet/solve/gas_holes.h"
#include "libsheet/solve/step_stage.h"

namespace sheet {

namespace {

using formats::Frame;

double area_of(const Frame& frame) {
  const auto x = positions(frame);
  double area = 0;
  for (const Corners& c : triangles(frame))
    area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  return area;
}

constexpr double place_rounding = 1e-9; // of its norm
constexpr double shortest_step = 1e-9;  // [s]

// A wrong scale that would explain why the sheet and that solid are in each other's way; "" if none would.
std::string scale_in_doubt(const Scene& scene, const solid::Solids& solids, std::size_t i, const Frame& frame) {
  Box box;
  for (const Vector3& x : positions(frame))
    box.add(x);
  std::string hint;
  if (std::ranges::any_of(scene.sheets, [](const scene::SheetTable& sheet) {
        return std::holds_alternative<scene::SheetMesh>(sheet.shape);
      }))
    hint = hint_of_scale("the sheet", box.diagonal());
  if (hint.empty() && std::holds_alternative<scene::SolidMesh>(scene.solids[i].shape))
    hint = hint_of_scale(solids.name(i), solids.shape(i).bounds().diagonal().norm());
  return hint.empty() ? hint : " (" + hint + ")";
}

// Where gravity pulls towards a positive coordinate, as by a forgotten sign, or is tilted, as for a slope, and a plane
// looks against it, or a sheet lies across it and edge-on to that face of the solid (its outward normal); else "".
std::string gravity_in_doubt(const Scene& scene, std::size_t i, const Vector3& face) {
  if (const auto edge_on = scene::sheet_edge_on_in_doubt(scene, face))
    return fmt::format(" ({})", *edge_on);
  const auto* plane = std::get_if<scene::HalfSpace>(&scene.solids[i].shape);
  const auto up = scene::up(scene.environment);
  Eigen::Index axis = 0;
  if (plane == nullptr || !up || plane->normal.normalized().dot(*up) < 1 - place_rounding)
    return "";
  up->cwiseAbs().maxCoeff(&axis);
  if ((*up)[axis] > 0) {
    const auto level = scene::level_plane_in_doubt(scene, i);
    return level ? fmt::format(" ({})", *level) : "";
  }
  return fmt::format(" (gravity pulls towards +{0}, and the plane's normal is against it, as by default: is gravity "
                     "meant to pull towards -{0}?)",
                     "xyz"[axis]);
}

// A triangle, all corners of which are outside, that reaches into a solid between them.
void check_triangle_outside(const Scene& scene, const solid::Solids& solids, std::size_t i, const Frame& frame,
                            std::size_t t) {
  const auto x = positions(frame);
  const Corners& c = triangles(frame)[t];
  const Eigen::Isometry3d pose = solids.pose(i, frame.time), to_own = pose.inverse();
  const solid::Triangle3 own{to_own * x[c[0]], to_own * x[c[1]], to_own * x[c[2]]};
  const Eigen::Vector3d middle = (own[0] + own[1] + own[2]) / 3;
  double reach = 0;
  for (const Eigen::Vector3d& corner : own)
    reach = std::max(reach, (corner - middle).norm());
  if (solids.shape(i).distance(middle, 2 * reach) >= reach)
    return;
  const auto [weights, near] = solids.shape(i).deepest(own, 1e-3 * reach);
  const Eigen::Vector3d place = pose * solid::point_of(own, weights);
  if (near.distance < -place_rounding * place.norm())
    fail(ExitCode::bad_input,
         "the sheet starts across {}: triangle {} at ({:g}, {:g}, {:g}) m lies {:.2g} m under its surface, though its "
         "corners do not; move one of them, or take shorter edges{}",
         solids.name(i), t, place.x(), place.y(), place.z(), -near.distance, scale_in_doubt(scene, solids, i, frame));
}

// What is held, or stands in the inlet, may begin in a nozzle or a clamp. A vertex is free that does neither.
auto free_vertices(const Frame& frame) {
  return [held = holds(frame), inlet = masks(frame, "inlet")](std::size_t v) {
    return (held.empty() || held[v] == 0) && (inlet.empty() || inlet[v] == 0);
  };
}

void check_outside_solids(const Scene& scene, const Frame& frame) {
  const solid::Solids solids(scene);
  const auto x = positions(frame);
  const auto is_free = free_vertices(frame);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t v = 0; v < x.size(); ++v)
      if (const solid::SolidPoint there = is_free(v) ? solids.at(i, x[v], frame.time) : solid::SolidPoint{};
          there.distance < -place_rounding * x[v].norm())
        fail(ExitCode::bad_input,
             "the sheet starts inside {}: vertex {} at ({:g}, {:g}, {:g}) m lies {:.2g} m under its surface; move one "
             "of them{}{}",
             solids.name(i), v, x[v].x(), x[v].y(), x[v].z(), -there.distance, scale_in_doubt(scene, solids, i, frame),
             gravity_in_doubt(scene, i, there.normal));
    for (std::size_t t = 0; t < frame.triangles; ++t)
      if (std::ranges::all_of(triangles(frame)[t], is_free))
        check_triangle_outside(scene, solids, i, frame, t);
  }
}

// Of sheets that enter later, as they will be then: that they are outside solids, and what flows in at their inlets.
void check_sheets_to_come(const Scene& scene) {
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const scene::SheetTable& sheet = scene.sheets[i];
    if (!sheet.enters)
      continue;
    Frame frame = build_sheet(scene, i, Notes::silent);
    frame.time = *sheet.enters;
    check_outside_solids(scene, frame);
    for (std::size_t number = 0; number < scene.inflows.size(); ++number)
      if (const scene::Inflow& inflow = scene.inflows[number];
          inflow.sheet == sheet.name && scene::in_force(inflow, frame.time))
        flow::check_inlet(frame, scene, inflow, flow::find_inlet(frame, number));
  }
}

// Unit vectors.
std::vector<Vector3> normals_at_vertices(const Frame& frame) {
  const auto x = positions(frame);
  std::vector<Vector3> normals(frame.vertices, Vector3::Zero());
  for (const Corners& c : triangles(frame))
    for (const std::uint32_t v : c)
      normals[v] += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal;
  for (Vector3& n : normals)
    n.normalize();
  return normals;
}

// Of the vertices that no solid touches yet those that are close to one.
struct NearSolid {
  std::vector<std::size_t> near, touching;
  std::vector<std::size_t> hanging; // of what touches: what lies along it and beside or below it
  bool all_along;                   // all that are near lie along it where it is upright or overhangs, and it stays
  bool all_beside;                  // where it is upright
  bool all_above;                   // all that are near are above it
};
// As near as one and a half times half the thickness, or half of the greatest thickness that touches: a sheet without
// bends along a solid is as far from it as its thickest part.
NearSolid near_solid(const solid::Solids& solids, std::size_t i, const Frame& frame, const Vector3& up,
                     std::span<const Vector3> normals, std::span<const double> thickness,
                     std::span<const std::int32_t> touch) {
  constexpr double in_reach = 1 + 1e-3, near_enough = 1.5; // of half the thickness
  constexpr double upright = 0.1, along = 0.9;             // sine of the wall's lean; cosine between the normals
  const auto x = positions(frame);
  std::vector<solid::SolidPoint> there;
  double thickest = 0; // of what touches
  for (std::size_t v = 0; v < x.size(); ++v) {
    there.push_back(solids.at(i, x[v], frame.time));
    if (touch[v] == no_solid && there[v].distance <= in_reach * thickness[v] / 2)
      thickest = std::max(thickest, thickness[v]);
  }
  const bool stays = scene::stays_in_place(solids.scene(i).motion);
  NearSolid found{.near = {}, .touching = {}, .hanging = {}, .all_along = stays, .all_beside = true, .all_above = true};
  for (std::size_t v = 0; v < x.size(); ++v) {
    const double distance = there[v].distance, slope = there[v].normal.dot(up);
    if (touch[v] != no_solid || !(distance <= std::max(near_enough * thickness[v], in_reach * thickest) / 2))
      continue;
    const bool lies_along = slope < upright && std::abs(there[v].normal.dot(normals[v])) > along;
    found.near.push_back(v);
    if (distance <= in_reach * thickness[v] / 2) {
      found.touching.push_back(v);
      if (lies_along)
        found.hanging.push_back(v);
    }
    found.all_along = found.all_along && lies_along;
    found.all_beside = found.all_beside && std::abs(slope) < upright;
    found.all_above = found.all_above && slope > 0;
  }
  return found;
}

// Whether another solid is in reach of a vertex, on which it would lie.
bool touches_another(const solid::Solids& solids, std::size_t i, const Vector3& x, double thickness, double time) {
  for (std::size_t other = 0; other < solids.size(); ++other)
    if (other != i && solids.at(other, x, time).distance <= thickness)
      return true;
  return false;
}

// What starts in contact with a solid that holds it across only. Where all that is near lies along walls that stay in
// place, upright or overhanging, what is closely beside or below them counts, too: its weight would not press it on.
// (Of what is near and lies on top, a part alone would be held, into which the rest falls; what is below a solid and
// touches another one lies on that.) So does what is as near above solids where nothing resists its fall onto them. Of
// what sticks, what touches and lies along the solid, beside or below it, as a coat around a rod: what lies on top
// comes to stick by its weight.
void mark_touching(const Scene& scene, Frame& frame) {
  const solid::Solids solids(scene);
  const auto up = scene::up(scene.environment);
  const bool falls_at_once = scene::nothing_resists_fall(scene);
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto is_free = free_vertices(frame);
  const std::vector<Vector3> normals = normals_at_vertices(frame);
  const std::vector<double> thickness = thickness_around(frame.vertices, corners, volumes(frame), [&](std::uint32_t t) {
    return TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
  });
  std::vector<std::int32_t> touch(frame.vertices, no_solid);
  const auto touches_others = [&](std::size_t i) {
    return std::ranges::any_of(
        touch, [&](std::int32_t solid) { return solid != no_solid && solid != static_cast<std::int32_t>(i); });
  };
  for (const bool from_below : {false, true})
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const bool sticks = solids.scene(i).contact == SolidContact::stick;
      if (from_below && (sticks || touches_others(i)))
        continue;
      const NearSolid found = near_solid(solids, i, frame, up.value_or(Vector3::Zero()), normals, thickness, touch);
      if (sticks) {
        for (const std::size_t v : found.hanging)
          if (is_free(v) && !touches_another(solids, i, x[v], thickness[v], frame.time))
            touch[v] = static_cast<std::int32_t>(i);
        continue;
      }
      const bool all_near =
          up && ((found.all_along && (from_below || found.all_beside)) || (falls_at_once && found.all_above));
      for (const std::size_t v : all_near ? found.near : found.touching)
        touch[v] = static_cast<std::int32_t>(i);
    }
  if (std::ranges::any_of(touch, [](std::int32_t solid) { return solid != no_solid; }))
    put_touched_solids(frame, touch, solids.size());
}

// With the amount of gas that presses, in what the sheet encloses, as its scene says of the start.
Scene with_amount_of_gas(Scene scene, const Frame& frame) {
  auto& gas = std::get<scene::GasPressure>(*scene.environment.pressure);
  const double enclosed = capped_volume(connect(frame.vertices, triangles(frame)), positions(frame));
  if (!(enclosed + gas.more_volume > 0))
    fail(ExitCode::bad_input,
         "pressure: the sheet encloses {:.3g} m^3 on the side that its triangles' normals point away from, so there is "
         "no room for gas: turn the sheet round, or give more_volume",
         enclosed);
  if (!gas.amount)
    gas.amount =
        amount_of_gas({.ambient = gas.ambient, .exponent = gas.exponent}, gas.value, enclosed + gas.more_volume);
  return scene;
}

// Why the triangles are no surface; nothing if they are one.
std::optional<Error> fault_of_surface(const Frame& frame) {
  try {
    (void)remesh::Mesh(frame.vertices, triangles(frame));
  } catch (const Error& error) {
    return error;
  }
  return {};
}

// Names the mesh file that is to blame, and its own vertices and triangles, whatever their numbers in the frame.
void check_surface(const Scene& scene, const Frame& frame) {
  const std::optional<Error> fault = fault_of_surface(frame);
  if (!fault)
    return;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (const auto* mesh = std::get_if<scene::SheetMesh>(&scene.sheets[i].shape))
      if (const std::optional<Error> own = fault_of_surface(build_sheet(scene, i, Notes::silent)))
        fail(own->code(), "{}: {} (counted from 0)", mesh->file, own->what());
  throw *fault;
}

// That none of them takes away the whole sheet, or an inlet, of which nothing could flow in any more.
void check_outflows(const Scene& scene, const Frame& frame) {
  const auto x = positions(frame);
  const auto inlet = masks(frame, "inlet");
  for (std::size_t i = 0; i < scene.outflows.size(); ++i) {
    const scene::Outflow& outflow = scene.outflows[i];
    const Vector3& n = outflow.normal;
    const auto is_beyond = [&](const Vector3& place) { return n.dot(place - outflow.point) > 0; };
    const auto leaves = [&](const flow::InletChain& chain) {
      return std::ranges::all_of(chain.border, [&](std::uint32_t v) { return is_beyond(x[v]); });
    };
    const bool whole = std::ranges::all_of(x, is_beyond);
    bool an_inlet = false;
    for (std::size_t number = 0; number < scene.inflows.size() && !inlet.empty(); ++number)
      an_inlet = an_inlet || std::ranges::any_of(flow::find_inlet(frame, number), leaves);
    if (whole || an_inlet)
      fail(
          ExitCode::bad_input,
          "[[outflow]] {} (from 0) takes {} away at the start: what is beyond its plane, where its normal ({:g}, {:g}, "
          "{:g}) points, leaves; turn the normal round, or move its point",
          i, whole ? "the whole sheet" : "the inlet", n.x(), n.y(), n.z());
  }
}

} // namespace

Frame first_frame(const Scene& scene) {
  Frame frame = build_frame(scene);
  if (!scene.solids.empty())
    mark_touching(scene, frame);
  if (encloses_gas(scene)) {
    const solid::Solids solids(scene);
    seal_open_rims(scene, frame, &solids);
  }
  // Where there are several, each one's amount is in the frames.
  if (encloses_gas(scene) && enclosures(frame).empty())
    frame.put_text("scene", to_toml(with_amount_of_gas(scene, frame)));
  if (scene.tear && scene.tear->drops)
    write_drops(frame, {});
  return frame;
}

Frame checked_first_frame(const Scene& scene) {
  const solid::Solids kept(scene); // each mesh is read once
  Frame frame = first_frame(scene);
  check_surface(scene, frame);
  StepStage({}).check(frame);
  if (flows_in_or_out(scene)) {
    check_outflows(scene, frame);
    Frame copy = frame;
    flow::EmitStage().emit(copy);
  }
  if (scene.tear) {
    Frame copy = frame;
    flow::TearStage().tear(copy);
  }
  if (!scene.solids.empty())
    check_outside_solids(scene, frame);
  check_sheets_to_come(scene);
  const bool keeps_apart = scene.contact && scene.contact->self;
  if (const std::string seam = keeps_apart ? seam_warning(scene, frame) : ""; !seam.empty())
    fail(ExitCode::bad_input, "{}", seam);
  if (!scene.solids.empty() || keeps_apart) {
    Frame copy = frame; // as if a step so short that no solid moves had made it
    formats::Array start = formats::make_standard_array("start_position", frame.vertices);
    std::ranges::copy(positions(std::as_const(frame)), start.values<Eigen::Vector3d>().begin());
    copy.put(std::move(start));
    put_number(copy, "start_time", frame.time - shortest_step);
    collide::CollideStage().step(copy);
  }
  return frame;
}

scene::Measured measured(const Frame& frame) {
  const double area = area_of(frame);
  double volume = 0;
  for (const double v : volumes(frame))
    volume += v;
  return {.length = std::sqrt(area), .thickness = volume / area, .curvature = {}};
}

double height_above_bath(const Scene& scene, const Frame& frame) {
  const auto up = scene::up(scene.environment);
  if (!up || !scene.environment.bath || frame.vertices == 0)
    return 0;
  double height = std::numeric_limits<double>::infinity();
  for (const Vector3& x : positions(frame))
    height = std::min(height, up->dot(x) - scene.environment.bath->level);
  return std::max(0.0, height);
}

std::vector<scene::Measured> measured_sheets(const Scene& scene, const Frame& first) {
  const auto measure = [&](const Frame& frame) {
    scene::Measured result = measured(frame);
    result.above_bath = height_above_bath(scene, frame);
    return result;
  };
  if (scene.sheets.size() == 1)
    return {measure(first)};
  std::vector<scene::Measured> all;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    all.push_back(measure(build_sheet(scene, i, Notes::silent)));
  return all;
}

} // namespace sheet
