// SPDX-License-Identifier: GPL-3.0-or-later
// Where the vertices and triangles of a step first meet solids.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/collide/solid_view.h"

namespace sheet::collide {

// How near is too near, as parts of half the sheet's thickness.
inline constexpr double clearance_part = 0.25; // of triangles: what is guaranteed
inline constexpr double hit_slack = 0.125;     // between this more and the guarantee, a hit may or may not be found
inline constexpr double target = 0.5;          // how far out a triangle that has hit is brought
inline constexpr double least_beside = 0.02;   // of a rim beside an upright face, which bears nothing
inline constexpr double vertex_slack = 1e-6;   // a vertex this much beyond half the thickness touches: round-off

// The earliest s at which a point on its way from a to b is within `offset` of the solid, to a millionth, by
// sphere tracing [Hart 1996] and bisection; nothing where it never is. Each turn advances by at least a hundredth of
// the offset, so what dips less deep in between may be missed.
[[nodiscard]] std::optional<double> first_contact(const solid::SolidDistance& shape, const Vector3& a, const Vector3& b,
                                                  double offset);

// A vertex that meets a solid, after the part s of the step.
struct VertexHit {
  std::uint32_t solid;
  double s;
  Vector3 place; // in the solid's frame
};

// The first solid that the vertex comes to touch (touch_distance.h), of all but `rides`. `deepest` becomes the least
// signed distance where it starts, if that is less than what it was.
[[nodiscard]] std::optional<VertexHit> first_hit(const StepPath& path, std::span<const SolidView> views,
                                                 std::uint32_t vertex, double& deepest, std::int32_t rides = no_solid);

// A triangle that comes too close to a solid.
struct FoundHit {
  enum class Kind {
    meeting, // at the time s
    closing, // it starts close, and ends closer: s = 1, the point is the deepest one at the end
    across   // it starts across the surface: likewise
  };
  Kind kind;
  std::uint32_t triangle, solid;
  double s;                   // the part of the step until then
  solid::TrianglePoint point; // near in the solid's frame
  Vector3 place;              // of the point, in the solid's frame, at that time
  double keeps;               // how far off the triangle is to be kept [m]
};

// How near triangles may come, as parts of half the thickness.
struct Nearness {
  double clearance = clearance_part, slack = hit_slack;
  // Whether a triangle that starts nearer to a solid than the clearance must not end so, but at the target; else as far
  // off as it starts, or as a rim may be. Absent: none must.
  std::function<bool(std::uint32_t triangle, std::uint32_t solid)> mends;
};

// The earliest hit of one triangle; vertices ride on the solid that `rides` names, or go straight. A triangle that
// starts nearer than the clearance must keep nine tenths of what it has on the way, and end with all of it, or with
// the clearance where that is to be mended.
[[nodiscard]] std::optional<FoundHit> first_hit(const StepPath& path, std::span<const SolidView> views,
                                                std::span<const std::int32_t> rides, std::uint32_t triangle,
                                                const Nearness& nearness);

// Those of many triangles, in their order.
[[nodiscard]] std::vector<FoundHit> find_hits(const StepPath& path, std::span<const SolidView> views,
                                              std::span<const std::int32_t> rides,
                                              std::span<const std::uint32_t> triangles, const Nearness& nearness = {});

} // namespace sheet::collide
