// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "libsheet/render/display.h"

namespace sheet::render {
namespace {

Colour linear(const Colour& displayed) {
  return {decode_srgb(displayed[0]), decode_srgb(displayed[1]), decode_srgb(displayed[2])};
}

bool shows_paper(const Hit& hit) { return !hit.anything() || hit.plane; }

// Where a ray meets the sheet, lit from the camera.
struct LitHit {
  Hit hit;
  float facing;                // 1: seen from the front
  std::array<float, 3> weight; // of the triangle's corners
};

// The colour of what is not the sheet, or nothing; then `lit` is where the ray meets it.
std::optional<Colour> colour_beside(const World& world, const Ray& ray, LitHit& lit) {
  lit.hit = world.nearest(ray);
  if (shows_paper(lit.hit))
    return paper();
  lit.facing = std::abs(ray.direction.dot(lit.hit.normal));
  if (lit.hit.id != sheet_id)
    return linear(Colour::Constant(0.35F + 0.45F * lit.facing));
  lit.weight = {1 - lit.hit.u - lit.hit.v, lit.hit.u, lit.hit.v};
  return {};
}

double value_at(const Surface& s, const LitHit& lit, const Field& field, const std::vector<double>& values) {
  if (field.where == formats::Place::triangle)
    return values[s.source_triangle[lit.hit.triangle]];
  const Corners& t = s.triangles[lit.hit.triangle];
  if (field.palette.has_kinds()) { // of the nearest corner: kinds have no middle
    const auto nearest = std::ranges::max_element(lit.weight) - lit.weight.begin();
    return values[s.source_vertex[t[static_cast<std::size_t>(nearest)]]];
  }
  double value = 0;
  for (std::size_t i = 0; i < 3; ++i)
    value += static_cast<double>(lit.weight[i]) * values[s.source_vertex[t[i]]];
  return value;
}

} // namespace

std::vector<std::pair<std::string, Look>> looks() {
  std::vector<std::pair<std::string, Look>> named = {{"material", {}}};
  for (const Field& field : fields())
    named.push_back({std::string(field.name), {Look::Kind::field, &field}});
  named.push_back({"wireframe", {Look::Kind::wireframe}});
  return named;
}

Scale Scale::nothing() { return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}; }

void Scale::add(const std::vector<double>& values) {
  for (const double v : values)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
}

Scale widened(const Scale& scale, const Field& field) {
  if (field.palette.has_kinds())
    return {0, static_cast<double>(field.palette.kinds.size()) - 1};
  if (scale.empty())
    return {0, 1};
  if (field.palette.symmetric) {
    const double most = std::max({std::abs(scale.low), std::abs(scale.high), 1e-9});
    return {-most, most};
  }
  // Thickness that differs by roundings alone is one thickness.
  if (scale.high - scale.low > 1e-6 * std::abs(scale.high))
    return scale;
  if (scale.low == 0 && scale.high == 0) // of what rests: nothing has a negative speed
    return {0, 1};
  const double width = scale.high > 0 ? 0.1 * scale.high : 1;
  return {scale.low - width, scale.high + width};
}

Colour false_colour(float place, const Palette& palette) {
  const DisplayedColour colour = palette.at(place);
  return {colour[0], colour[1], colour[2]};
}

Colour paper() { return Colour::Constant(decode_srgb(0.97F)); }

Coverage covers_paper(const World& world) {
  return [&world](const Ray& ray, std::uint64_t& rays) {
    ++rays;
    return shows_paper(world.nearest(ray)) ? 0.0F : 1.0F;
  };
}

Shader field_shader(const World& world, const Field& field, std::vector<double> values, const Scale& scale) {
  const double width = scale.high - scale.low;
  return [&world, &field, values = std::move(values), scale, width](const Ray& ray, Sampler&,
                                                                    std::uint64_t& rays) -> Colour {
    ++rays;
    LitHit lit;
    if (const auto colour = colour_beside(world, ray, lit))
      return *colour;
    const double value = value_at(world.surface(), lit, field, values);
    const auto kinds = static_cast<double>(field.palette.kinds.size());
    const double place = kinds > 0 ? (value + 0.5) / kinds : (value - scale.low) / width;
    return linear((0.72F + 0.28F * lit.facing) * false_colour(static_cast<float>(place), field.palette));
  };
}

Shader wireframe_shader(const World& world, double pixel_angle) {
  return [&world, pixel_angle](const Ray& ray, Sampler&, std::uint64_t& rays) -> Colour {
    ++rays;
    LitHit lit;
    if (const auto colour = colour_beside(world, ray, lit))
      return *colour;
    const Surface& s = world.surface();
    const Corners& t = s.triangles[lit.hit.triangle];
    const Colour paper = Colour::Constant(0.62F + 0.3F * lit.facing);
    if (s.on_bead[lit.hit.triangle])
      return linear(paper);
    // The distance to the nearest edge, in pixels; lines are about one pixel wide.
    const std::array<Vec, 3> x = {world.to_world(s.positions[t[0]]), world.to_world(s.positions[t[1]]),
                                  world.to_world(s.positions[t[2]])};
    const float twice_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < 3; ++i)
      nearest = std::min(nearest, lit.weight[i] * twice_area / (x[(i + 2) % 3] - x[(i + 1) % 3]).norm());
    const float pixel = lit.hit.distance * static_cast<float>(pixel_angle);
    return linear(nearest < 0.6F * pixel ? Colour(0.10F, 0.16F, 0.28F) : paper);
  };
}

} // namespace sheet::render
