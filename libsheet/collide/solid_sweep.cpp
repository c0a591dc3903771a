// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/solid_sweep.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sheet::collide {
namespace {

// A vertex that starts within the offset and moves out of it touches only what it comes nearer to than it was.
double offset_for(const SolidDistance& shape, const Vector3& start, const Vector3& next, double offset) {
  const double reach = offset * (1 + kVertexSlack);
  if (shape.distance(start, reach) >= reach)
    return offset;
  const Near near = shape.nearest(start);
  return near.distance > 0 && near.normal.dot(next - start) > 0 ? std::min(offset, 0.9 * near.distance) : offset;
}

} // namespace

std::optional<double> first_contact(const SolidDistance& shape, const Vector3& a, const Vector3& b, double offset) {
  const double travel = (b - a).norm(), slack = kVertexSlack * offset;
  double s = 0;
  while (s <= 1) {
    const double within = offset + slack + (1 - s) * travel;
    const double distance = shape.distance((1 - s) * a + s * b, within);
    if (distance >= within)
      return std::nullopt;
    if (distance <= offset + slack)
      return s;
    s += (distance - offset) / travel;
  }
  return std::nullopt;
}

std::optional<VertexHit> first_hit(const StepPath& path, std::span<const SolidView> views, std::uint32_t vertex,
                                   double& deepest) {
  std::optional<VertexHit> first;
  const double offset = path.thickness[vertex] / 2;
  const Vector3 &start = path.start[vertex], &end = path.end[vertex];
  Box3 box(start);
  box.extend(end);
  const double reach = offset * (1 + kVertexSlack);
  box.min().array() -= reach;
  box.max().array() += reach;
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    const SolidView& view = views[i];
    if (!view.swept().intersects(box))
      continue;
    Vector3 a = view.own(0, start);
    deepest = std::min(deepest, view.shape().distance(a, offset));
    for (std::size_t k = 0; k < view.pieces(); ++k) {
      const Vector3 b = view.on_path(k + 1, start, end, false);
      const double own_offset = k == 0 ? offset_for(view.shape(), a, b, offset) : offset;
      if (const auto s = first_contact(view.shape(), a, b, own_offset)) {
        const double whole = (static_cast<double>(k) + *s) / static_cast<double>(view.pieces());
        if (!first || whole < first->s)
          first = VertexHit{i, whole, (1 - *s) * a + *s * b};
        break;
      }
      a = b;
    }
  }
  return first;
}

std::optional<FoundHit> first_hit(const StepPath& path, std::span<const SolidView> views,
                                  std::span<const std::int32_t> rides, std::uint32_t triangle) {
  const Corners& corners = path.triangles[triangle];
  Box3 box;
  double half = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : corners) {
    box.extend(path.start[v]);
    box.extend(path.end[v]);
    half = std::min(half, path.thickness[v] / 2);
  }
  box.min().array() -= half;
  box.max().array() += half;
  std::optional<FoundHit> first;
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    const SolidView& view = views[i];
    if (!view.swept().intersects(box))
      continue;
    const SolidDistance& shape = view.shape();
    const auto place = [&](std::size_t k) {
      Triangle3 result;
      for (std::size_t c = 0; c < 3; ++c)
        result[c] = view.on_path(k, path.start[corners[c]], path.end[corners[c]],
                                 rides[corners[c]] == static_cast<std::int32_t>(i));
      return result;
    };
    double clearance = kClearance * half, slack = kHitSlack * half;
    MovingTriangle moving{place(0), place(1)};
    for (std::size_t k = 0; k < view.pieces(); ++k) {
      if (k > 0)
        moving = {moving.end, place(k + 1)};
      auto hit = shape.first_hit(moving, clearance, slack);
      if (k == 0 && hit && hit->s == 0) { // it starts there: then half of what it has is what it keeps
        const double apart = shape.separation(moving.start, clearance + slack, 0.01 * clearance);
        if (apart == 0) {
          const Triangle3 last = place(view.pieces());
          const TrianglePoint deepest = shape.deepest(last, slack);
          if (deepest.near.distance < clearance && (!first || !first->across))
            first = FoundHit{triangle, i, 1, deepest, point_of(last, deepest.weights), true};
          break;
        }
        clearance = apart / 2;
        slack = apart / 4;
        hit = shape.first_hit(moving, clearance, slack);
      }
      if (!hit)
        continue;
      const double s = (static_cast<double>(k) + hit->s) / static_cast<double>(view.pieces());
      if (!first || s < first->s)
        first = FoundHit{triangle, i, s, hit->point, point_of(moving.at(hit->s), hit->point.weights), false};
      break;
    }
  }
  return first;
}

std::vector<FoundHit> find_hits(const StepPath& path, std::span<const SolidView> views,
                                std::span<const std::int32_t> rides, std::span<const std::uint32_t> triangles) {
  std::vector<std::optional<FoundHit>> found(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      found[i] = first_hit(path, views, rides, triangles[i]);
  });
  std::vector<FoundHit> result;
  for (const auto& hit : found)
    if (hit)
      result.push_back(*hit);
  return result;
}

} // namespace sheet::collide
