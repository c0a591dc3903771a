// SPDX-License-Identifier: GPL-3.0-or-later
// What takes heat from a face of the sheet: air by a transfer coefficient [Newton 1701], what is seen around by
// radiation [Stefan 1879; Boltzmann 1884] of a grey face. Temperatures in K.
#pragma once
#include <cmath>

namespace sheet::heat {

inline constexpr double stefan_boltzmann = 5.670374419e-8; // σ [W/(m² K⁴)], exact since 2019

enum Face : int { upper = 0, lower = 1 }; // the positive side (triangles run counter-clockwise seen from it), the other

struct Surroundings {
  double transfer = 0;   // H [W/(m² K)]
  double ambient = 0;    // T_a, of the air [K]
  double emissivity = 0; // ε, from 0 to 1
  double radiant = 0;    // T_r, of what the face sees [K]

  // Heat that leaves a square metre at T, and its derivative. T⁴ has the sign of T, so both rise with any T that
  // Newton's method may pass.
  [[nodiscard]] double flux(double t) const { // [W/m²]
    const double size = std::abs(t), around = radiant * radiant;
    return transfer * (t - ambient) + emissivity * stefan_boltzmann * (size * size * size * t - around * around);
  }
  [[nodiscard]] double slope(double t) const { // [W/(m² K)]
    const double size = std::abs(t);
    return transfer + 4 * emissivity * stefan_boltzmann * size * size * size;
  }
  bool operator==(const Surroundings&) const = default;
};

} // namespace sheet::heat
