// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/inlet_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/box.h"
#include "libsheet/geometry/triangle_pair.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/prescribed.h"

namespace sheet::flow {

using Eigen::Vector3d;
using formats::Frame;

namespace {

constexpr double most_outward = 0.1; // of the speed: a border that is a little uneven may lean so much
constexpr double least_across = 1e-6;

// Why an inflow points out of the sheet, and what to do.
std::string_view why_outward(const Frame& frame, const InletChain& chain) {
  if (!chain.row.empty())
    return "what has flowed in was turned over there, as by a solid that comes to the inlet, by what piles up below "
           "it, by its weight as it is drawn up, or by a solid that drags it along the inlet faster than it comes in; "
           "give it room, or edges so short that a row has entered before it is dragged as far";
  if (frame.step > 0)
    return "the sheet was turned over there before anything had entered; let it start at the inflow's velocity "
           "(velocity in [sheet]), and give it room";
  return "liquid cannot be drawn back; choose the border at the other side";
}

void check_velocity(const Frame& frame, const InletChain& chain, double time, const scene::InletVelocity& inlet) {
  if (!(inlet.speed(time) > 0))
    return;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  for (std::size_t i = 0; i < chain.edges(); ++i) {
    const std::uint32_t a = chain.border[i], b = chain.border[chain.after(i)];
    const Corners& c = corners[chain.behind[i]];
    const Vector3d edge = x[b] - x[a], velocity = inlet.at(time, 0.5 * (x[a] + x[b]));
    const double speed = velocity.norm();
    const Vector3d outward = edge.cross(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal);
    if (velocity.dot(outward) > most_outward * speed * outward.norm())
      fail(ExitCode::bad_input,
           "the inflow's velocity at {} s, ({}, {}, {}) m/s, points out of the sheet at the inlet's edge ({}, {}): {}, "
           "or end the inflow with `until`",
           time, velocity[0], velocity[1], velocity[2], a, b, why_outward(frame, chain));
    if (!(edge.cross(velocity).norm() > least_across * edge.norm() * speed))
      fail(ExitCode::bad_input,
           "the inflow's velocity at {} s, ({}, {}, {}) m/s, runs along the inlet's edge ({}, {}): nothing would enter",
           time, velocity[0], velocity[1], velocity[2], a, b);
  }
}

// The bits that all vertices of the border have.
std::uint64_t common_holds(const Frame& frame, std::span<const InletChain> chains) {
  const auto masks = holds(frame);
  if (masks.empty() || chains.empty())
    return 0;
  std::uint64_t common = ~std::uint64_t{0};
  for (const InletChain& chain : chains)
    for (const std::uint32_t v : chain.border)
      common &= masks[v];
  return common;
}

bool moves_along(const scene::InletVelocity& velocity, std::size_t axis) {
  const auto along = static_cast<Eigen::Index>(axis);
  for (const auto& entry : velocity.common.entries)
    if (entry.value[along] != 0)
      return true;
  return std::ranges::any_of(velocity.radial.entries, [](const auto& entry) { return entry.value != 0; }) &&
         std::abs(velocity.axis.direction[along]) != 1;
}

// Along an axis that it holds, at any time.
bool moves(const scene::Hold& hold) {
  const auto* translating = std::get_if<scene::Translating>(&hold.motion);
  if (translating == nullptr)
    return !std::holds_alternative<scene::Fixed>(hold.motion);
  return std::ranges::any_of(translating->velocity.entries, [&](const auto& entry) {
    return std::ranges::any_of(std::array{0, 1, 2}, [&](int axis) {
      return has_axis(hold.axes, static_cast<std::size_t>(axis)) && entry.value[axis] != 0;
    });
  });
}

// What to give solids instead of that motion, in words.
std::string opposite_of(const scene::Motion& motion) {
  const auto* translating = std::get_if<scene::Translating>(&motion);
  if (translating == nullptr || translating->velocity.entries.size() != 1)
    return "[[solid]] velocity, or motion with kind = \"keyframed\"";
  const Vector3d v = -translating->velocity.entries.front().value + Vector3d::Zero();
  return fmt::format("[[solid]] velocity = [{:g}, {:g}, {:g}]", v.x(), v.y(), v.z());
}

} // namespace

void check_inlet(const Frame& frame, const Scene& scene, const scene::Inflow& inflow,
                 std::span<const InletChain> chains) {
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, inflow);
  for (const InletChain& chain : chains) {
    check_velocity(frame, chain, frame.time, velocity);
    if (chain.row.empty())
      for (const double time : velocity.times())
        if (time > frame.time)
          check_velocity(frame, chain, time, velocity);
  }
  const std::uint64_t common = common_holds(frame, chains) & scene::holds_in_force(scene, frame.time);
  for (std::size_t i = 0; i < scene.holds.size(); ++i) {
    const scene::Hold& hold = scene.holds[i];
    if ((common >> i & 1) == 0)
      continue;
    if (moves(hold))
      fail(ExitCode::bad_input,
           "[[hold]] number {} (from 0) moves the whole inlet, so what flows in would hang on it and go with it for "
           "ever: an inlet stands. Let the solids move past it the other way ({}), which is the same as seen from it",
           i, opposite_of(hold.motion));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (has_axis(hold.axes, axis) && moves_along(velocity, axis))
        fail(ExitCode::bad_input,
             "[[hold]] number {} (from 0) holds the whole inlet along {}, so what flows in would hang there for ever: "
             "give it a region that leaves the inlet out",
             i, "xyz"[axis]);
  }
}

void check_room(const Frame& frame, const Scene& scene, std::size_t number) {
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto bits = masks(frame, "inlet");
  const std::uint64_t own = of_inlet(~std::uint64_t{0}, 0) << (bits_of_an_inlet * number);
  std::vector<std::uint32_t> mouth;
  Box around;
  for (std::uint32_t t = 0; t < corners.size(); ++t)
    if (std::ranges::any_of(corners[t], [&](std::uint32_t v) { return (bits[v] & own) != 0; }) &&
        !corners_collinear(x, corners[t])) {
      mouth.push_back(t);
      around.add(box_of(x, corners[t]));
    }
  for (std::uint32_t other = 0; other < corners.size(); ++other) {
    const Box box = box_of(x, corners[other]);
    if (!around.overlaps(box) || corners_collinear(x, corners[other]))
      continue;
    for (const std::uint32_t t : mouth)
      if (t != other && box_of(x, corners[t]).overlaps(box) && triangles_intersect(x, corners[t], corners[other])) {
        const Vector3 place = (x[corners[t][0]] + x[corners[t][1]] + x[corners[t][2]]) / 3;
        fail(ExitCode::bad_input,
             "the inlet{} has no room near ({:.4g}, {:.4g}, {:.4g}) m: something lies in its mouth, through which the "
             "next row would come in (triangles {} and {}). Give it room: put it farther from what piles up there, let "
             "that flow away, or end the inflow before, with `until`",
             scene.inflows.size() > 1 ? fmt::format(" of [[inflow]] number {} (from 0)", number) : "", place.x(),
             place.y(), place.z(), t, other);
      }
  }
}

} // namespace sheet::flow
