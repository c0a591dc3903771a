// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/slab.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace sheet::render {
namespace {

constexpr float least_cosine = 1e-4F; // grazing light, where 1 - F² tau² vanishes

// Gauss-Legendre of 8 points on [0, 1]: nodes, weights.
constexpr std::array<double, 8> node = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                                        0.5917173212478249, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
constexpr std::array<double, 8> node_weight = {0.0506142681451881, 0.1111905172266872, 0.1568533229389436,
                                               0.1813418916891810, 0.1813418916891810, 0.1568533229389436,
                                               0.1111905172266872, 0.0506142681451881};

// 2 ∫ f mu dmu over four pieces, since Fresnel's formula is steep at grazing angles.
template <class F> auto cosine_mean(F&& f) {
  constexpr std::array<double, 5> ends = {0, 0.05, 0.2, 0.5, 1};
  auto sum = f(1.0F);
  sum = sum * 0;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece)
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double width = ends[piece + 1] - ends[piece], mu = ends[piece] + width * node[i];
      sum += f(static_cast<float>(mu)) * static_cast<float>(2 * mu * width * node_weight[i]);
    }
  return sum;
}

struct Leaving {
  double reflected, transmitted;
};

// The two-stream equations of slab.h, solved in closed form for one channel.
Leaving two_stream(double sigma_a, double sigma_s, double h, double r) {
  if (!(sigma_s > 0))
    return {0, 0}; // nothing is scattered, nothing leaves
  const double k = 2 * sigma_a, s = 0.75 * sigma_s, a = 2 * (sigma_a + sigma_s);
  const double kappa = std::sqrt(k * (k + 2 * s));
  if (a * h < 1e-6)
    return {0.5, 0.5};                       // the limit of a thin slab
  const double source = -std::expm1(-a * h); // 1 - exp(-a h)
  if (kappa * h < 1e-3) {                    // no absorption worth the name: J - I is the integral of q
    const double w = (1 + r) / (1 - r), q = h / source - 1 / a;
    const double reflected = (w + 2 * s * q) / (2 * w + 2 * s * h);
    return {reflected, 1 - reflected};
  }
  // I = alpha e^{-kappa z} + beta g e^{-kappa (h-z)} + A e^{-az}, J likewise with g and 1 exchanged and B; a > kappa.
  const double q0 = a / source, delta = a * a - kappa * kappa;
  const double big_a = -0.5 * q0 * (k + 2 * s + a) / delta, big_b = -0.5 * q0 * (k + 2 * s - a) / delta;
  const double g = (k + s - kappa) / s, fade = std::exp(-kappa * h), end = std::exp(-a * h);
  const double p = 1 - r * g, q = fade * (g - r);
  const double top = r * big_b - big_a, bottom = (r * big_a - big_b) * end;
  const double determinant = p * p - q * q;
  const double alpha = (p * top - q * bottom) / determinant, beta = (p * bottom - q * top) / determinant;
  return {(1 - r) * (alpha * g + beta * fade + big_b), (1 - r) * (alpha * fade + beta * g + big_a * end)};
}

struct Preset {
  std::string_view name;
  float index;
  std::array<float, 3> absorption, scattering; // red, green, blue
};

// Chosen by eye so that layers of some millimetres look as one knows them.
constexpr std::array<Preset, 6> presets{{{"chocolate", 1.46F, {2400, 6600, 12500}, {5200, 5200, 5200}},
                                         {"caramel", 1.48F, {40, 190, 900}, {260, 260, 260}},
                                         {"honey", 1.49F, {14, 75, 420}, {6, 6, 6}},
                                         {"batter", 1.40F, {12, 50, 240}, {2600, 2600, 2600}},
                                         {"glass", 1.52F, {55, 14, 30}, {0, 0, 0}},
                                         {"film", 1.50F, {14, 8, 4}, {35, 35, 35}}}};

} // namespace

Fresnel fresnel(float mu, float n) {
  const float inside = std::sqrt(1 - (1 - mu * mu) / (n * n));
  const float s = (mu - n * inside) / (mu + n * inside), p = (n * mu - inside) / (n * mu + inside);
  return {s * s, p * p};
}

double internal_reflection(float n) {
  const float external = cosine_mean([&](float mu) {
    const Fresnel f = fresnel(mu, n);
    return 0.5F * (f.perpendicular + f.parallel);
  });
  return 1 - (1 - static_cast<double>(external)) / (static_cast<double>(n) * static_cast<double>(n));
}

const std::vector<std::string>& liquid_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Preset& p : presets)
      result.emplace_back(p.name);
    return result;
  }();
  return names;
}

Liquid preset(std::size_t which) {
  const auto& [name, index, a, s] = presets[which];
  return {index, {a[0], a[1], a[2]}, {s[0], s[1], s[2]}};
}

std::vector<std::size_t> liquids_told_apart() {
  std::vector<std::size_t> order;
  for (const std::string_view name : {"chocolate", "batter", "honey", "glass", "caramel", "film"})
    order.push_back(static_cast<std::size_t>(std::ranges::find(presets, name, &Preset::name) - presets.begin()));
  return order;
}

std::string list_of_liquids() {
  std::string list;
  for (const auto& [name, index, absorption, scattering] : presets)
    list += fmt::format("{}\t{}\t{}\t{}\n", name, index, fmt::join(absorption, " "), fmt::join(scattering, " "));
  return list;
}

Slab::Slab(const Liquid& liquid)
    : liquid_(liquid), turbid_((liquid.scattering > 0).any()), internal_(internal_reflection(liquid.index)) {}

Straight Slab::straight(float mu, float h) const {
  mu = std::clamp(mu, least_cosine, 1.0F);
  const float inside = std::sqrt(1 - (1 - mu * mu) / (liquid_.index * liquid_.index));
  const Fresnel f = fresnel(mu, liquid_.index);
  const Colour extinction = liquid_.absorption + liquid_.scattering;
  const Colour tau = (-extinction * (h / inside)).exp();
  Straight result{Colour::Zero(), Colour::Zero(), Colour::Zero()};
  for (const float face : {f.perpendicular, f.parallel}) {
    const Colour through = (1 - face) * (1 - face) * tau / (1 - face * face * tau.square());
    result.transmitted += 0.5F * through;
    result.reflected += 0.5F * (face + through * face * tau);
  }
  if (turbid_)
    result.coupled =
        (liquid_.scattering / extinction.max(1e-30F) * (1 - result.reflected - result.transmitted)).max(0.0F);
  return result;
}

Diffuse Slab::diffuse(float h) const {
  Diffuse result{Colour::Zero(), Colour::Zero(), Colour::Zero()};
  if (!turbid_)
    return result;
  result.mean_coupled = cosine_mean([&](float mu) { return straight(mu, h).coupled; });
  for (int c = 0; c < 3; ++c) {
    const Leaving leaving = two_stream(static_cast<double>(liquid_.absorption[c]),
                                       static_cast<double>(liquid_.scattering[c]), static_cast<double>(h), internal_);
    result.reflected[c] = static_cast<float>(leaving.reflected);
    result.transmitted[c] = static_cast<float>(leaving.transmitted);
  }
  return result;
}

DiffuseTable::DiffuseTable(const Slab& slab, float least, float greatest) {
  constexpr float by_octave = 16;
  least = std::max(least, 1e-12F);
  greatest = std::max(greatest, least);
  const int intervals = std::max(1, static_cast<int>(std::ceil(by_octave * std::log2(greatest / least))));
  start_ = std::log2(least);
  per_log_ = by_octave;
  for (int i = 0; i <= std::min(intervals, 1024); ++i)
    entries_.push_back(slab.diffuse(std::exp2(start_ + static_cast<float>(i) / by_octave)));
}

Diffuse DiffuseTable::at(float h) const {
  const float last = static_cast<float>(entries_.size() - 1);
  const float place = std::clamp((std::log2(std::max(h, 1e-12F)) - start_) * per_log_, 0.0F, last);
  const auto i = std::min(static_cast<std::size_t>(place), entries_.size() - 2);
  const float w = place - static_cast<float>(i);
  const Diffuse &a = entries_[i], &b = entries_[i + 1];
  return {(1 - w) * a.mean_coupled + w * b.mean_coupled, (1 - w) * a.reflected + w * b.reflected,
          (1 - w) * a.transmitted + w * b.transmitted};
}

} // namespace sheet::render
