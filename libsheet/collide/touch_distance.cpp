// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/touch_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sheet::collide {
namespace {

constexpr double deepest_chord = 0.18; // of an edge: around a corner of 90 degrees
constexpr double leaves_room = 0.375;  // of the thickness: between a vertex that lies and what triangles keep
constexpr double over_chord = 1.5;     // how many times its depth a vertex keeps off
constexpr double least_leaning = 0.5;  // of half the thickness, on a rim

Vector3 vector_area(const Corners& c, std::span<const Vector3> x) {
  return 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
}

// The nearest point of the solid's surface, in its frame, and its normal there; none has a normal of zero. And how much
// it counts: all where the vertex may touch, nothing twice as far off.
struct Foot {
  Vector3 place = Vector3::Zero(), normal = Vector3::Zero();
  double part = 0;
};

// Of the vertices whose triangles may reach the solid, at the end.
std::vector<Foot> feet_on(const StepPath& path, const SolidView& view, std::span<const double> longest_edges) {
  std::vector<Foot> feet(path.end.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, feet.size(), 256), [&](const auto& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const double chord = over_chord * deepest_chord * longest_edges[v];
      const double reach = path.thickness[v] / 2 + 2 * chord;
      if (chord <= leaves_room * path.thickness[v] || view.swept().squaredExteriorDistance(path.end[v]) > reach * reach)
        continue;
      const Vector3 own = view.own(view.pieces(), path.end[v]);
      if (view.shape().distance(own, reach) >= reach)
        continue;
      const solid::Near near = view.shape().nearest(own);
      feet[v] = {own - near.distance * near.normal, near.normal,
                 std::clamp(2 - (near.distance - path.thickness[v] / 2) / chord, 0.0, 1.0)};
    }
  });
  return feet;
}

// How deep the chord between two feet lies in the solid, at its middle; 0 where the surface is flat or hollow. Of an
// arc whose ends face along the two normals the depth is about (n_b - n_a)·(x_b - x_a)/8, at most an eighth more up to
// 90 degrees: what cannot be as deep as `least` is not looked at.
double chord_depth(const SolidView& view, const Foot& a, const Foot& b, double least) {
  if (a.normal.isZero(0) || b.normal.isZero(0) || (b.normal - a.normal).dot(b.place - a.place) <= 6 * least)
    return 0;
  return std::max(0.0, -view.shape().distance((a.place + b.place) / 2, (b.place - a.place).norm()));
}

} // namespace

std::vector<double> chord_allowances(const StepPath& path, std::span<const SolidView> views,
                                     std::span<const double> longest_edges) {
  std::vector<double> allowance(path.end.size(), 0);
  std::vector<std::array<double, 3>> depth(path.triangles.size());
  for (const SolidView& view : views) {
    const std::vector<Foot> feet = feet_on(path, view, longest_edges);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, depth.size(), 256), [&](const auto& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = path.triangles[t][k], b = path.triangles[t][(k + 1) % 3];
          const double least = leaves_room / over_chord * std::min(path.thickness[a], path.thickness[b]);
          depth[t][k] = chord_depth(view, feet[a], feet[b], least);
        }
    });
    for (std::size_t t = 0; t < depth.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = path.triangles[t][k], b = path.triangles[t][(k + 1) % 3];
        const double both = over_chord * depth[t][k] * std::min(feet[a].part, feet[b].part);
        for (const std::uint32_t v : {a, b})
          allowance[v] = std::max(allowance[v], both - leaves_room * path.thickness[v]);
      }
  }
  return allowance;
}

std::vector<Vector3> facings(const StepPath& path) {
  std::vector<Vector3> facing(path.start.size(), Vector3::Zero());
  std::vector<double> area(path.start.size(), 0);
  for (const Corners& c : path.triangles) {
    const Vector3 whole = vector_area(c, path.start);
    for (const std::uint32_t v : c) {
      facing[v] += whole;
      area[v] += whole.norm();
    }
  }
  for (std::size_t v = 0; v < facing.size(); ++v)
    if (area[v] > 0)
      facing[v] /= area[v];
  return facing;
}

double catching_distance(const StepPath& path, const SolidView& view, std::uint32_t vertex, const Vector3& x,
                         double within) {
  const double half = path.half_thickness(vertex);
  if (!view.flows() || view.shape().distance(x, within) >= within)
    return half;
  const Vector3 facing = view.own(0, path.facing[vertex]) - view.own(0, Vector3::Zero());
  const double leaning = std::max(least_leaning, std::abs(facing.dot(view.shape().nearest(x).normal)));
  return half - (1 - leaning) * path.thickness[vertex] / 2;
}

} // namespace sheet::collide
