// SPDX-License-Identifier: GPL-3.0-or-later
// Temperature across a sheet's thickness: T(ζ) = Σ a_n P_n(2ζ) with Legendre's polynomials P_n and ζ = z/h from -1/2
// (the lower face) to 1/2 (the upper one). ζ is material, as a sheet thins by the same factor everywhere across it, so
// nothing is advected along it; a_0 is the mean. Galerkin's equations for ρ c ∂T/∂t = k/h² ∂²T/∂ζ² with the heat q_u
// and q_l that leaves the faces, for a square metre, are
//   ρ c h/(2n+1) da_n/dt = -(k/h) Σ_m K_nm a_m - q_u - (-1)^n q_l,   K_nm = 2 ∫ P_n' P_m' = 2 m (m+1), m <= n of the
//   same parity.
// Where the other modes follow the mean at once (their capacity left out), modes 0, 1 and 2 give the parabola of these
// fluxes: of a face T_u = T - (h/k) (q_u/3 - q_l/6), so a sheet that both faces cool alike by a transfer coefficient H
// loses heat as by 1/(1/H + h/(6k)).
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sheet::heat {

inline constexpr int most_modes = 8;

// Which modes there are, 0 first; and whether those beyond it follow at once.
struct Profile {
  std::vector<int> degrees = {0};
  bool follows = true;

  [[nodiscard]] int modes() const { return static_cast<int>(degrees.size()); }
  bool operator==(const Profile&) const = default;
};

// One temperature across; the parabola that follows; `count` modes with a capacity of their own, even ones for sheets
// whose faces are cooled alike, or even and odd ones. Throws Error (bad input) unless count is from 1 to most_modes.
[[nodiscard]] inline Profile uniform_profile() { return {}; }
[[nodiscard]] inline Profile parabola() { return {{0, 1, 2}, true}; }
[[nodiscard]] Profile even_modes(int count);
[[nodiscard]] Profile all_modes(int count);

// P_n(2ζ).
[[nodiscard]] double legendre(int degree, double zeta);

// T at ζ of a mean and the modes beyond it (profile.modes() - 1 of them) [K].
[[nodiscard]] double temperature_at(const Profile& profile, double mean, std::span<const double> modes, double zeta);

// The points at which stresses are taken through the thickness, each of weight 1/4: Gauss' two points in each half.
inline constexpr std::array<double, 4> quarter_points = {-0.39433756729740643, -0.10566243270259357,
                                                         0.10566243270259357, 0.39433756729740643};

// Integrals across the thickness of what depends on temperature, a viscosity above all, by Gauss' rule of ten points:
// that many because a crust a tenth as thick may bear all that is borne, which four points miss by a half
// (docs/model.md).
class ThicknessRule {
public:
  static constexpr std::size_t points = 10;
  explicit ThicknessRule(const Profile& profile);

  struct Moments {
    double zeroth = 0, first = 0, second = 0; // ∫ f ζ^j dζ: of a constant f it is f, 0, f/12
  };
  // f(T) of a mean and the modes beyond it.
  template <class Function>
  [[nodiscard]] Moments moments(double mean, std::span<const double> modes, const Function& f) const {
    Moments sum;
    for (std::size_t i = 0; i < points; ++i) {
      double t = mean;
      for (std::size_t k = 0; k < modes.size(); ++k)
        t += modes[k] * legendre_[i][k];
      const double part = weights_[i] * f(t);
      sum.zeroth += part;
      sum.first += part * zetas_[i];
      sum.second += part * zetas_[i] * zetas_[i];
    }
    return sum;
  }

private:
  std::array<double, points> zetas_{}, weights_{};
  std::array<std::array<double, most_modes>, points> legendre_{}; // of the modes beyond the mean
};

} // namespace sheet::heat
