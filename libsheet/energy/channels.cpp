// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/channels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/facing_walls.h"
#include "libsheet/geometry/longest_edges.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double relief = 10; // of the rate at which walls move

// Of two walls at a point of time: straight across it or beside an edge of the second one, whichever is narrower.
GapBeside gap_of(const Wall& wall, const Wall& facing, double t, const Vector3& x, double longest_edge, double least) {
  const WallPoint own = wall.nearest(t, x), other = facing.nearest(t, x);
  const GapBeside across{std::max(gap_between(own.distance, own.normal, other.distance, other.normal), least),
                         other.normal - own.normal.dot(other.normal) * own.normal};
  const auto at = [&](const Wall& of) { return [&, t](const Vector3& y) { return of.nearest(t, y); }; };
  const GapBeside beside = gap_beside(x, at(wall), at(facing), longest_edge, least);
  return beside.gap < across.gap ? beside : across;
}

Vector3 velocity_at(const Wall& wall, const Stage& stage, std::uint32_t vertex) {
  return wall.velocity ? wall.velocity(stage.start->time, stage.start->positions[vertex]) : Vector3(Vector3::Zero());
}

// The wall that faces the site's own one, nearest of those within reach; place, gap and slope are set. Within the step
// a gap narrows by no more than twice what the walls and the vertex move: where the two come to face each other,
// as when liquid goes round an edge, it was as narrow before, or what is there would have to be as thin at once.
std::optional<Channel> find_channel(const std::vector<Wall>& walls, const Stage& stage, const WallSite& site,
                                    double thickness, double longest_edge) {
  const Vector3& x = stage.predicted[site.vertex];
  const Vector3 own_velocity = velocity_at(walls[site.wall], stage, site.vertex);
  const double t = stage.end_time, least = least_gap * thickness;
  std::optional<Channel> found;
  for (std::uint32_t w = 0; w < walls.size(); ++w) {
    if (w == site.wall || (walls[w].beyond && walls[w].beyond(t, x, near_touch * thickness + 2 * longest_edge)))
      continue;
    const auto gap_at = [&](double time, const Vector3& place) {
      return gap_of(walls[site.wall], walls[w], time, place, longest_edge, least);
    };
    const auto there = gap_at(t, x);
    const double gap = there.gap;
    const Vector3 slope = there.slope;
    if (!(gap < near_touch * thickness) || (found && found->gap <= gap))
      continue;
    found.emplace();
    found->vertex = site.vertex;
    found->facing = w;
    found->gap = gap;
    const double speed = (velocity_at(walls[w], stage, site.vertex) - own_velocity).norm();
    const auto gap_then = [&](double time, const Vector3& place) {
      double moved = (x - place).norm() + speed * std::abs(t - time);
      for (const Wall* wall : {&walls[site.wall], &walls[w]})
        moved += std::abs(wall->nearest(t, x).distance - wall->nearest(time, place).distance);
      return std::min(gap_at(time, place).gap, gap + 2 * (1 + slope.norm()) * moved);
    };
    found->gap_before = gap_then(stage.start->time, stage.start->positions[site.vertex]);
    if (stage.previous != nullptr)
      found->gap_first = gap_then(stage.start->time + stage.duration, stage.position(*stage.previous, site.vertex));
    found->place = x;
    found->slope = slope;
  }
  return found;
}

// Of how the two walls close on what is between them, and slide past each other [1/s]; not of how they part.
double rate_at(const std::vector<Wall>& walls, const Stage& stage, const WallSite& site, const Channel& channel) {
  const Wall &wall = walls[site.wall], &facing = walls[channel.facing];
  const Vector3 normal = wall.nearest(stage.end_time, channel.place).normal;
  const Vector3 facing_normal = facing.nearest(stage.end_time, channel.place).normal;
  Vector3 past = velocity_at(facing, stage, site.vertex) - velocity_at(wall, stage, site.vertex);
  past -= std::max(0.0, past.dot(normal)) * normal;
  past -= std::min(0.0, past.dot(facing_normal)) * facing_normal;
  return std::abs(past.dot(normal)) / channel.gap + past.norm() / channel.diameter;
}

// 4 S/P of each region in which vertices between walls hang together: S is their shares of the area, and P how long the
// line is that goes round them half-way to the others, and along the rim.
void set_hydraulic_diameters(Stage& stage) {
  const Connectivity& mesh = *stage.start->mesh;
  const auto& x = stage.predicted;
  std::vector<std::uint8_t> between(mesh.vertices, 0);
  for (const Channel& channel : stage.channels)
    between[channel.vertex] = 1;
  const std::vector<double> shares =
      vertex_shares(mesh.vertices, mesh.triangles, [&](std::uint32_t t) { return stage.raised[t].area(); });
  DisjointSets regions(mesh.vertices);
  std::vector<double> area(mesh.vertices, 0), round(mesh.vertices, 0); // at a vertex of the region
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    if (between[a] != 0 && between[b] != 0)
      regions.join(a, b);
    if (mesh.on_rim(e))
      for (const std::uint32_t v : {a, b})
        round[v] += (x[a] - x[b]).norm() / 2;
  }
  // Between the middles of two sides of a triangle the line is half as long as the third.
  for (const Corners& c : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::uint32_t alone = c[i], one = c[(i + 1) % 3], other = c[(i + 2) % 3];
          between[one] == between[other] && between[alone] != between[one])
        round[between[alone] != 0 ? alone : one] += (x[one] - x[other]).norm() / 2;
  std::vector<double> perimeter(mesh.vertices, 0); // of the region, at the vertex that stands for it
  for (const Channel& channel : stage.channels) {
    const std::uint64_t region = regions.find(channel.vertex);
    area[region] += shares[channel.vertex];
    perimeter[region] += round[channel.vertex];
  }
  for (Channel& channel : stage.channels) {
    const std::uint64_t region = regions.find(channel.vertex);
    channel.diameter = 4 * area[region] / perimeter[region];
  }
}

} // namespace

ChannelDrag channel_drag(double gap, double slip, double facing_slip) {
  if (slip == free_slip && facing_slip == free_slip)
    return {free_slip, 0.5};
  if (facing_slip == free_slip)
    return {gap + 3 * slip, 0};
  if (slip == free_slip)
    return {gap + 3 * facing_slip, 1};
  const double s = (slip + facing_slip) / gap, p = slip * facing_slip / (gap * gap);
  return {gap * (1 + 4 * s + 12 * p) / (4 * (1 + s)), (0.5 * gap + slip) / (gap + slip + facing_slip)};
}

double filled_part(double thickness, double gap) {
  return std::clamp((near_touch * thickness - gap) / ((near_touch - filled_gap) * thickness), 0.0, 1.0);
}

void set_channels(const std::vector<Wall>& walls, std::span<const double> thickness,
                  const std::function<Vector3(const Wall&, std::uint32_t vertex)>& carried, Stage& stage) {
  stage.channel_rate = 0;
  const std::vector<double> edges = longest_edges(stage.start->positions, stage.start->mesh->triangles);
  for (WallSite& site : stage.sites) {
    std::optional<Channel> channel = find_channel(walls, stage, site, thickness[site.vertex], edges[site.vertex]);
    if (!channel)
      continue;
    const Wall& facing = walls[channel->facing];
    const ChannelDrag drag = channel_drag(channel->gap, site.slip_length, facing.slip_length);
    channel->filled = filled_part(thickness[site.vertex], channel->gap);
    channel->depth = drag.depth;
    channel->facing_part = drag.part;
    channel->carried = site.carried + drag.part * (carried(facing, site.vertex) - site.carried);
    site.channel = static_cast<std::uint32_t>(stage.channels.size());
    stage.channels.push_back(*channel);
  }
  if (stage.channels.empty())
    return;
  set_hydraulic_diameters(stage);
  for (const WallSite& site : stage.sites)
    if (const Channel* channel = channel_of(stage, site))
      stage.channel_rate = std::max(stage.channel_rate, relief * rate_at(walls, stage, site, *channel));
}

} // namespace sheet
