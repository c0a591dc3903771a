// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/slab.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheet::render {
namespace {

Liquid liquid(float index, float absorption, float scattering) {
  return {index, Colour::Constant(absorption), Colour::Constant(scattering)};
}

TEST(Fresnel, KnownAngles) {
  for (const float n : {1.33F, 1.5F, 2.4F}) {
    const float normal = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    EXPECT_NEAR(fresnel(1, n).perpendicular, normal, 1e-6);
    EXPECT_NEAR(fresnel(1, n).parallel, normal, 1e-6);
    const float brewster = 1 / std::sqrt(1 + n * n); // tan = n
    EXPECT_NEAR(fresnel(brewster, n).parallel, 0, 1e-9);
    EXPECT_NEAR(fresnel(1e-4F, n).perpendicular, 1, 1e-3);
  }
}

TEST(Fresnel, DiffuseInternalReflection) {
  // Tabulated for n = 1.5 [Egan and Hilgeman 1979]: 0.5964 (external 0.0918).
  EXPECT_NEAR(internal_reflection(1.5F), 1 - (1 - 0.0918) / 2.25, 1e-4);
}

// All internal reflections one by one, for one polarisation.
std::pair<double, double> bounces(double face, double tau) {
  double reflected = face, transmitted = 0, beam = 1 - face;
  for (int i = 0; i < 4000; ++i) {
    beam *= tau;
    transmitted += beam * (1 - face);
    beam *= face * tau;
    reflected += beam * (1 - face);
    beam *= face;
    // the beam runs down again
  }
  return {reflected, transmitted};
}

TEST(Slab, StraightLightIsBeerLambertWithAllReflections) {
  for (const double n : {1.1, 1.5})
    for (const double mu : {1.0, 0.7, 0.3, 0.1})
      for (const double sigma : {0.0, 40.0, 600.0}) {
        const double h = 0.003, inside = std::sqrt(1 - (1 - mu * mu) / (n * n));
        const double tau = std::exp(-sigma * h / inside);
        const Fresnel f = fresnel(static_cast<float>(mu), static_cast<float>(n));
        const auto [rs, ts] = bounces(static_cast<double>(f.perpendicular), tau);
        const auto [rp, tp] = bounces(static_cast<double>(f.parallel), tau);
        const Straight straight =
            Slab(liquid(static_cast<float>(n), static_cast<float>(sigma), 0)).straight(static_cast<float>(mu), 0.003F);
        EXPECT_NEAR(straight.reflected[0], (rs + rp) / 2, 2e-6) << n << ' ' << mu << ' ' << sigma;
        EXPECT_NEAR(straight.transmitted[0], (ts + tp) / 2, 2e-6) << n << ' ' << mu << ' ' << sigma;
      }
}

TEST(Slab, WithoutAbsorptionAllLightLeaves) {
  for (const float scattering : {0.0F, 1.0F, 300.0F, 2e4F, 1e7F})
    for (const float h : {1e-7F, 1e-4F, 3e-3F, 0.1F, 2.0F})
      for (const float mu : {1.0F, 0.5F, 0.05F, 1e-4F}) {
        const Slab slab(liquid(1.5F, 0, scattering));
        const Straight s = slab.straight(mu, h);
        const Diffuse d = slab.diffuse(h);
        EXPECT_NEAR(s.reflected[0] + s.transmitted[0] + s.coupled[0] * (d.reflected[0] + d.transmitted[0]), 1, 2e-5)
            << scattering << ' ' << h << ' ' << mu;
      }
}

TEST(Slab, GainsNothingAndAbsorbsMoreWhereItIsThicker) {
  const Slab slab(preset(1));
  double before = 2;
  for (const float h : {1e-5F, 1e-4F, 1e-3F, 1e-2F, 1e-1F}) {
    const Straight s = slab.straight(0.8F, h);
    const Diffuse d = slab.diffuse(h);
    const double sum =
        static_cast<double>((s.reflected + s.transmitted + s.coupled * (d.reflected + d.transmitted))[0]);
    EXPECT_LT(sum, before);
    EXPECT_GT(sum, 0);
    before = sum;
  }
  EXPECT_LT(before, 1);
}

// The two-stream equations by finite volumes: cells with constant I and J, their equations solved by sweeps.
std::pair<double, double> two_stream_by_cells(double sigma_a, double sigma_s, double h, double r) {
  constexpr int cells = 2000;
  const double k = 2 * sigma_a, s = 0.75 * sigma_s, a = 2 * (sigma_a + sigma_s), dz = h / cells;
  // Shoot from z = 0 with J(0) = 1 (homogeneous, no source) and J(0) = 0 (with source); combine to J(h) = r I(h).
  const auto integrate = [&](double i, double j, double source) {
    const double q0 = source * a / (1 - std::exp(-a * h));
    const auto slope = [&](double z, double u, double v, double& du, double& dv) {
      const double q = q0 * std::exp(-a * z);
      du = -(k + s) * u + s * v + q / 2;
      dv = (k + s) * v - s * u - q / 2;
    };
    for (int c = 0; c < cells; ++c) { // classical Runge-Kutta
      const double z = c * dz;
      double a1, b1, a2, b2, a3, b3, a4, b4;
      slope(z, i, j, a1, b1);
      slope(z + dz / 2, i + dz / 2 * a1, j + dz / 2 * b1, a2, b2);
      slope(z + dz / 2, i + dz / 2 * a2, j + dz / 2 * b2, a3, b3);
      slope(z + dz, i + dz * a3, j + dz * b3, a4, b4);
      i += dz / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      j += dz / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
    return std::pair(i, j);
  };
  const auto [i1, j1] = integrate(r, 1, 0);
  const auto [i0, j0] = integrate(0, 0, 1);
  const double start = (r * i0 - j0) / (j1 - r * i1);
  return {(1 - r) * start, (1 - r) * (i0 + start * i1)};
}

TEST(Slab, ScatteredLightSolvesTheTwoStreamEquations) {
  const double r = internal_reflection(1.5F);
  for (const double sigma_a : {0.0, 0.3, 5.0, 50.0, 200.0})
    for (const double sigma_s : {1.0, 80.0, 700.0})
      for (const double h : {1e-3, 0.01}) {
        const auto [reflected, transmitted] = two_stream_by_cells(sigma_a, sigma_s, h, r);
        const Diffuse d =
            Slab(liquid(1.5F, static_cast<float>(sigma_a), static_cast<float>(sigma_s))).diffuse(static_cast<float>(h));
        EXPECT_NEAR(d.reflected[0], reflected, 1e-5) << sigma_a << ' ' << sigma_s << ' ' << h;
        EXPECT_NEAR(d.transmitted[0], transmitted, 1e-5) << sigma_a << ' ' << sigma_s << ' ' << h;
      }
}

TEST(Slab, MeanCoupling) {
  const Slab slab(preset(2));
  double sum = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double mu = (i + 0.5) / n;
    sum += 2 * mu / n * static_cast<double>(slab.straight(static_cast<float>(mu), 0.004F).coupled[1]);
  }
  EXPECT_NEAR(slab.diffuse(0.004F).mean_coupled[1], sum, 1e-4 * sum);
}

TEST(DiffuseTable, AgreesBetweenItsEntries) {
  const Slab slab(preset(2));
  const DiffuseTable table(slab, 1e-4F, 1e-2F);
  for (float h = 1e-4F; h <= 1e-2F; h *= 1.37F) {
    const Diffuse a = table.at(h), b = slab.diffuse(h);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(a.mean_coupled[c], b.mean_coupled[c], 1e-3 * static_cast<double>(b.mean_coupled[c]));
      EXPECT_NEAR(a.reflected[c], b.reflected[c], 1e-3);
      EXPECT_NEAR(a.transmitted[c], b.transmitted[c], 1e-3);
    }
  }
}

} // namespace
} // namespace sheet::render
