// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace sheet::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int longest_path = 256; // meetings; Russian roulette ends nearly all paths long before
constexpr int sure_meetings = 4;  // before Russian roulette starts, and
constexpr float faint = 0.1F;     // the weight to which it brings those that are fainter
constexpr float darkness = 1e-3F; // a shadow that lets less through is black

Vec cosine_direction(const Vec& normal, Point2 p) { // density cos / pi [Malley]
  const float radius = std::sqrt(p.x), angle = 2 * pi * p.y;
  return Basis(normal)
      .world(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0F, 1 - p.x)))
      .normalized();
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

std::pair<float, float> range_of(const std::vector<float>& values) {
  float low = 1e30F, high = 0;
  for (const float v : values)
    if (v > 0) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  return high > 0 ? std::pair(low, high) : std::pair(1.0F, 1.0F);
}

} // namespace

// A path on its way.
struct PathTracer::Path {
  Ray ray;
  Colour weight = Colour::Ones();
  bool inside = false;            // in a sheet whose slab has been met already
  int splits = 2;                 // so many mirror images in turn are followed for themselves
  bool straight = true;           // nothing but straight transmission since the camera
  bool indirect = false;          // has left a turbid or matte surface
  std::optional<float> density{}; // of its direction, if a turbid or matte surface chose it [1/sr]
};

// How a ray meets a sheet: normals on the side that it comes from.
struct PathTracer::Meeting {
  bool enters; // from outside
  Vec normal;
  float cosine;
  Meeting(const Hit& hit, const Vec& direction) : enters(direction.dot(hit.face) < 0) {
    const float side = enters ? 1.0F : -1.0F;
    normal = side * hit.normal;
    cosine = -direction.dot(normal);
    if (cosine < 1e-3F) { // seen from behind: interpolated too far
      normal = side * hit.face;
      cosine = -direction.dot(normal);
    }
  }
  // Whether the sheet's slab has been met for a ray that goes on in `direction`.
  [[nodiscard]] bool inside_after(const Hit& hit, const Vec& direction) const {
    return enters && direction.dot(hit.face) < 0;
  }
};

PathTracer::PathTracer(const World& world, const Lighting& lighting, const Liquid& liquid, Surroundings surroundings)
    : world_(&world), lighting_(&lighting), slab_(liquid),
      diffuse_(slab_, range_of(world.surface().thickness).first, range_of(world.surface().thickness).second),
      surroundings_(std::move(surroundings)) {}

Colour PathTracer::radiance(const Ray& ray, Sampler& sampler, std::uint64_t& rays) const {
  Path path;
  path.ray = ray;
  return follow(path, sampler, rays);
}

Colour PathTracer::follow(Path path, Sampler& sampler, std::uint64_t& rays) const {
  Colour light = Colour::Zero();
  for (int meetings = 0; meetings < longest_path;) {
    ++rays;
    const Hit hit = world_->nearest(path.ray);
    const Vec direction = path.ray.direction;
    if (!hit.anything()) {
      if (path.straight)
        return light + path.weight * lighting_->backdrop(direction);
      if (!path.density && path.indirect)
        return light + path.weight * lighting_->softened(direction);
      const Lighting::Light far = lighting_->at(direction);
      const float share = path.density ? *path.density / (*path.density + far.density) : 1.0F;
      return light + path.weight * share * far.radiance;
    }
    if (hit.id == sheet_id && path.inside && world_->surface().closed && direction.dot(hit.face) > 0) {
      path.inside = false;
      path.ray = leave(hit, direction);
      continue;
    }
    light += hit.id == sheet_id ? meet_sheet(hit, path, sampler, rays) : meet_matte(hit, path, sampler, rays);
    const float most = path.weight.maxCoeff();
    if (++meetings > sure_meetings || most < faint) {
      const float survival = std::min(0.97F, most / faint);
      if (!(sampler.number() < survival))
        return light;
      path.weight /= survival;
    }
  }
  return light;
}

Colour PathTracer::meet_sheet(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays) const {
  const Vec direction = path.ray.direction;
  const Meeting meeting(hit, direction);
  const float h = world_->thickness_at(hit);
  const Straight straight = slab_.straight(meeting.cosine, h);
  const Diffuse diffuse = diffuse_.at(h);
  const Vec mirrored = direction - 2 * direction.dot(meeting.normal) * meeting.normal;
  const auto go = [&](Path& p, const Vec& d) {
    p.ray = leave(hit, d);
    p.inside = meeting.inside_after(hit, d);
  };
  Colour light = Colour::Zero();
  enum Lobe { mirror, through, turbid_back, turbid_through };
  std::array<Colour, 4> part = {straight.reflected, straight.transmitted, straight.coupled * diffuse.reflected,
                                straight.coupled * diffuse.transmitted};
  if (path.splits > 0) {
    Path image = path;
    --image.splits;
    path.splits = 0;
    image.weight *= part[mirror];
    image.straight = false;
    image.density.reset();
    go(image, mirrored);
    light += follow(image, sampler, rays);
    part[mirror].setZero();
  }
  std::array<float, 4> chance{};
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += chance[i] = (path.weight * part[i]).sum();
  if (!(sum > 0)) {
    path.weight.setZero();
    return light;
  }
  for (float& c : chance)
    c /= sum;

  const float turbid = chance[turbid_back] + chance[turbid_through];
  if (turbid > 0) {
    const float choice = sampler.number();
    const Lighting::Sample lamp = lighting_->sample(choice, sampler.point());
    const float cosine = lamp.direction.dot(meeting.normal);
    const float lobe = chance[cosine > 0 ? turbid_back : turbid_through] * std::abs(cosine) / pi;
    if (lobe > 0 && lamp.light.density > 0) {
      const Colour out = slab_.straight(std::abs(cosine), h).coupled / diffuse.mean_coupled.max(1e-20F);
      const Colour f = part[cosine > 0 ? turbid_back : turbid_through] * out * (std::abs(cosine) / pi);
      const Colour weight = path.weight * f / (lamp.light.density + lobe);
      if (weight.maxCoeff() > 0)
        light += weight * lamp.light.radiance *
                 visible(hit, lamp.direction, meeting.inside_after(hit, lamp.direction), rays);
    }
  }

  float choice = sampler.number();
  std::size_t lobe = 0;
  while (lobe < 3 && choice >= chance[lobe])
    choice -= chance[lobe++];
  while (chance[lobe] <= 0) // the sum of chances is rounded
    --lobe;
  path.weight *= part[lobe] / chance[lobe];
  if (lobe == through) {
    go(path, direction);
    return light;
  }
  path.straight = false;
  if (lobe == mirror) {
    path.density.reset();
    go(path, mirrored);
    return light;
  }
  const Vec normal = lobe == turbid_back ? meeting.normal : Vec(-meeting.normal);
  const Vec d = cosine_direction(normal, sampler.point());
  const float cosine = std::max(d.dot(normal), 1e-6F);
  path.weight *= slab_.straight(cosine, h).coupled / diffuse.mean_coupled.max(1e-20F);
  path.density = chance[lobe] * cosine / pi;
  path.indirect = true;
  go(path, d);
  return light;
}

Colour PathTracer::meet_matte(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays) const {
  Colour light = Colour::Zero();
  const Vec direction = path.ray.direction;
  const Colour& albedo = hit.id == ground_id || hit.id - first_solid_id >= surroundings_.solids.size()
                             ? surroundings_.ground
                             : surroundings_.solids[hit.id - first_solid_id];
  if (path.straight && hit.plane) {
    const float gone = smooth_step(surroundings_.fade_from, surroundings_.fade_to, hit.position.norm());
    light += path.weight * gone * lighting_->backdrop(direction);
    path.weight *= 1 - gone;
  }
  const float side = direction.dot(hit.face) < 0 ? 1.0F : -1.0F;
  const Vec face = side * hit.face;
  Vec normal = side * hit.normal;
  if (direction.dot(normal) > -1e-3F)
    normal = face;
  path.weight *= albedo;

  const float choice = sampler.number();
  const Lighting::Sample lamp = lighting_->sample(choice, sampler.point());
  const float cosine = lamp.direction.dot(normal);
  if (cosine > 0 && lamp.direction.dot(face) > 0 && lamp.light.density > 0)
    light += path.weight * (cosine / pi / (lamp.light.density + cosine / pi)) * lamp.light.radiance *
             visible(hit, lamp.direction, false, rays);

  Vec d = cosine_direction(normal, sampler.point());
  path.density = std::max(d.dot(normal), 1e-6F) / pi;
  const float below = d.dot(face);
  if (below < 0)
    d = (d - 2 * below * face).normalized();
  path.straight = false;
  path.splits = 0;
  path.indirect = true;
  path.inside = false;
  path.ray = leave(hit, d);
  return light;
}

// What a ray that leaves `hit` brings of the light from infinity: all layers of sheet passed straight.
Colour PathTracer::visible(const Hit& hit, const Vec& direction, bool inside, std::uint64_t& rays) const {
  Colour left = Colour::Ones();
  Ray ray = leave(hit, direction);
  for (int layers = 0; layers < longest_path; ++layers) {
    ++rays;
    const Hit next = world_->nearest(ray);
    if (!next.anything())
      return left;
    if (next.id != sheet_id)
      return Colour::Zero();
    const Meeting meeting(next, direction);
    if (inside && !meeting.enters && world_->surface().closed) {
      inside = false;
    } else {
      left *= slab_.straight(meeting.cosine, world_->thickness_at(next)).transmitted;
      if (left.maxCoeff() < darkness)
        return Colour::Zero();
      inside = meeting.enters;
    }
    ray = leave(next, direction);
  }
  return Colour::Zero();
}

} // namespace sheet::render
