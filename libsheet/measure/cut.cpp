// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/cut.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;

// What a plane does to the mesh.
class Cutter {
public:
  Cutter(const Frame& frame, const CutPlane& plane)
      : frame_(frame), mesh_(connect(frame.vertices, triangles(frame))), plane_(plane) {
    for (const Vector3& x : positions(frame))
      height_.push_back(plane.normal.dot(x) - plane.offset);
    touches_ = std::ranges::none_of(height_, [](double height) { return height < 0; });
  }

  [[nodiscard]] std::vector<CutCurve> curves() {
    passed_.assign(mesh_.triangles.size(), false);
    std::vector<CutCurve> found;
    for (const bool open : {true, false})
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        if (is_cut(t) && !passed_[t] && (!open || before(t) == no_index))
          if (CutCurve curve = follow(t); !curve.empty())
            found.push_back(open ? std::move(curve) : from_lowest(std::move(curve)));
    std::ranges::stable_sort(found, std::greater<>(), [&](const CutCurve& curve) { return length(curve); });
    return found;
  }

private:
  [[nodiscard]] bool below(std::uint32_t vertex) const {
    return height_[vertex] < 0 || (touches_ && height_[vertex] == 0);
  }
  // The side of a triangle, from corner i to the next, along which its border comes down through the plane (down), or
  // up; 3: none.
  [[nodiscard]] std::size_t side(std::uint32_t t, bool down) const {
    const Corners& c = mesh_.triangles[t];
    std::size_t i = 0;
    while (i < 3 && (below(c[i]) == below(c[(i + 1) % 3]) || below(c[i]) == down))
      ++i;
    return i;
  }
  [[nodiscard]] bool is_cut(std::uint32_t t) const { return side(t, true) < 3; }

  // A curve goes in where the border comes down, and out where it goes up.
  [[nodiscard]] std::uint32_t beyond(std::uint32_t t, std::size_t side) const {
    const auto& both = mesh_.edge_triangles[mesh_.triangle_edges[t][(side + 2) % 3]];
    return both[0] == t ? both[1] : both[0];
  }
  [[nodiscard]] std::uint32_t before(std::uint32_t t) const { return beyond(t, side(t, true)); }
  [[nodiscard]] std::uint32_t after(std::uint32_t t) const { return beyond(t, side(t, false)); }

  [[nodiscard]] SurfacePoint crossing(std::uint32_t t, std::size_t side) const {
    const Corners& c = mesh_.triangles[t];
    const std::size_t next = (side + 1) % 3;
    // from the lower vertex to the higher, so that both triangles of an edge have the same point
    const bool forwards = c[side] < c[next];
    const double first = height_[c[forwards ? side : next]], second = height_[c[forwards ? next : side]];
    const double part = first / (first - second);
    SurfacePoint point{t};
    point.weights[side] = forwards ? 1 - part : part;
    point.weights[next] = forwards ? part : 1 - part;
    return point;
  }

  // Pieces that have a length, from triangle t on.
  CutCurve follow(std::uint32_t t) {
    CutCurve curve;
    for (; t != no_index && !passed_[t]; t = after(t)) {
      passed_[t] = true;
      const std::array<SurfacePoint, 2> piece = {crossing(t, side(t, true)), crossing(t, side(t, false))};
      if (position_of(frame_, piece[0]) != position_of(frame_, piece[1]))
        curve.push_back(piece);
    }
    return curve;
  }

  [[nodiscard]] CutCurve from_lowest(CutCurve curve) const {
    const Vector3 normal = plane_.normal.normalized();
    const auto within = [&](const Vector3& axis) { return Vector3(axis - normal.dot(axis) * normal); };
    Vector3 up = within(Vector3::UnitY());
    if (up.norm() < 1e-6)
      up = within(Vector3::UnitX());
    const auto height = [&](const std::array<SurfacePoint, 2>& piece) { return up.dot(position_of(frame_, piece[0])); };
    std::rotate(curve.begin(), std::ranges::min_element(curve, {}, height), curve.end());
    return curve;
  }

  [[nodiscard]] double length(const CutCurve& curve) const {
    double sum = 0;
    for (const auto& [start, end] : curve)
      sum += (position_of(frame_, end) - position_of(frame_, start)).norm();
    return sum;
  }

  const Frame& frame_;
  Connectivity mesh_;
  CutPlane plane_;
  std::vector<double> height_; // of vertices above the plane, times the normal's length
  bool touches_ = false;       // nothing is below the plane
  std::vector<bool> passed_;
};

} // namespace

Vector3 position_of(const Frame& frame, const SurfacePoint& point) {
  const Corners& c = triangles(frame)[point.triangle];
  Vector3 x = Vector3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    x += point.weights[i] * positions(frame)[c[i]];
  return x;
}

double value_at(const Frame& frame, const Field& field, const std::vector<double>& values, const SurfacePoint& point) {
  if (field.where == formats::Place::triangle)
    return values[point.triangle];
  const Corners& c = triangles(frame)[point.triangle];
  return point.weights[0] * values[c[0]] + point.weights[1] * values[c[1]] + point.weights[2] * values[c[2]];
}

std::vector<CutCurve> cut(const Frame& frame, const CutPlane& plane) { return Cutter(frame, plane).curves(); }

std::optional<SurfacePoint> nearest_point(const Frame& frame, const Vector3& point) {
  std::optional<SurfacePoint> nearest;
  double least = std::numeric_limits<double>::infinity(); // squared
  const auto x = positions(frame);
  for (std::uint32_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const ClosestPoints closest = closest_vertex_triangle({point, x[c[0]], x[c[1]], x[c[2]]});
    if (const double squared = closest.offset.squaredNorm(); squared < least) {
      least = squared;
      nearest = SurfacePoint{t, {-closest.weights[1], -closest.weights[2], -closest.weights[3]}};
    }
  }
  return nearest;
}

} // namespace sheet
