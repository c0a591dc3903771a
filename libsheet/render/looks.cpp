// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/dihedral.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/render/display.h"

namespace sheet::render {
namespace {

struct Stop {
  float place;
  Colour colour;
};

// Luminance rises evenly.
const std::array<Stop, 7> amounts = {{{0.0F, {0.12F, 0.05F, 0.28F}},
                                      {0.17F, {0.19F, 0.19F, 0.52F}},
                                      {0.34F, {0.11F, 0.37F, 0.60F}},
                                      {0.5F, {0.07F, 0.53F, 0.56F}},
                                      {0.67F, {0.24F, 0.69F, 0.42F}},
                                      {0.84F, {0.65F, 0.82F, 0.22F}},
                                      {1.0F, {0.99F, 0.92F, 0.33F}}}};
const std::array<Stop, 5> two_sided = {{{0.0F, {0.09F, 0.25F, 0.55F}},
                                        {0.25F, {0.45F, 0.66F, 0.84F}},
                                        {0.5F, {0.95F, 0.95F, 0.94F}},
                                        {0.75F, {0.90F, 0.57F, 0.42F}},
                                        {1.0F, {0.62F, 0.10F, 0.15F}}}};
const std::array<Colour, 3> contact_colours = {{{0.80F, 0.81F, 0.83F}, {0.16F, 0.45F, 0.75F}, {0.86F, 0.33F, 0.16F}}};

template <std::size_t N> Colour between(const std::array<Stop, N>& stops, float place) {
  std::size_t i = 1;
  while (i + 1 < N && place > stops[i].place)
    ++i;
  const Stop &a = stops[i - 1], &b = stops[i];
  const float w = std::clamp((place - a.place) / (b.place - a.place), 0.0F, 1.0F);
  return (1 - w) * a.colour + w * b.colour;
}

Colour linear(const Colour& displayed) {
  return {decode_srgb(displayed[0]), decode_srgb(displayed[1]), decode_srgb(displayed[2])};
}

std::vector<double> triangle_thickness(const formats::Frame& frame) {
  const auto x = positions(frame);
  const auto corners = sheet::triangles(frame);
  std::vector<double> h;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Corners& c = corners[t];
    h.push_back(volumes(frame)[t] / (0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm()));
  }
  return h;
}

std::vector<double> mean_curvature(const formats::Frame& frame) {
  const auto x = positions(frame);
  const Connectivity mesh = connect(frame.vertices, sheet::triangles(frame));
  const std::vector<double> area = vertex_shares(x.size(), mesh.triangles, [&](std::uint32_t t) {
    const Corners& c = mesh.triangles[t];
    return 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
  });
  std::vector<double> bend(x.size(), 0);
  std::vector<bool> rim(x.size(), false);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    if (mesh.on_rim(e)) {
      rim[a] = rim[b] = true;
      continue;
    }
    std::array<std::uint32_t, 2> apex{};
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::uint32_t v : mesh.triangles[mesh.edge_triangles[e][side]])
        if (v != a && v != b)
          apex[side] = v;
    const double lb = (x[b] - x[a]).norm() * dihedral_angle(x[a], x[b], x[apex[0]], x[apex[1]]);
    bend[a] += lb;
    bend[b] += lb;
  }
  for (std::size_t v = 0; v < x.size(); ++v)
    bend[v] = rim[v] || !(area[v] > 0) ? 0 : bend[v] / (4 * area[v]);
  return bend;
}

std::vector<double> speed(const formats::Frame& frame) {
  std::vector<double> result(frame.vertices, 0);
  const auto v = velocities(frame);
  for (std::size_t i = 0; i < v.size(); ++i)
    result[i] = v[i].norm();
  return result;
}

std::vector<double> contacts(const formats::Frame& frame) {
  std::vector<double> result(frame.vertices, 0);
  const auto touched = touched_solids(frame);
  for (std::size_t v = 0; v < touched.size(); ++v)
    result[v] = touched[v] != no_solid ? 1 : 0;
  if (const formats::Array* springs = frame.find("contact_vertex"))
    for (const std::uint32_t v : springs->values<std::uint32_t>())
      result[v] = 2;
  return result;
}

} // namespace

const std::vector<std::string>& look_names() {
  static const std::vector<std::string> names = {"material", "thickness", "curvature",
                                                 "speed",    "contacts",  "wireframe"};
  return names;
}

bool has_scale(Look look) { return look != Look::material && look != Look::wireframe; }

Values values_of(const formats::Frame& frame, Look look) {
  switch (look) {
  case Look::thickness:
    return {true, triangle_thickness(frame)};
  case Look::curvature:
    return {false, mean_curvature(frame)};
  case Look::speed:
    return {false, speed(frame)};
  case Look::contacts:
    return {false, contacts(frame)};
  case Look::material:
  case Look::wireframe:
    break;
  }
  return {};
}

Scale Scale::nothing() { return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}; }

void Scale::add(const Values& values) {
  for (const double v : values.values)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
}

Scale widened(const Scale& scale, Look look) {
  if (look == Look::contacts)
    return {0, 2};
  if (scale.empty())
    return {0, 1};
  if (look == Look::curvature) {
    const double most = std::max({std::abs(scale.low), std::abs(scale.high), 1e-9});
    return {-most, most};
  }
  // Thickness that differs by roundings alone is one thickness.
  if (scale.high - scale.low > 1e-6 * std::abs(scale.high))
    return scale;
  const double width = scale.high > 0 ? 0.1 * scale.high : 1;
  return {scale.low - width, scale.high + width};
}

Colour false_colour(float place, Look look) {
  if (look == Look::curvature)
    return between(two_sided, place);
  if (look == Look::contacts)
    return contact_colours[static_cast<std::size_t>(std::clamp(place * 3, 0.0F, 2.0F))];
  return between(amounts, place);
}

Shader look_shader(const World& world, Look look, Values values, const Scale& scale, double pixel_angle) {
  const double width = scale.high - scale.low;
  return [&world, look, values = std::move(values), scale, width, pixel_angle](const Ray& ray, Sampler&,
                                                                               std::uint64_t& rays) -> Colour {
    ++rays;
    const Hit hit = world.nearest(ray);
    if (!hit.anything() || hit.plane)
      return Colour::Constant(decode_srgb(0.97F));
    const float facing = std::abs(ray.direction.dot(hit.normal)), shade = 0.72F + 0.28F * facing;
    if (hit.id != sheet_id)
      return linear(Colour::Constant(0.35F + 0.45F * facing));
    const Surface& s = world.surface();
    const Corners& t = s.triangles[hit.triangle];
    const std::array<float, 3> weight = {1 - hit.u - hit.v, hit.u, hit.v};
    if (look == Look::wireframe) {
      Colour paper = Colour::Constant(0.62F + 0.3F * facing);
      if (s.on_bead[hit.triangle])
        return linear(paper);
      // The distance to the nearest edge, in pixels; lines are about one pixel wide.
      const std::array<Vec, 3> x = {world.to_world(s.positions[t[0]]), world.to_world(s.positions[t[1]]),
                                    world.to_world(s.positions[t[2]])};
      const float twice_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
      float nearest = std::numeric_limits<float>::infinity();
      for (std::size_t i = 0; i < 3; ++i)
        nearest = std::min(nearest, weight[i] * twice_area / (x[(i + 2) % 3] - x[(i + 1) % 3]).norm());
      const float pixel = hit.distance * static_cast<float>(pixel_angle);
      return linear(nearest < 0.6F * pixel ? Colour(0.10F, 0.16F, 0.28F) : paper);
    }
    double value = 0;
    if (values.per_triangle)
      value = values.values[s.source_triangle[hit.triangle]];
    else if (look == Look::contacts) // of the nearest corner: kinds have no middle
      value = values.values[s.source_vertex[t[static_cast<std::size_t>(std::max_element(weight.begin(), weight.end()) -
                                                                       weight.begin())]]];
    else
      for (std::size_t i = 0; i < 3; ++i)
        value += static_cast<double>(weight[i]) * values.values[s.source_vertex[t[i]]];
    const double place = (value - scale.low) / width;
    return linear(shade * false_colour(static_cast<float>(look == Look::contacts ? (value + 0.5) / 3 : place), look));
  };
}

} // namespace sheet::render
