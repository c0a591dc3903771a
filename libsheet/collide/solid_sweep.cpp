// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/solid_sweep.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/collide/touch_distance.h"

namespace sheet::collide {
namespace {

constexpr double least_advance = 0.01; // of a turn of sphere tracing, as part of the offset
constexpr int halvings = 20;           // of that, to find when it meets

// A vertex that starts a piece of its path within the offset and moves out of it touches only what it comes nearer to
// than it was.
double offset_for(const solid::SolidDistance& shape, const Vector3& start, const Vector3& next, double offset) {
  const double reach = offset * (1 + vertex_slack);
  if (shape.distance(start, reach) >= reach)
    return offset;
  const solid::Near near = shape.nearest(start);
  return near.distance > 0 && near.normal.dot(next - start) > 0 ? std::min(offset, 0.9 * near.distance) : offset;
}

// Of a path on which the distance is above `reach` until the part `above` and not at `below`: where it becomes so.
double crossing(const solid::SolidDistance& shape, const Vector3& a, const Vector3& b, double reach, double above,
                double below) {
  for (int halving = 0; halving < halvings && above < below; ++halving) {
    const double middle = 0.5 * (above + below);
    (shape.distance((1 - middle) * a + middle * b, 2 * reach) > reach ? above : below) = middle;
  }
  return below;
}

} // namespace

std::optional<double> first_contact(const solid::SolidDistance& shape, const Vector3& a, const Vector3& b,
                                    double offset) {
  const double travel = (b - a).norm(), reach = offset * (1 + vertex_slack), least = least_advance * offset;
  double s = 0, above = 0;
  for (;;) {
    const double within = reach + least + (1 - s) * travel;
    const double distance = shape.distance((1 - s) * a + s * b, within);
    if (distance <= reach)
      return crossing(shape, a, b, reach, above, s);
    if (distance >= within || s == 1)
      return std::nullopt;
    const double safe = distance - offset, next = std::min(1.0, s + std::max(safe, least) / travel);
    if (next == s) // round-off allows no nearer
      return s;
    above = safe < least ? s : next;
    s = next;
  }
}

std::optional<VertexHit> first_hit(const StepPath& path, std::span<const SolidView> views, std::uint32_t vertex,
                                   double& deepest, std::int32_t rides) {
  std::optional<VertexHit> first;
  const double half = path.half_thickness(vertex);
  const Vector3 &start = path.start[vertex], &end = path.end[vertex];
  solid::Box3 box(start);
  box.extend(end);
  const double reach = half * (1 + vertex_slack), way = (end - start).norm();
  box.min().array() -= reach;
  box.max().array() += reach;
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    const SolidView& view = views[i];
    if (static_cast<std::int32_t>(i) == rides || !view.swept().intersects(box))
      continue;
    Vector3 a = view.own(0, start);
    const double offset = catching_distance(path, view, vertex, a, reach + way);
    deepest = std::min(deepest, view.shape().distance(a, offset));
    for (std::size_t k = 0; k < view.pieces(); ++k) {
      const Vector3 b = view.on_path(k + 1, start, end, false);
      if (const auto s = first_contact(view.shape(), a, b, offset_for(view.shape(), a, b, offset))) {
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

namespace {

// One triangle against one solid.
class TriangleSweep {
public:
  TriangleSweep(const StepPath& path, const SolidView& view, std::uint32_t triangle, std::array<bool, 3> rides)
      : path_(path), view_(view), triangle_(triangle), rides_(rides) {}

  // `half`: of the thickness. `mends`: whether what starts nearer than the clearance must not end so.
  template <class Mends>
  [[nodiscard]] std::optional<FoundHit> first(double half, const Nearness& nearness, const Mends& mends) const {
    const double wanted = nearness.clearance * half;
    double clearance = wanted, slack = nearness.slack * half, keeps = target * half;
    solid::MovingTriangle moving{at(0), at(1)};
    double starts_with = std::numeric_limits<double>::infinity();
    bool mend = false;
    for (std::size_t k = 0; k < view_.pieces(); ++k) {
      if (k > 0)
        moving = {moving.end, at(k + 1)};
      auto hit = view_.shape().first_hit(moving, clearance, slack);
      if (k == 0 && hit && hit->s == 0) {
        starts_with = std::min(clearance, view_.shape().separation(moving.start, clearance, measured * clearance));
        mend = mends();
        if (!mend)
          keeps = std::max(starts_with, least_beside * half);
        if (starts_with == 0)
          return at_end(FoundHit::Kind::across, mend ? clearance : (1 - 2 * measured) * keeps, slack, keeps);
        hit = view_.shape().first_hit(moving, 0.9 * starts_with, 0.05 * starts_with);
        clearance = 0.9 * starts_with;
        slack = 0.05 * starts_with;
      }
      if (!hit)
        continue;
      return FoundHit{FoundHit::Kind::meeting,
                      triangle_,
                      0,
                      (static_cast<double>(k) + hit->s) / static_cast<double>(view_.pieces()),
                      hit->point,
                      solid::point_of(moving.at(hit->s), hit->point.weights),
                      keeps};
    }
    if (starts_with == std::numeric_limits<double>::infinity())
      return std::nullopt;
    const double ends_with = mend ? wanted : starts_with;
    if (view_.shape().separation(moving.end, ends_with, measured * ends_with) < (1 - 2 * measured) * ends_with)
      return at_end(FoundHit::Kind::closing, clearance, slack, keeps);
    return std::nullopt;
  }

private:
  static constexpr double measured = 1e-4; // the part by which separations may be too small

  [[nodiscard]] solid::Triangle3 at(std::size_t k) const {
    solid::Triangle3 result;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = path_.triangles[triangle_][c];
      result[c] = view_.on_path(k, path_.start[v], path_.end[v], rides_[c]);
    }
    return result;
  }

  [[nodiscard]] std::optional<FoundHit> at_end(FoundHit::Kind kind, double clearance, double slack,
                                               double keeps) const {
    const solid::Triangle3 last = at(view_.pieces());
    const solid::TrianglePoint deepest = view_.shape().deepest(last, slack);
    if (kind == FoundHit::Kind::across && deepest.near.distance >= clearance)
      return std::nullopt;
    return FoundHit{kind, triangle_, 0, 1, deepest, solid::point_of(last, deepest.weights), keeps};
  }

  const StepPath& path_;
  const SolidView& view_;
  std::uint32_t triangle_;
  std::array<bool, 3> rides_;
};

} // namespace

std::optional<FoundHit> first_hit(const StepPath& path, std::span<const SolidView> views,
                                  std::span<const std::int32_t> rides, std::uint32_t triangle,
                                  const Nearness& nearness) {
  const Corners& corners = path.triangles[triangle];
  solid::Box3 box;
  double half = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : corners) {
    box.extend(path.start[v]);
    box.extend(path.end[v]);
    half = std::min(half, path.half_thickness(v));
  }
  box.min().array() -= half;
  box.max().array() += half;
  std::optional<FoundHit> first;
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    if (!views[i].swept().intersects(box))
      continue;
    const auto on_this = [&](std::size_t c) { return rides[corners[c]] == static_cast<std::int32_t>(i); };
    const TriangleSweep sweep(path, views[i], triangle, {on_this(0), on_this(1), on_this(2)});
    auto hit = sweep.first(half, nearness, [&] { return nearness.mends && nearness.mends(triangle, i); });
    if (!hit || (first && first->s <= hit->s))
      continue;
    first = hit;
    first->solid = i;
  }
  return first;
}

std::vector<FoundHit> find_hits(const StepPath& path, std::span<const SolidView> views,
                                std::span<const std::int32_t> rides, std::span<const std::uint32_t> triangles,
                                const Nearness& nearness) {
  std::vector<std::optional<FoundHit>> found(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      found[i] = first_hit(path, views, rides, triangles[i], nearness);
  });
  std::vector<FoundHit> result;
  for (const auto& hit : found)
    if (hit)
      result.push_back(*hit);
  return result;
}

} // namespace sheet::collide
