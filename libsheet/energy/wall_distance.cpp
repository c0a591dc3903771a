// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/wall_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/energy/spring_rests.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double longest_rise = 0.1; // of a layer in a step, as part of its edges
constexpr int most_passes = 20;
constexpr int most_layers = 100; // that lie on each other

// Whether all corners of a triangle touch one wall, or turn in the corner of the same two.
bool on_one_wall(const Stage& stage, const Corners& c) {
  if (common_wall(stage, c) != no_index)
    return true;
  const WallSite* first = site_at(stage, c[0]);
  return first != nullptr && std::ranges::all_of(c, [&](std::uint32_t v) {
           const WallSite* site = site_at(stage, v);
           return site != nullptr && (site->wall == first->wall || site->rounded_with == first->wall);
         });
}

// The area of a triangle as the wall sees it that all its corners touch [m²]; 0 where it does not lie on one.
double lying_area(const Stage& stage, const State& end, const Corners& c) {
  if (!on_one_wall(stage, c))
    return 0;
  const auto& x = end.positions;
  const Vector3 whole = 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
  Vector3 normal = Vector3::Zero();
  for (const auto v : c) {
    normal += site_at(stage, v)->normal;
    if (!(std::abs(whole.dot(site_at(stage, v)->normal)) > least_lying_cosine * whole.norm()))
      return 0;
  }
  return std::abs(whole.dot(normal.normalized()));
}

// The distances of vertices at whose ends of an edge both are known (not 0), lowered until none is above another's by
// more than the greatest slope times their way along the wall.
void flatten(const Stage& stage, const State& end, std::vector<double>& distance) {
  const auto lower = [&](const Edge& e, int high) {
    double& own = distance[e[high]];
    const double other = distance[e[1 - high]];
    if (own == 0 || other == 0)
      return false;
    const Vector3 way = end.positions[e[1]] - end.positions[e[0]], &normal = site_at(stage, e[high])->normal;
    const double most = other + greatest_slope * (way - way.dot(normal) * normal).norm();
    return own > most && (own = most, true);
  };
  bool lowered = true;
  for (int pass = 0; pass < most_passes && lowered; ++pass) {
    lowered = false;
    for (const Edge& e : end.mesh->edges)
      for (const int high : {0, 1})
        lowered = lower(e, high) || lowered;
  }
}

// In a rounded corner the distance is the mean of those around, and where none is known that at which each is: what is
// thin there would be drawn into the corner, below what is thick beside it, and be passed by that.
void even_out_in_corners(const std::vector<Wall>& walls, const Stage& stage, const State& end,
                         std::vector<double>& distance) {
  if (std::ranges::all_of(stage.sites, [](const WallSite& site) { return site.rounded_with == no_index; }))
    return;
  std::vector<double> known(distance), sum(distance.size(), 0), count(distance.size(), 0);
  for (const WallSite& site : stage.sites)
    if (known[site.vertex] == 0)
      known[site.vertex] = wall_point(walls, site, end.time, end.positions[site.vertex]).distance;
  for (const auto& [a, b] : end.mesh->edges)
    for (const auto& [at, other] : {std::pair(a, b), std::pair(b, a)})
      if (known[a] > 0 && known[b] > 0) {
        sum[at] += known[other];
        ++count[at];
      }
  for (const WallSite& site : stage.sites)
    if (const auto v = site.vertex; site.rounded_with != no_index && known[v] > 0)
      distance[v] = (known[v] + sum[v]) / (1 + count[v]);
}

// Whether a wall with this normal is so steep that what stands beside it lies on another one alone: not in a groove.
bool bears_nothing(const Vector3& normal, const Vector3& gravity) {
  return std::abs(normal.dot(gravity)) < least_lying_cosine * gravity.norm();
}

// The way on which what stands beside a second wall rises by a metre from its own one [m]: along that wall, or, below
// one that overhangs, straight on, as liquid fills the room there.
Vector3 rise_beside(const WallSite& site) {
  const double cosine = std::max(0.0, site.normal.dot(site.second_normal));
  return (site.normal - cosine * site.second_normal) / (1 - cosine * cosine);
}

// By holds that have nothing to do with walls.
std::vector<char> held_elsewhere(std::vector<Hold> holds, const Stage& stage) {
  std::erase_if(holds, [](const Hold& hold) { return hold.of_wall; });
  return held_unknowns(holds, stage);
}

// By how much vertices rise or sink.
struct Shifts {
  explicit Shifts(std::size_t vertices) : of(vertices, Vector3::Zero()), known(vertices, 0) {}

  // What lies on something that rises goes with it, and by what the distance between the two grows: from the features
  // of contacts that are known to those that are not. Returns whether any was.
  bool pass_on(std::span<const ContactSpring> contacts, std::span<const double> growth) {
    std::vector<Vector3> sum(of.size(), Vector3::Zero());
    std::vector<double> weight(of.size(), 0);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactSpring& s = contacts[i];
      const std::size_t middle = s.second_feature();
      const bool one = knows(s, 0, middle), other = knows(s, middle, 4);
      if (one == other)
        continue;
      const Vector3 apart = growth[i] * s.normal; // of the first feature from the other one
      const Vector3 shift = one ? Vector3(mean(s, 0, middle) - apart) : Vector3(mean(s, middle, 4) + apart);
      for (std::size_t c = one ? middle : 0; c < (one ? 4 : middle); ++c) {
        sum[s.vertices[c]] += std::abs(s.weights[c]) * shift;
        weight[s.vertices[c]] += std::abs(s.weights[c]);
      }
    }
    bool any = false;
    for (std::size_t v = 0; v < of.size(); ++v)
      if (known[v] == 0 && weight[v] > 0) {
        of[v] = sum[v] / weight[v];
        known[v] = 1;
        any = true;
      }
    return any;
  }

  std::vector<Vector3> of; // [m]
  std::vector<char> known;

private:
  [[nodiscard]] bool knows(const ContactSpring& s, std::size_t first, std::size_t last) const {
    return std::any_of(s.vertices.begin() + first, s.vertices.begin() + last,
                       [&](std::uint32_t v) { return known[v] != 0; });
  }

  // Of the corners of a feature that are known, one at least.
  [[nodiscard]] Vector3 mean(const ContactSpring& s, std::size_t first, std::size_t last) const {
    Vector3 sum = Vector3::Zero(), plain = Vector3::Zero();
    double weight = 0, count = 0;
    for (std::size_t c = first; c < last; ++c)
      if (const std::uint32_t v = s.vertices[c]; known[v] != 0) {
        sum += std::abs(s.weights[c]) * of[v];
        weight += std::abs(s.weights[c]);
        plain += of[v];
        ++count;
      }
    return weight > 0 ? Vector3(sum / weight) : Vector3(plain / count);
  }
};

// By how much the rest distances of contacts between layers that flow, and lie on each other, are longer than the
// step's last stage foresaw (spring_rests.h) [m]: sheet-collide makes them what the layers are thick.
std::vector<double> unforeseen_growth(std::span<const ContactSpring> contacts, const Vector3& gravity,
                                      const Stage& stage, const State& end) {
  const auto& triangles = end.mesh->triangles;
  const auto thickness = [&](const std::vector<Vector3>& x) {
    return thickness_around(x.size(), triangles, end.volumes, [&](std::uint32_t t) {
      return TriangleArea(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]).area;
    });
  };
  const std::vector<double> start = thickness(stage.start->positions), now = thickness(end.positions),
                            foreseen = predicted_thickness(stage);
  std::vector<double> growth;
  growth.reserve(contacts.size());
  for (const ContactSpring& s : contacts) {
    const bool lies = std::abs(s.normal.dot(gravity)) > least_lying_cosine * gravity.norm();
    const std::size_t first = s.second_feature();
    const auto own = [&](const std::vector<double>& of) { return s.mean_of_corners(0, first, std::span(of)) / 2; };
    const double part = std::clamp((own(now) - own(foreseen)) / s.mean(start), -longest_rise, longest_rise);
    growth.push_back(lies ? s.rest_of_layers() * part : 0);
  }
  return growth;
}

} // namespace

std::vector<double> lying_thickness(const Stage& stage, const State& end) {
  const auto& triangles = end.mesh->triangles;
  return thickness_around(stage.vertices(), triangles, end.volumes,
                          [&](std::uint32_t t) { return lying_area(stage, end, triangles[t]); });
}

void set_distances_from_walls(const std::vector<Wall>& walls, const std::vector<Hold>& holds,
                              std::span<const ContactSpring> contacts, const Vector3& gravity, const Stage& stage,
                              State& end) {
  if (stage.sites.empty())
    return;
  std::vector<double> distance = lying_thickness(stage, end);
  for (double& d : distance)
    d /= 2;
  for (const Channel& channel : stage.channels)
    distance[channel.vertex] = std::min(distance[channel.vertex], channel.gap / 2);
  flatten(stage, end, distance);
  even_out_in_corners(walls, stage, end, distance);
  const std::vector<char> held = held_elsewhere(holds, stage);
  const Eigen::VectorXd lengths = step_scale(end, static_cast<Eigen::Index>(3 * stage.vertices()));
  Shifts shifts(stage.vertices());
  for (const WallSite& site : stage.sites) {
    shifts.known[site.vertex] = 1;
    const bool corner = site.in_corner;
    if (distance[site.vertex] == 0 || (corner && !(site.beside_upright && bears_nothing(site.across[1], gravity))))
      continue;
    const WallPoint point = wall_point(walls, site, end.time, end.positions[site.vertex]);
    const double most = longest_rise * lengths[3 * static_cast<Eigen::Index>(site.vertex)];
    shifts.of[site.vertex] =
        std::clamp(distance[site.vertex] - point.distance, -most, most) * (corner ? rise_beside(site) : point.normal);
  }
  const std::vector<double> growth = unforeseen_growth(contacts, gravity, stage, end);
  for (int layer = 0; layer < most_layers && shifts.pass_on(contacts, growth); ++layer) {
  }
  for (std::uint32_t v = 0; v < stage.vertices(); ++v)
    if (const Vector3 free = free_of(shifts.of[v], held, v);
        free.squaredNorm() > least_angle * least_angle * shifts.of[v].squaredNorm())
      end.positions[v] += shifts.of[v].squaredNorm() / free.squaredNorm() * free;
}

} // namespace sheet
