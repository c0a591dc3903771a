// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/drop_landing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "libsheet/collide/bath_cover.h"
#include "libsheet/collide/solid_sweep.h"
#include "libsheet/collide/swept_pair.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/box_tree.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {

using formats::Frame;

namespace {

constexpr double closing = 0.5; // of the distance at which something too near starts: nearer is a meeting

// What a drop meets first, after the part s of the step.
struct Meeting {
  double s = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = no_index; // of the sheet
  std::size_t solid = 0;             // else; as many as there are: the bath
  Vector3 place = Vector3::Zero();   // the drop's middle there, in the solid's frame
  [[nodiscard]] bool any() const { return s <= 1; }
};

// The way of a drop's middle in the step.
struct DropWay {
  Vector3 start, end;
  double radius;
};

// The sheet on its way through the step.
class SweptSheet {
public:
  SweptSheet(const Frame& frame, std::span<const Vector3> start)
      : corners_(triangles(frame)), start_(start), end_(positions(frame)) {
    const auto volume = volumes(frame);
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      const Corners& c = corners_[t];
      const double area = TriangleArea(end_[c[0]], end_[c[1]], end_[c[2]]).area;
      half_.push_back(area > 0 ? volume[t] / area / 2 : 0);
    }
  }

  // For each way the first triangle that it meets; of several at once the one with the least number.
  [[nodiscard]] std::vector<Meeting> first(std::span<const DropWay> ways) const {
    std::vector<Meeting> found(ways.size());
    for (const auto& [way, t] : near(ways))
      if (const auto s = meets(ways[way], t); s && *s < found[way].s) {
        found[way].s = *s;
        found[way].triangle = t;
      }
    return found;
  }

  // How a drop meets a triangle first.
  struct Touch {
    std::array<double, 3> weights; // of the corners, at the triangle's nearest point
    Vector3 offset;                // from there to the drop's middle, then [m]
    Vector3 foot;                  // that point at the end of the step
  };
  [[nodiscard]] Touch touch(const DropWay& way, const Meeting& meeting) const {
    const Corners& c = corners_[meeting.triangle];
    const auto then = [&](const Vector3& a, const Vector3& b) { return Vector3((1 - meeting.s) * a + meeting.s * b); };
    const auto corner = [&](std::uint32_t v) { return then(start_[v], end_[v]); };
    const ClosestPoints closest =
        closest_vertex_triangle({then(way.start, way.end), corner(c[0]), corner(c[1]), corner(c[2])});
    const std::array<double, 3> w{-closest.weights[1], -closest.weights[2], -closest.weights[3]};
    return {w, closest.offset, w[0] * end_[c[0]] + w[1] * end_[c[1]] + w[2] * end_[c[2]]};
  }

private:
  // Ways and triangles that may meet, ascending.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> near(std::span<const DropWay> ways) const {
    const auto n = static_cast<std::uint32_t>(corners_.size());
    std::vector<Box> boxes(n + ways.size());
    for (std::uint32_t t = 0; t < n; ++t)
      for (const std::uint32_t v : corners_[t]) {
        boxes[t].add(start_[v], half_[t]);
        boxes[t].add(end_[v], half_[t]);
      }
    for (std::size_t i = 0; i < ways.size(); ++i) {
      boxes[n + i].add(ways[i].start, ways[i].radius);
      boxes[n + i].add(ways[i].end, ways[i].radius);
    }
    std::vector<std::uint8_t> are_ways(boxes.size(), 0);
    std::fill(are_ways.begin() + n, are_ways.end(), std::uint8_t{1});
    BoxTree tree;
    tree.build(std::vector<QuickBox>(boxes.begin(), boxes.end()));
    std::vector<std::vector<std::array<std::uint32_t, 2>>> of_chunk(tree.chunks());
    tree.for_overlaps(are_ways, [&](std::size_t chunk, std::uint32_t i, std::uint32_t j) {
      if (std::min(i, j) < n)
        of_chunk[chunk].push_back({std::max(i, j) - n, std::min(i, j)});
    });
    std::vector<std::array<std::uint32_t, 2>> all;
    for (const auto& pairs : of_chunk)
      all.insert(all.end(), pairs.begin(), pairs.end());
    std::ranges::sort(all);
    return all;
  }

  [[nodiscard]] std::optional<double> meets(const DropWay& way, std::uint32_t t) const {
    const Corners& c = corners_[t];
    const std::array<Vector3, 4> start{way.start, start_[c[0]], start_[c[1]], start_[c[2]]};
    const double distance = closest_vertex_triangle(start).offset.norm(), touching = way.radius + half_[t];
    return first_contact({Features::vertex_triangle, start, {way.end, end_[c[0]], end_[c[1]], end_[c[2]]}},
                         {.gap = distance > touching ? touching : closing * distance});
  }

  std::span<const Corners> corners_;
  std::span<const Vector3> start_, end_;
  std::vector<double> half_; // of the thickness
};

// What drops come to lie on, in the step from `start` to `end` [s]. solids: null for none.
class Grounds {
public:
  Grounds(const Frame& frame, const Scene& scene, const solid::Solids* solids, double start)
      : scene_(scene), solids_(solids), start_(start), end_(frame.time) {
    if (has_bath())
      cover_.emplace(frame, up(), scene.environment.bath->level);
  }

  [[nodiscard]] bool bears(const Drop& drop) const { return !drop.flies() && drop.touch <= count() + has_bath(); }

  // Ways are straight as a solid sees them between its two poses.
  [[nodiscard]] Meeting first(const DropWay& way) const {
    Meeting found;
    for (std::size_t i = 0; i < count(); ++i) {
      const Vector3 a = solids_->pose(i, start_).inverse() * way.start, b = solids_->pose(i, end_).inverse() * way.end;
      const double distance = solids_->shape(i).nearest(a).distance;
      const auto s =
          distance > 0 ? first_contact(solids_->shape(i), a, b, distance > way.radius ? way.radius : closing * distance)
                       : std::optional(0.0);
      if (s && *s < found.s) {
        found.s = *s;
        found.solid = i;
        found.place = (1 - *s) * a + *s * b;
      }
    }
    if (const auto s = meets_bath(way); s && *s < found.s)
      found = {.s = *s, .solid = count(), .place = (1 - *s) * way.start + *s * way.end};
    return found;
  }

  // Puts a drop there that has met something.
  void settle(Drop& drop, const Meeting& meeting) const {
    drop.touch = static_cast<std::uint32_t>(meeting.solid + 1);
    if (meeting.solid < count())
      return place(drop, meeting.solid, meeting.place);
    drop.position = meeting.place;
    drop.velocity.setZero();
  }

  // Takes one along that lies on something, from where it was.
  void carry(Drop& drop, const Vector3& from) const {
    const std::size_t i = drop.touch - 1;
    if (i >= count())
      return;
    const Vector3 own = solids_->pose(i, start_).inverse() * from;
    const Vector3 normal = solids_->pose(i, end_).linear() * solids_->shape(i).nearest(own).normal;
    const Vector3 belt = (end_ - start_) * solids_->belt_velocity(i, normal);
    place(drop, i, own + solids_->pose(i, end_).linear().transpose() * belt);
  }

private:
  [[nodiscard]] std::size_t count() const { return solids_ == nullptr ? 0 : solids_->size(); }
  [[nodiscard]] bool has_bath() const { return scene_.environment.bath.has_value(); }
  [[nodiscard]] Vector3 up() const { return scene::up(scene_.environment).value_or(Vector3::UnitY()); }

  [[nodiscard]] std::optional<double> meets_bath(const DropWay& way) const {
    if (!has_bath())
      return std::nullopt;
    const double level = scene_.environment.bath->level + way.radius;
    const double above = up().dot(way.start) - level, at_end = up().dot(way.end) - level;
    if (at_end > 0)
      return std::nullopt;
    const double s = above > 0 ? above / (above - at_end) : 0;
    return cover_->under((1 - s) * way.start + s * way.end) ? std::nullopt : std::optional(s);
  }

  // As far out as its radius; own: in the solid's frame.
  void place(Drop& drop, std::size_t i, const Vector3& own) const {
    const solid::Near near = solids_->shape(i).nearest(own);
    drop.position = solids_->pose(i, end_) * (own + (drop.radius() - near.distance) * near.normal);
    drop.velocity = solids_->at(i, drop.position, end_).velocity;
  }

  const Scene& scene_;
  const solid::Solids* solids_;
  double start_, end_;
  std::optional<BathCover> cover_; // where there is a bath
};

// The sheet at the end of the step, as it takes drops up, or stops them.
class Receiver {
public:
  Receiver(Frame& frame, const FrameLiquids& liquids)
      : frame_(frame), liquids_(liquids), mesh_(connect(frame.vertices, triangles(std::as_const(frame)))),
        carried_(vertex_shares(frame.vertices, mesh_.triangles,
                               [&](std::uint32_t t) { return volumes(std::as_const(frame))[t]; })),
        mass_(vertex_shares(frame.vertices, mesh_.triangles, [&](std::uint32_t t) {
          return weight(liquids.density(t)) * volumes(std::as_const(frame))[t];
        })) {}

  // Its liquid and its momentum go to the triangle that it hits, and to those around the foot of the drop there.
  void take_up(const Drop& drop, std::uint32_t hit, const Vector3& foot) {
    const std::vector<std::uint32_t> into = wetted(drop, hit, foot);
    double whole = 0, left = drop.volume;
    for (const std::uint32_t t : into)
      whole += area(t);
    for (const std::uint32_t t : into) {
      const double part = t == into.back() ? left : drop.volume * (whole > 0 ? area(t) / whole : 0);
      left -= part;
      add(drop, part, t);
    }
  }

  // One that the sheet does not take up: both go on at one speed, as if they had stuck together for a moment, and the
  // drop is where it touches.
  void stop(Drop& drop, std::uint32_t hit, const SweptSheet::Touch& touch) {
    constexpr double clear = 1e-3; // of the distance of the two middles
    const Corners& c = mesh_.triangles[hit];
    const auto u = velocities(frame_);
    const double own = weight(liquids_.all()[drop.liquid].density) * drop.volume;
    Vector3 speed = Vector3::Zero();
    double yields = 1 / own;
    for (std::size_t i = 0; i < 3; ++i) {
      speed += touch.weights[i] * u[c[i]];
      yields += touch.weights[i] * touch.weights[i] / mass_[c[i]];
    }
    const Vector3 impulse = (drop.velocity - speed) / yields;
    for (std::size_t i = 0; i < 3; ++i)
      u[c[i]] += touch.weights[i] / mass_[c[i]] * impulse;
    drop.velocity -= impulse / own;
    drop.position = touch.foot + (1 + clear) * touch.offset;
  }

private:
  static double weight(double density) { return density > 0 ? density : 1; }

  [[nodiscard]] double area(std::uint32_t t) const {
    const Corners& c = mesh_.triangles[t];
    const auto x = positions(std::as_const(frame_));
    return TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  }

  // The triangle and those around it, across edges, whose middles are within the drop's radius of the place.
  [[nodiscard]] std::vector<std::uint32_t> wetted(const Drop& drop, std::uint32_t hit, const Vector3& place) const {
    std::vector<std::uint32_t> found{hit};
    const auto x = positions(std::as_const(frame_));
    const auto near = [&](std::uint32_t t) {
      const Corners& c = mesh_.triangles[t];
      return ((x[c[0]] + x[c[1]] + x[c[2]]) / 3 - place).norm() < drop.radius();
    };
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const std::uint32_t e : mesh_.triangle_edges[found[i]])
        for (const std::uint32_t t : mesh_.edge_triangles[e])
          if (t != no_index && near(t) && std::ranges::find(found, t) == found.end())
            found.push_back(t);
    return found;
  }

  // Gives a part of the drop's volume to a triangle.
  void add(const Drop& drop, double part, std::uint32_t t) {
    const auto volume = volumes(frame_);
    const auto u = velocities(frame_);
    for (formats::Array& array : frame_.arrays)
      if (array.transfer == formats::Transfer::mean && array.type == formats::Type::float64) {
        const auto values = array.values<double>().subspan(t * array.components, array.components);
        const double of_drop = array.name == "temperature" ? drop.temperature : 0; // what drops have none of is 0
        for (double& value : values)
          value = (volume[t] * value + part * of_drop) / (volume[t] + part);
      }
    volume[t] += part;
    for (const std::uint32_t c : mesh_.triangles[t]) {
      u[c] = (carried_[c] * u[c] + part / 3 * drop.velocity) / (carried_[c] + part / 3);
      carried_[c] += part / 3;
      mass_[c] += weight(liquids_.density(t)) * part / 3;
    }
  }

  Frame& frame_;
  const FrameLiquids& liquids_;
  Connectivity mesh_;
  std::vector<double> carried_, mass_; // at each vertex [m³], [kg]
};

} // namespace

Landed& Landed::operator+=(const Landed& later) {
  on_solids += later.on_solids;
  on_sheet += later.on_sheet;
  volume += later.volume;
  return *this;
}

Landed land_drops(Frame& frame, const Scene& scene, const solid::Solids* solids) {
  Landed landed;
  const formats::Array *starts = frame.find("drop_start_position"), *sheet_start = frame.find("start_position");
  if (starts == nullptr || sheet_start == nullptr || starts->rows == 0)
    return landed;
  std::vector<Drop> drops = read_drops(frame), left;
  const Grounds grounds(std::as_const(frame), scene, solids, number(frame, "start_time", frame.time));
  std::vector<DropWay> ways;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Vector3& from = starts->values<Vector3>()[i];
    if (grounds.bears(drops[i]))
      grounds.carry(drops[i], from);
    ways.push_back({from, drops[i].position, drops[i].radius()});
  }
  const FrameLiquids liquids(scene, frame);
  const SweptSheet sheet(std::as_const(frame), sheet_start->values<Vector3>());
  const std::vector<Meeting> with_sheets = sheet.first(ways);
  std::optional<Receiver> receiver; // once it is asked for
  for (std::size_t i = 0; i < drops.size(); ++i) {
    Drop& drop = drops[i];
    const Meeting& with_sheet = with_sheets[i];
    const Meeting with_solid = grounds.bears(drop) ? Meeting{} : grounds.first(ways[i]);
    if (with_sheet.any() && with_sheet.s <= with_solid.s) {
      if (!receiver)
        receiver.emplace(frame, liquids);
      const SweptSheet::Touch touch = sheet.touch(ways[i], with_sheet);
      if (liquids.number(with_sheet.triangle) == drop.liquid) {
        receiver->take_up(drop, with_sheet.triangle, touch.foot);
        ++landed.on_sheet;
        landed.volume += drop.volume;
      } else {
        receiver->stop(drop, with_sheet.triangle, touch);
        left.push_back(drop);
      }
      continue;
    }
    if (with_solid.any()) {
      grounds.settle(drop, with_solid);
      ++landed.on_solids;
    }
    left.push_back(drop);
  }
  write_drops(frame, left);
  return landed;
}

} // namespace sheet::collide
