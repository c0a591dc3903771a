// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "libsheet/render/microfacets.h"

namespace sheet::render {
namespace {

constexpr int longest_path = 256;    // meetings; Russian roulette ends nearly all paths long before
constexpr int most_passed = 4096;    // faces within the liquid, so that no ray hangs where they coincide
constexpr int sure_meetings = 4;     // before Russian roulette starts, and
constexpr float faint = 0.1F;        // the weight to which it brings those that are fainter
constexpr int longest_look = 16;     // layers that features are looked for behind
constexpr float middle = 0.5F;       // of what paths bridge, for those that are looked along
constexpr float faint_lamp = 0.05F;  // in mean radiances: shadow rays for less are left to chance
constexpr float most_by_chance = 30; // in mean radiances: what one path of chance may bring, against specks
constexpr float darkness = 1e-3F;    // a shadow that lets less through is black

Vec cosine_direction(const Vec& normal, Point2 p) { // density cos / pi [Malley]
  const float radius = std::sqrt(p.x), angle = 2 * float_pi * p.y;
  return Basis(normal)
      .world(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0F, 1 - p.x)))
      .normalized();
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

// Nothing is mirrored into a face: what would be goes off beside it.
Vec beside(const Hit& hit, const Vec& direction, const Vec& image) {
  const float below = image.dot(hit.face);
  return below * direction.dot(hit.face) <= 0 ? image : (image - 2 * below * hit.face).normalized();
}

// A direction in the mirror image of a rough face, with its density if the lights' samples may go there too.
std::pair<Vec, std::optional<float>> mirrored_in(const RoughMirror& rough, const Hit& hit, const Vec& direction,
                                                 Point2 p) {
  const Vec image = rough.sample(p), kept = beside(hit, direction, image);
  return {kept, kept == image ? std::optional(rough.density(image)) : std::nullopt};
}

// The part of the light that a clear coat of index 1.5 mirrors.
float coat_mirrors(float cosine) {
  const Fresnel f = fresnel(cosine, 1.5F);
  return 0.5F * (f.perpendicular + f.parallel);
}

// Ways on from a slab.
enum Way : std::size_t { mirror, through, turbid_back, turbid_through };

// With which a path of that weight takes each; all 0 if nothing is left.
std::array<float, 4> chances(const Colour& weight, const std::array<Colour, 4>& part) {
  std::array<float, 4> chance{};
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += chance[i] = (weight * part[i]).sum();
  for (float& c : chance)
    c = sum > 0 ? c / sum : 0;
  return chance;
}

std::size_t choose(const std::array<float, 4>& chance, float choice) {
  std::size_t lobe = 0;
  while (lobe < 3 && choice >= chance[lobe])
    choice -= chance[lobe++];
  while (lobe > 0 && chance[lobe] <= 0) // the sum of chances is rounded
    --lobe;
  return lobe;
}

} // namespace

// A path on its way.
struct PathTracer::Path {
  FacesAhead ahead;
  Colour weight = Colour::Ones();
  Within within;                  // a sheet whose slab has been met already
  int passed = 0;                 // faces within it
  std::size_t layer = 0;          // of Light::chance
  int splits = 2;                 // so many mirror images in turn are followed for themselves
  bool straight = true;           // nothing but straight transmission since the camera
  bool certain = true;            // no random decision so far
  bool indirect = false;          // has left a turbid or matte surface
  std::optional<float> density{}; // of its direction, if a turbid or matte surface chose it [1/sr]
};

// How a ray meets a sheet: normals on the side that it comes from.
struct PathTracer::Meeting {
  bool enters; // from outside
  Vec normal;
  float cosine;
  Meeting(const Hit& hit, const Vec& smooth_normal, const Vec& direction) : enters(direction.dot(hit.face) < 0) {
    const float side = enters ? 1.0F : -1.0F;
    normal = side * smooth_normal;
    cosine = -direction.dot(normal);
    if (cosine < 1e-3F) { // seen from behind: interpolated too far
      normal = side * hit.face;
      cosine = -direction.dot(normal);
    }
  }
  // The direction that a ray is refracted to [Snell], straight on where the smooth normal would lead it elsewhere, and
  // the cosine of its angle with the normal.
  [[nodiscard]] std::pair<Vec, float> refracted(const Hit& hit, const Vec& direction, float index) const {
    const float inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
    const Vec way = (direction / index + (cosine / index - inside) * normal).normalized();
    return way.dot(hit.face) * direction.dot(hit.face) > 0 ? std::pair(way, inside) : std::pair(direction, cosine);
  }
};

// What a slab does to a path that meets it.
struct PathTracer::Crossing {
  Meeting meeting;
  float thickness;
  Colour mean_coupled;
  Vec mirrored;               // the direction
  Colour coupled;             // Straight::coupled
  std::array<Colour, 4> part; // of the light, by way
  bool by_chance;             // it does something else to paths that bridge other gaps
};

PathTracer::PathTracer(const World& world, const Lighting& lighting, const std::vector<Liquid>& liquids,
                       Surroundings surroundings, Body body)
    : world_(&world), lighting_(&lighting), body_(std::move(body)), surroundings_(std::move(surroundings)) {
  const auto [thinnest, thickest] = range_of(world.surface().thickness);
  for (const Liquid& liquid : liquids) {
    const Slab slab(liquid);
    optics_.push_back({slab, DiffuseTable(slab, thinnest, body_.deepest(thickest))});
  }
}

// `number` of [0, 1) decides which gaps between layers the path bridges.
PathTracer::Path PathTracer::start(const Ray& ray, float number) const {
  Path path;
  path.ahead = {*world_, ray, Looks::straight};
  path.within.bridged = Body::bridged(number);
  return path;
}

Light PathTracer::radiance(const Ray& ray, Sampler& sampler, std::uint64_t& rays) const {
  ++rays;
  return radiance(ray, world_->nearest(ray), sampler, rays);
}

Light PathTracer::radiance(const Ray& ray, const Hit& first, Sampler& sampler, std::uint64_t& rays) const {
  Path path = start(ray, body_.has_layers_that_touch() ? sampler.number() : middle);
  if (first.anything())
    path.ahead = {*world_, leave(first, ray.direction), Looks::straight};
  Light light;
  follow(path, first, sampler, rays, light);
  return light;
}

// Takes that out of a path which another background will bring.
void PathTracer::uncover(Path& path) const {
  if (surroundings_.cut_out && path.straight)
    path.weight -= path.weight.minCoeff();
}

// The light from infinity at the end of a path.
Colour PathTracer::from_afar(Path& path) const {
  const Vec& direction = path.ahead.ray().direction;
  uncover(path);
  if (path.straight)
    return path.weight * lighting_->backdrop(direction);
  if (!path.density && path.indirect)
    return path.weight * lighting_->softened(direction);
  const Lighting::Light far = lighting_->at(direction);
  const float share = path.density ? *path.density / (*path.density + far.density) : 1.0F;
  const Colour light = path.weight * share * far.radiance;
  return path.certain ? light : bounded(light);
}

// Of a path of chance, which may be one of few that are as bright.
Colour PathTracer::bounded(const Colour& light) const {
  const float most = most_by_chance * lighting_->mean(), brightest = light.maxCoeff();
  return brightest <= most ? light : Colour(most / brightest * light);
}

// Goes on past a face within the liquid that the path has met already.
bool PathTracer::passes(const Face& face, Path& path) const {
  path.certain = path.certain && !Body::is_by_chance(face, path.ahead.ray().direction, path.within);
  if (path.passed >= most_passed || !body_.passes(*world_, face, path.ahead.ray().direction, path.within))
    return false;
  ++path.passed;
  return true;
}

// Where a path meets something next; nothing at its end.
Hit PathTracer::next_met(Path& path, std::uint64_t& rays) const {
  for (;;)
    if (const Face face = path.ahead.next(rays); !passes(face, path))
      return path.ahead.hit(face);
}

void PathTracer::follow(Path path, const Hit& first, Sampler& sampler, std::uint64_t& rays, Light& light) const {
  Hit hit = first;
  for (int meetings = 0; meetings < longest_path; hit = next_met(path, rays)) {
    if (!hit.anything()) {
      light.of(path.certain, path.layer) += from_afar(path);
      return;
    }
    if (hit.id == sheet_id)
      meet_sheet(hit, path, sampler, rays, light);
    else
      meet_matte(hit, path, sampler, rays, light);
    const float most = path.weight.maxCoeff();
    if (!(most > 0))
      return;
    if (++meetings; !path.certain && (meetings > sure_meetings || most < faint)) {
      const float survival = std::min(0.97F, most / faint);
      if (!(sampler.number() < survival))
        return;
      path.weight /= survival;
    }
  }
}

// Where layers have melted together the normal may lean far from the surface: that does not make it a mirror.
PathTracer::Meeting PathTracer::meet(const Hit& hit, const Vec& direction) const {
  Meeting meeting(hit, body_.normal_at(*world_, hit), direction);
  if (body_.touches(hit))
    meeting.cosine = std::max(meeting.cosine, Meeting(hit, hit.normal, direction).cosine);
  return meeting;
}

// Of the slab that a ray meets.
Depth PathTracer::depth(const Hit& hit, const Meeting& meeting, const Vec& direction, float bridged,
                        std::uint64_t& rays) const {
  if (!body_.touches(hit)) {
    const float h = world_->thickness_at(hit);
    return {h, {{{1, h}}}, 1};
  }
  const auto [way, cosine] = meeting.refracted(hit, direction, optics(hit).slab.liquid().index);
  return body_.depth(*world_, hit, way, cosine, bridged, rays);
}

// The direction of the mirror image. Where layers have melted together their surface is less smooth than its normal,
// which would send some of it into the liquid: that goes up beside the face, unless the sheet's own normal sends it
// there too, as at sharp folds.
Vec PathTracer::mirrored(const Hit& hit, const Meeting& meeting, const Vec& direction) const {
  const auto image_by = [&](const Vec& normal) -> Vec { return direction - 2 * direction.dot(normal) * normal; };
  const auto goes_in = [&](const Vec& image) { return image.dot(hit.face) * direction.dot(hit.face) > 0; };
  const Vec image = image_by(meeting.normal);
  if (!body_.touches(hit) || !goes_in(image) || goes_in(image_by(hit.normal)))
    return image;
  return (image - 2 * image.dot(hit.face) * hit.face).normalized();
}

// The mirror image is what it is to all paths on average, so that it is certain.
PathTracer::Crossing PathTracer::cross(const Hit& hit, const Path& path, std::uint64_t& rays) const {
  const Vec& direction = path.ahead.ray().direction;
  const Meeting meeting = meet(hit, direction);
  const Depth depths = depth(hit, meeting, direction, path.within.bridged, rays);
  const float h = depths.thickness;
  const Straight straight = optics(hit).slab.straight(meeting.cosine, h);
  const Diffuse diffuse = optics(hit).diffuse.at(h);
  Colour reflected = straight.reflected;
  if (depths.parts > 1) {
    reflected.setZero();
    for (int i = 0; i < depths.parts; ++i) {
      const auto [share, thickness] = depths.of_all[static_cast<std::size_t>(i)];
      reflected += share * optics(hit).slab.straight(meeting.cosine, thickness).reflected;
    }
  }
  return {
      meeting,
      h,
      diffuse.mean_coupled.max(1e-20F),
      mirrored(hit, meeting, direction),
      straight.coupled,
      {reflected, straight.transmitted, straight.coupled * diffuse.reflected, straight.coupled * diffuse.transmitted},
      depths.parts > 1};
}

// Sends a path on from a meeting with a sheet.
void PathTracer::go(const Hit& hit, const Meeting& meeting, const Vec& direction, Path& path) const {
  path.ahead = {*world_, leave(hit, direction)};
  path.within = body_.after(*world_, hit, direction, meeting.enters, path.within.bridged);
}

// Sends it straight on.
void PathTracer::go_on(const Hit& hit, const Meeting& meeting, Path& path) const {
  path.within = body_.after(*world_, hit, path.ahead.ray().direction, meeting.enters, path.within.bridged);
}

// Takes the mirror image out of a path, to be followed for itself.
PathTracer::Path PathTracer::split(const Hit& hit, Crossing& crossing, Path& path) const {
  Path image = path;
  --image.splits;
  image.layer = 1;
  path.splits = 0;
  image.weight *= crossing.part[mirror];
  image.straight = false;
  image.density.reset();
  go(hit, crossing.meeting, crossing.mirrored, image);
  crossing.part[mirror].setZero();
  return image;
}

void PathTracer::meet_sheet(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays, Light& light) const {
  const Vec direction = path.ahead.ray().direction;
  Crossing crossing = cross(hit, path, rays);
  const Meeting& meeting = crossing.meeting;
  const RoughMirror rough(meeting.normal, direction, optics(hit).slab.liquid().roughness);
  std::optional<float> density; // of the mirror image
  if (optics(hit).is_rough())
    std::tie(crossing.mirrored, density) = mirrored_in(rough, hit, direction, sampler.point());
  if (path.splits > 0) {
    const Colour mirrored = path.weight * crossing.part[mirror];
    Path image = split(hit, crossing, path);
    if (optics(hit).is_rough()) {
      light.chance[image.layer] += lamp_mirrored(hit, image, mirrored, rough, 1, sampler, rays);
      image.certain = false;
      image.density = density;
    }
    const Hit first = next_met(image, rays);
    follow(image, first, sampler, rays, light);
  }
  const std::array<float, 4> chance = chances(path.weight, crossing.part);
  if (optics(hit).is_rough() && chance[mirror] > 0) {
    Path image = path;
    go(hit, meeting, crossing.mirrored, image);
    light.chance[path.layer] +=
        lamp_mirrored(hit, image, path.weight * crossing.part[mirror], rough, chance[mirror], sampler, rays);
  }
  if (chance[turbid_back] + chance[turbid_through] > 0)
    light.chance[path.layer] += lamp_at_sheet(hit, path, crossing, chance, sampler, rays);
  const std::size_t lobe = choose(chance, sampler.number());
  if (!(chance[lobe] > 0)) {
    path.weight.setZero();
    return;
  }
  path.certain = path.certain && !crossing.by_chance && lobe == through && chance[lobe] == 1;
  path.weight *= crossing.part[lobe] / chance[lobe];
  if (lobe == through) {
    go_on(hit, meeting, path);
    return;
  }
  path.straight = false;
  if (lobe == mirror) {
    path.density = density ? std::optional(chance[mirror] * *density) : std::nullopt;
    go(hit, meeting, crossing.mirrored, path);
    return;
  }
  const Vec d = cosine_direction(lobe == turbid_back ? meeting.normal : Vec(-meeting.normal), sampler.point());
  const float cosine = std::max(std::abs(d.dot(meeting.normal)), 1e-6F);
  path.weight *= optics(hit).slab.straight(cosine, crossing.thickness).coupled / crossing.mean_coupled;
  path.density = chance[lobe] * cosine / float_pi;
  path.indirect = true;
  go(hit, meeting, d, path);
}

// A sample of the lights in a rough face, which mirrors the part `mirrored` of the light to the path; that is followed
// there by `chance`. `image`: a path that has been mirrored there.
Colour PathTracer::lamp_mirrored(const Hit& hit, const Path& image, const Colour& mirrored, const RoughMirror& rough,
                                 float chance, Sampler& sampler, std::uint64_t& rays) const {
  const float choice = sampler.number();
  const Lighting::Sample lamp = lighting_->sample(choice, sampler.point());
  const bool before = lamp.direction.dot(hit.face) * image.ahead.ray().direction.dot(hit.face) > 0;
  const float density = rough.density(lamp.direction);
  if (!before || !(lamp.light.density > 0 && density > 0))
    return Colour::Zero();
  return arriving(hit, lamp, mirrored * (density / (lamp.light.density + chance * density)), image.within,
                  sampler.number(), rays);
}

// A sample of the lights, scattered by a turbid sheet.
Colour PathTracer::lamp_at_sheet(const Hit& hit, const Path& path, const Crossing& crossing,
                                 const std::array<float, 4>& chance, Sampler& sampler, std::uint64_t& rays) const {
  const float choice = sampler.number();
  const Lighting::Sample lamp = lighting_->sample(choice, sampler.point());
  const float slope = lamp.direction.dot(crossing.meeting.normal), cosine = std::abs(slope);
  const Way way = slope > 0 ? turbid_back : turbid_through;
  const float lobe = chance[way] * cosine / float_pi;
  if (!(lobe > 0 && lamp.light.density > 0))
    return Colour::Zero();
  const Colour out = optics(hit).slab.straight(cosine, crossing.thickness).coupled / crossing.mean_coupled;
  const Colour share = path.weight * crossing.part[way] * out * (cosine / float_pi) / (lamp.light.density + lobe);
  if (!(share.maxCoeff() > 0))
    return Colour::Zero();
  const Within within = body_.after(*world_, hit, lamp.direction, crossing.meeting.enters, path.within.bridged);
  return arriving(hit, lamp, share, within, sampler.number(), rays);
}

// The light of a lamp at a hit times `share`. Where that is so faint that it is not worth a ray through many layers,
// Russian roulette with a `number` of [0, 1).
Colour PathTracer::arriving(const Hit& hit, const Lighting::Sample& lamp, const Colour& share, const Within& within,
                            float number, std::uint64_t& rays) const {
  const Colour light = bounded(share * lamp.light.radiance);
  const float chance = light.maxCoeff() / (faint_lamp * lighting_->mean());
  if (!(number < chance))
    return Colour::Zero();
  return light / std::min(chance, 1.0F) * visible(hit, lamp.direction, within, rays);
}

// Planes that the camera sees straight blend into the backdrop in the distance.
Colour PathTracer::fade(const Hit& hit, Path& path) const {
  if (!path.straight || !hit.plane)
    return Colour::Zero();
  uncover(path);
  const float gone = smooth_step(surroundings_.fade_from, surroundings_.fade_to, hit.position.norm());
  const Colour seen = path.weight * gone * lighting_->backdrop(path.ahead.ray().direction);
  path.weight *= 1 - gone;
  return seen;
}

const Colour& PathTracer::albedo(const Hit& hit) const {
  return hit.id == ground_id || hit.id - first_solid_id >= surroundings_.solids.size()
             ? surroundings_.ground
             : surroundings_.solids[hit.id - first_solid_id];
}

const std::optional<float>& PathTracer::gloss(const Hit& hit) const {
  return hit.id == ground_id ? surroundings_.ground_gloss : surroundings_.solid_gloss;
}

Colour PathTracer::reflectance(const Hit& hit, const Vec& direction) const {
  if (hit.id != sheet_id)
    return albedo(hit);
  std::uint64_t rays = 0;
  Path path = start({hit.position, direction}, middle);
  const Crossing crossing = cross(hit, path, rays);
  Colour sum = Colour::Zero();
  for (const Colour& part : crossing.part)
    sum += part;
  return sum;
}

void PathTracer::meet_matte(const Hit& hit, Path& path, Sampler& sampler, std::uint64_t& rays, Light& light) const {
  const Vec direction = path.ahead.ray().direction;
  light.of(path.certain, path.layer) += fade(hit, path);
  const float side = direction.dot(hit.face) < 0 ? 1.0F : -1.0F;
  const Vec face = side * hit.face;
  Vec normal = side * hit.normal;
  if (direction.dot(normal) > -1e-3F)
    normal = face;
  const std::optional<float>& coat = gloss(hit);
  const RoughMirror rough(normal, direction, coat.value_or(1));
  const float mirrored = coat ? coat_mirrors(-direction.dot(normal)) : 0;

  const float choice = sampler.number();
  const Lighting::Sample lamp = lighting_->sample(choice, sampler.point());
  const float cosine = lamp.direction.dot(normal);
  if (cosine > 0 && lamp.direction.dot(face) > 0 && lamp.light.density > 0) {
    const float matte = (1 - mirrored) * cosine / float_pi, coated = mirrored * rough.density(lamp.direction);
    const Colour share = albedo(hit) * (matte / (lamp.light.density + matte)) + coated / (lamp.light.density + coated);
    light.chance[path.layer] += arriving(hit, lamp, path.weight * share, {path.within.bridged}, sampler.number(), rays);
  }

  Vec d;
  if (coat && sampler.number() < mirrored) {
    std::tie(d, path.density) = mirrored_in(rough, hit, direction, sampler.point());
    if (path.density)
      *path.density *= mirrored;
  } else {
    d = cosine_direction(normal, sampler.point());
    path.density = (1 - mirrored) * std::max(d.dot(normal), 1e-6F) / float_pi;
    d = beside(hit, direction, d);
    path.weight *= albedo(hit);
  }
  path.straight = false;
  path.certain = false;
  path.splits = 0;
  path.indirect = true;
  path.within = {path.within.bridged};
  path.ahead = {*world_, leave(hit, d)};
}

Sight PathTracer::look(const Ray& ray, std::uint64_t& rays) const {
  Path path = start(ray, middle);
  Sight sight;
  look(path, sight, rays);
  return sight;
}

// Goes on straight where most of the light does, and into the first mirror image.
void PathTracer::look(Path path, Sight& sight, std::uint64_t& rays) const {
  SightLayer& layer = sight.layers[path.layer];
  for (int meetings = 0; meetings < longest_look; ++meetings) {
    const Hit hit = next_met(path, rays);
    if (meetings == 0)
      sight.first = hit;
    if (!hit.anything()) {
      if (path.certain)
        sight.certain += from_afar(path);
      return;
    }
    const Meeting meeting = meet(hit, path.ahead.ray().direction);
    const Colour faded = hit.id == sheet_id ? Colour(Colour::Zero()) : fade(hit, path);
    if (path.certain)
      sight.certain += faded;
    layer.way = 31 * layer.way + hit.id;
    layer.end = hit.id;
    layer.normal = meeting.normal;
    layer.position = hit.position;
    layer.length = (hit.position - path.ahead.ray().origin).norm();
    layer.weight = path.weight;
    if (hit.id != sheet_id)
      return;
    Crossing crossing = cross(hit, path, rays);
    if (path.splits > 0 && optics(hit).is_rough()) {
      SightLayer& image = sight.layers[1];
      image = layer;
      image.way = 31 * layer.way + 1;
      image.weight = path.weight * crossing.part[mirror];
      crossing.part[mirror].setZero();
      path.splits = 0;
    } else if (path.splits > 0) {
      Sight beyond;
      look(split(hit, crossing, path), beyond, rays);
      sight.certain += beyond.certain;
      if (path.layer == 0)
        sight.layers[1] = beyond.layers[1];
    }
    const std::array<float, 4> chance = chances(path.weight, crossing.part);
    if (!(chance[through] > 0.5F)) {
      layer.weight *= crossing.coupled;
      return;
    }
    path.certain = path.certain && !crossing.by_chance && chance[through] == 1;
    path.weight *= crossing.part[through];
    go_on(hit, meeting, path);
  }
}

float PathTracer::coverage(const Ray& ray, std::uint64_t& rays) const {
  Path path = start(ray, middle);
  for (int meetings = 0; meetings < longest_path; ++meetings) {
    const Hit hit = next_met(path, rays);
    if (!hit.anything() || hit.plane)
      return 1 - path.weight.minCoeff();
    if (hit.id != sheet_id)
      return 1;
    const Crossing crossing = cross(hit, path, rays);
    path.weight *= crossing.part[through];
    if (path.weight.minCoeff() < darkness)
      return 1;
    go_on(hit, crossing.meeting, path);
  }
  return 1;
}

// What a ray that leaves `hit` brings of the light from infinity: all layers of sheet passed straight.
Colour PathTracer::visible(const Hit& hit, const Vec& direction, Within within, std::uint64_t& rays) const {
  Colour left = Colour::Ones();
  FacesAhead ahead(*world_, leave(hit, direction));
  for (int layers = 0; layers < longest_path; ++layers) {
    const Face face = ahead.next(rays);
    if (!face.anything())
      return left;
    if (face.id != sheet_id)
      return Colour::Zero();
    if (!body_.passes(*world_, face, direction, within)) {
      const Hit next = ahead.hit(face);
      const Meeting meeting = meet(next, direction);
      left *= optics(next)
                  .slab.straight(meeting.cosine, depth(next, meeting, direction, within.bridged, rays).thickness)
                  .transmitted;
      if (left.maxCoeff() < darkness)
        return Colour::Zero();
      within = body_.after(*world_, next, direction, meeting.enters, within.bridged);
    }
  }
  return Colour::Zero();
}

} // namespace sheet::render
