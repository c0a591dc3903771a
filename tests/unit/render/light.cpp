// SPDX-License-Identifier: GPL-3.0-or-later
// Samplers and lights.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/geometry/types.h"
#include "libsheet/render/lighting.h"

namespace sheet::render {
namespace {

using std::numbers::pi;

TEST(Sampler, EachPairOfDimensionsIsANet) {
  // 16 points: one in each of 16 columns, rows and 4 x 4 cells, in every pair, for every pixel.
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
    for (int pair = 0; pair < 5; ++pair) {
      std::set<int> columns, rows, cells;
      for (std::uint32_t sample = 0; sample < 16; ++sample) {
        Sampler sampler(pixel, sample);
        Point2 p{};
        for (int i = 0; i <= pair; ++i)
          p = sampler.point();
        columns.insert(static_cast<int>(16 * p.x));
        rows.insert(static_cast<int>(16 * p.y));
        cells.insert(4 * static_cast<int>(4 * p.x) + static_cast<int>(4 * p.y));
      }
      EXPECT_EQ(columns.size(), 16U);
      EXPECT_EQ(rows.size(), 16U);
      EXPECT_EQ(cells.size(), 16U);
    }
}

TEST(Sampler, ABlockOfThePictureIsANetInEachRound) {
  constexpr std::uint32_t side = 8, together = 4, cells = 16;
  for (const std::uint32_t left : {0U, 40U, 4096U})
    for (std::uint32_t round = 0; round < 5; ++round) {
      std::array<std::array<int, cells * cells>, 3> found{};
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
          for (std::uint32_t s = 0; s < together; ++s) {
            Sampler sampler = Sampler::on_screen(left + x, 80 + y, round * together + s, together);
            for (auto& dimension : found) {
              const Point2 p = sampler.point();
              ++dimension[static_cast<std::size_t>(p.y * cells) * cells + static_cast<std::size_t>(p.x * cells)];
            }
          }
      for (const auto& dimension : found)
        for (const int count : dimension)
          ASSERT_EQ(count, 1);
    }
}

TEST(Sampler, PlacesAndRoundsOfAPictureAreUnlike) {
  int alike = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const float a = Sampler::on_screen(i, 7, 3, 4).number();
    for (const Sampler& other : {Sampler::on_screen(i + 1, 7, 3, 4), Sampler::on_screen(i, 8, 3, 4),
                                 Sampler::on_screen(i, 7, 7, 4), Sampler::on_screen(i, 7, 19, 4)})
      alike += std::abs(Sampler(other).number() - a) < 0.001F ? 1 : 0;
  }
  EXPECT_LT(alike, 30); // of 4000; by chance 8
}

TEST(Sampler, PixelsAndDimensionsAreUnlike) {
  double correlation_pixels = 0, correlation_pairs = 0;
  constexpr int n = 4096;
  for (std::uint32_t i = 0; i < n; ++i) {
    Sampler a(i, 3), b(i + 1, 3);
    const double x = static_cast<double>(a.number()) - 0.5, y = static_cast<double>(a.number()) - 0.5,
                 z = static_cast<double>(b.number()) - 0.5;
    correlation_pairs += 12 * x * y / n;
    correlation_pixels += 12 * x * z / n;
  }
  EXPECT_LT(std::abs(correlation_pairs), 0.06); // four standard deviations
  EXPECT_LT(std::abs(correlation_pixels), 0.06);
}

Image bright_spot() {
  Image image(32, 16);
  for (Colour& c : image.pixels)
    c = Colour::Constant(0.2F);
  image.at(20, 4) = Colour::Constant(90);
  return image;
}

std::vector<Lighting> lights() {
  const Vec toward = Vec(0.3F, 0.4F, 0.8F).normalized();
  return {Lighting::studio(toward, Vec::UnitY()), Lighting::uniform(0.7F),
          Lighting::surroundings(bright_spot(), toward, Vec::UnitZ())};
}

TEST(Lighting, DensityIsOneOverTheSphereAndSamplesFollowIt) {
  for (const Lighting& light : lights()) {
    // Mean over the sphere of density, and of radiance by samples of the density and by an even grid.
    double whole = 0, grid = 0;
    constexpr int rows = 1024, columns = 2048;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const double polar = pi * (i + 0.5) / rows, longitude = 2 * pi * (j + 0.5) / columns;
        const double solid_angle = std::sin(polar) * (pi / rows) * (2 * pi / columns);
        const Vec d =
            Vector3(std::sin(polar) * std::cos(longitude), std::cos(polar), std::sin(polar) * std::sin(longitude))
                .cast<float>();
        whole += solid_angle * static_cast<double>(light.at(d).density);
        grid += solid_angle * static_cast<double>(luminance(light.at(d).radiance));
      }
    EXPECT_NEAR(whole, 1, 1e-3);
    double sampled = 0;
    constexpr std::uint32_t n = 1 << 16;
    for (std::uint32_t i = 0; i < n; ++i) {
      Sampler sampler(1, i);
      const float choice = sampler.number();
      const Lighting::Sample s = light.sample(choice, sampler.point());
      const Lighting::Light again = light.at(s.direction);
      EXPECT_NEAR(s.light.density, again.density, 1e-3F * again.density);
      sampled += static_cast<double>(luminance(s.light.radiance) / s.light.density) / n;
    }
    EXPECT_NEAR(sampled, grid, 4e-3 * grid);
  }
}

TEST(Lighting, ASmallSunLightsEvenly) {
  Image image(2048, 1024);
  std::fill(image.pixels.begin(), image.pixels.end(), Colour::Constant(0.2F));
  image.at(700, 300) = Colour::Constant(1e6F);
  const Lighting light = Lighting::surroundings(std::move(image), Vec::UnitZ(), Vec::UnitY());
  double sum = 0, squares = 0;
  constexpr std::uint32_t n = 4096;
  for (std::uint32_t i = 0; i < n; ++i) {
    Sampler sampler(0, i);
    const float choice = sampler.number();
    const Lighting::Sample s = light.sample(choice, sampler.point());
    const double share = static_cast<double>(luminance(s.light.radiance) / s.light.density);
    sum += share / n;
    squares += share * share / n;
  }
  const double sun = 1e6 * 2 * pi * pi / (2048 * 1024) * std::sin(pi * 300.5 / 1024); // by solid angle
  EXPECT_NEAR(sum / (sun + 0.2 * 4 * pi), 1, 0.02);
  EXPECT_LT(std::sqrt(squares - sum * sum) / sum, 1); // of one sample; 3.8 from cells of 4 x 4 pixels
  EXPECT_NEAR(static_cast<double>(light.mean()) * 4 * pi / sum, 1, 0.03);
}

TEST(Lighting, AnImageStandsUpright) {
  Image image(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) // above red, right of the middle green
      image.at(x, y) = {y < 16 ? 1.0F : 0.0F, x > 32 ? 1.0F : 0.0F, 0};
  // Camera at +z looks along -z: the middle of the image lies at -z, its right half at +x.
  const Lighting light = Lighting::surroundings(std::move(image), Vec::UnitZ(), Vec::UnitY());
  const Colour up_right = light.backdrop(Vec(0.5F, 0.5F, -0.7F).normalized());
  EXPECT_NEAR(up_right[0], 1, 1e-5);
  EXPECT_NEAR(up_right[1], 1, 1e-5);
  const Colour down_left = light.backdrop(Vec(-0.5F, -0.5F, -0.7F).normalized());
  EXPECT_NEAR(down_left[0], 0, 1e-5);
  EXPECT_NEAR(down_left[1], 0, 1e-5);
}

TEST(Lighting, SoftenedLightKeepsItsAmount) {
  const Lighting light = Lighting::studio(Vec(0, 0.3F, 1).normalized(), Vec::UnitY());
  double sharp = 0, soft = 0, brightest = 0;
  constexpr int n = 1 << 18;
  for (std::uint32_t i = 0; i < n; ++i) {
    Sampler sampler(0, i);
    const Point2 p = sampler.point();
    const float z = 1 - 2 * p.x, r = std::sqrt(std::max(0.0F, 1 - z * z)), a = 2 * static_cast<float>(pi) * p.y;
    const Vec d(r * std::cos(a), r * std::sin(a), z);
    sharp += static_cast<double>(luminance(light.at(d).radiance)) / n;
    soft += static_cast<double>(luminance(light.softened(d))) / n;
    brightest = std::max(brightest, static_cast<double>(luminance(light.softened(d))));
  }
  EXPECT_NEAR(soft, sharp, 0.05 * sharp);
  EXPECT_LT(brightest, 3);
}

} // namespace
} // namespace sheet::render
