// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/heat/profile.h"

#include <cmath>

#include <boost/math/quadrature/gauss.hpp>

#include "libsheet/base/error.h"

namespace sheet::heat {

namespace {

Profile modes_of(int count, int every) {
  if (count < 1 || count > most_modes)
    fail(ExitCode::bad_input, "a temperature profile has 1 to {} modes, not {}", most_modes, count);
  Profile profile{{}, false};
  for (int k = 0; k < count; ++k)
    profile.degrees.push_back(every * k);
  return profile;
}

} // namespace

Profile even_modes(int count) { return modes_of(count, 2); }
Profile all_modes(int count) { return modes_of(count, 1); }

double legendre(int degree, double zeta) { return std::legendre(static_cast<unsigned>(degree), 2 * zeta); }

double temperature_at(const Profile& profile, double mean, std::span<const double> modes, double zeta) {
  double t = mean;
  for (std::size_t k = 0; k < modes.size(); ++k)
    t += modes[k] * legendre(profile.degrees[k + 1], zeta);
  return t;
}

ThicknessRule::ThicknessRule(const Profile& profile) {
  using Gauss = boost::math::quadrature::gauss<double, points>; // which has half of its points, those above 0
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t half = i / 2;
    zetas_[i] = (i % 2 == 0 ? 0.5 : -0.5) * Gauss::abscissa()[half];
    weights_[i] = 0.5 * Gauss::weights()[half];
    for (std::size_t k = 1; k < profile.degrees.size(); ++k)
      legendre_[i][k - 1] = legendre(profile.degrees[k], zetas_[i]);
  }
}

} // namespace sheet::heat
