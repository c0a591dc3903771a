// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/channels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libsheet/geometry/facing_walls.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double touch = 1.05;     // gaps that a layer fills, in its thicknesses
constexpr double relief = 10;      // of the rate at which walls move
constexpr double least_gap = 0.05; // of the thickness: narrower gaps count as so wide

double gap_of(const WallPoint& own, const WallPoint& other) {
  return gap_between(own.distance, own.normal, other.distance, other.normal);
}

// The wall that faces the site's own one, nearest of those within reach; place, gap and slope are set.
std::optional<Channel> find_channel(const std::vector<Wall>& walls, const Stage& stage, const WallSite& site,
                                    double thickness) {
  const Vector3& x = stage.predicted[site.vertex];
  const double t = stage.end_time;
  std::optional<Channel> found;
  for (std::uint32_t w = 0; w < walls.size(); ++w) {
    if (w == site.wall || (walls[w].beyond && walls[w].beyond(t, x, near_touch * thickness)))
      continue;
    const WallPoint own = walls[site.wall].nearest(t, x), other = walls[w].nearest(t, x);
    const double gap = std::max(gap_of(own, other), least_gap * thickness);
    if (!(gap < near_touch * thickness) || (found && found->gap <= gap))
      continue;
    found.emplace();
    found->vertex = site.vertex;
    found->facing = w;
    found->gap = gap;
    const auto gap_at = [&](double time, const Vector3& place) {
      const double at = gap_of(walls[site.wall].nearest(time, place), walls[w].nearest(time, place));
      return std::max(at, least_gap * thickness);
    };
    found->gap_before = gap_at(stage.start->time, stage.start->positions[site.vertex]);
    if (stage.previous != nullptr)
      found->gap_first = gap_at(stage.start->time + stage.duration, stage.position(*stage.previous, site.vertex));
    found->place = x;
    found->slope = other.normal - own.normal.dot(other.normal) * own.normal;
  }
  return found;
}

Vector3 velocity_at(const Wall& wall, const Stage& stage, std::uint32_t vertex) {
  return wall.velocity ? wall.velocity(stage.start->time, stage.start->positions[vertex]) : Vector3(Vector3::Zero());
}

// Of how the two walls close on what is between them, and slide past each other [1/s].
double rate_at(const std::vector<Wall>& walls, const Stage& stage, const WallSite& site, const Channel& channel) {
  const Vector3 own = velocity_at(walls[site.wall], stage, site.vertex);
  const Vector3 past = velocity_at(walls[channel.facing], stage, site.vertex) - own;
  return std::abs(past.dot(site.normal)) / channel.gap + past.norm() / std::sqrt(stage.channel_area);
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
  return std::clamp((near_touch * thickness - gap) / ((near_touch - touch) * thickness), 0.0, 1.0);
}

void set_channels(const std::vector<Wall>& walls, std::span<const double> thickness,
                  const std::function<Vector3(const Wall&, std::uint32_t vertex)>& carried, Stage& stage) {
  stage.channel_area = stage.channel_rate = 0;
  for (WallSite& site : stage.sites) {
    std::optional<Channel> channel = find_channel(walls, stage, site, thickness[site.vertex]);
    if (!channel)
      continue;
    const Wall& facing = walls[channel->facing];
    const ChannelDrag drag = channel_drag(channel->gap, site.slip_length, facing.slip_length);
    channel->filled = filled_part(thickness[site.vertex], channel->gap);
    channel->depth = drag.depth;
    channel->carried = site.carried + drag.part * (carried(facing, site.vertex) - site.carried);
    site.channel = static_cast<std::uint32_t>(stage.channels.size());
    stage.channels.push_back(*channel);
  }
  if (stage.channels.empty())
    return;
  const std::vector<double> areas = vertex_shares(stage.vertices(), stage.start->mesh->triangles,
                                                  [&](std::uint32_t t) { return stage.raised[t].area(); });
  for (const Channel& channel : stage.channels)
    stage.channel_area += areas[channel.vertex];
  for (const WallSite& site : stage.sites)
    if (const Channel* channel = channel_of(stage, site))
      stage.channel_rate = std::max(stage.channel_rate, relief * rate_at(walls, stage, site, *channel));
}

} // namespace sheet
