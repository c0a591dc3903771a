// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images in rough faces.
#include "libsheet/render/microfacets.h"

#include <gtest/gtest.h>

namespace sheet::render {
namespace {

Vec slanted(float degrees) {
  const float angle = degrees * float_pi / 180;
  return {std::sin(angle), 0, -std::cos(angle)};
}

// Over a fine grid of directions.
template <class Visit> void each_direction(Visit&& visit) {
  constexpr int rows = 400, columns = 800;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const float polar = float_pi * (static_cast<float>(row) + 0.5F) / rows,
                  longitude = 2 * float_pi * (static_cast<float>(column) + 0.5F) / columns;
      const double solid_angle =
          2.0 * 3.141592653589793 * 3.141592653589793 / rows / columns * static_cast<double>(std::sin(polar));
      visit(Vec(std::sin(polar) * std::cos(longitude), std::sin(polar) * std::sin(longitude), std::cos(polar)),
            solid_angle);
    }
}

TEST(RoughMirror, DensityIsOneOverTheSphereAndSamplesFollowIt) {
  for (const float roughness : {0.3F, 0.6F, 1.0F})
    for (const float degrees : {0.0F, 40.0F, 75.0F}) {
      const RoughMirror mirror(Vec::UnitZ(), slanted(degrees), roughness);
      double whole = 0;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero(), drawn = mean;
      each_direction([&](const Vec& d, double solid_angle) {
        whole += static_cast<double>(mirror.density(d)) * solid_angle;
        mean += static_cast<double>(mirror.density(d)) * solid_angle * d.cast<double>();
      });
      EXPECT_NEAR(whole, 1, 0.01) << roughness << " at " << degrees;
      constexpr std::uint32_t n = 4096;
      for (std::uint32_t i = 0; i < n; ++i)
        drawn += mirror.sample(Sampler(0, i).point()).cast<double>() / n;
      EXPECT_LT((drawn - mean).norm(), 0.01) << roughness << " at " << degrees;
    }
}

TEST(RoughMirror, SmoothIsAMirror) {
  const Vec direction = slanted(30);
  const RoughMirror mirror(Vec::UnitZ(), direction, 0);
  EXPECT_LT((mirror.sample({0.3F, 0.8F}) - Vec(direction.x(), 0, -direction.z())).norm(), 1e-3F);
}

} // namespace
} // namespace sheet::render
