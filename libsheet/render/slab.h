// SPDX-License-Identifier: GPL-3.0-or-later
// How a slab of liquid of thickness h between two smooth parallel faces reflects and transmits light. Exact for a clear
// liquid, two-stream for a turbid one; reciprocal, and conserving: without absorption all light comes out again.
//
// Angles: mu = |cos| of the direction in air, mu' = sqrt(1 - (1 - mu²)/n²) inside [Snell]. sigma_a absorption, sigma_s
// reduced scattering coefficient [1/m], sigma_t their sum, omega = sigma_s / sigma_t.
//
// Straight light. F the reflectance of one face [Fresnel 1823], tau = exp(-sigma_t h / mu') [Beer 1852]; all internal
// reflections summed, for each polarisation by itself, then averaged:
//   R = F + (1-F)² F tau² / (1 - F² tau²),   T = (1-F)² tau / (1 - F² tau²).
//
// Turbid light. C(mu) = omega (1 - R - T) is the part of the light that is scattered inside at least once. Diffuse
// fluxes down I and up J with the source q of that light, which fades as exp(-a z), a = 2 sigma_t (the mean direction
// of two streams has cosine 1/2), in units of one:
//   dI/dz = -(K+S) I + S J + q/2,   dJ/dz = (K+S) J - S I - q/2      [Schuster 1905, Kubelka and Munk 1931]
//   K = 2 sigma_a,  S = 3/4 sigma_s (equals diffusion theory where nothing is absorbed),
//   I(0) = r J(0),  J(h) = r I(h):  r = 1 - (1 - 2 ∫ F mu dmu) / n², diffuse internal reflection [Saunderson 1942].
// rho_r = (1-r) J(0) and rho_t = (1-r) I(h) leave. By reciprocity they leave with the distribution of C, so
//   f(mu_i, mu_o) = rho C(mu_i) C(mu_o) / (pi Cm),  Cm = 2 ∫ C mu dmu,
// rho = rho_r on the side that the light came from and rho_t on the other.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "libsheet/render/types.h"

namespace sheet::render {

// Reflectance of a face for the two polarisations; n > 1: the index of what lies behind it.
struct Fresnel {
  float perpendicular, parallel;
};
[[nodiscard]] Fresnel fresnel(float mu, float n);

// r of the header's formulas: how much of isotropic light inside a face throws back. 0.596 for n = 1.5.
[[nodiscard]] double internal_reflection(float n);

struct Liquid {
  float index = 1.5F;                 // of refraction
  Colour absorption = Colour::Zero(); // sigma_a [1/m]
  Colour scattering = Colour::Zero(); // reduced: sigma_s (1 - g) [1/m]
  float roughness = 0;                // of its mirror images (microfacets.h), 0 to 1; 0: smooth
};

// The presets, by their place among liquid_names.
[[nodiscard]] const std::vector<std::string>& liquid_names();
[[nodiscard]] Liquid preset(std::size_t which);
// All presets, in an order in which the first few are easy to tell apart: what several liquids look like unless it is
// said.
[[nodiscard]] std::vector<std::size_t> liquids_told_apart();
// One a line: name, index, absorption and reduced scattering of red, green and blue; separated by tabs, colours by
// spaces.
[[nodiscard]] std::string list_of_liquids();

// What a slab does to light of one direction.
struct Straight {
  Colour reflected, transmitted; // R, T
  Colour coupled;                // C
};

// What it does to the light that it has scattered; independent of the direction.
struct Diffuse {
  Colour mean_coupled;           // Cm
  Colour reflected, transmitted; // rho_r, rho_t
};

// The functions above for one liquid.
class Slab {
public:
  explicit Slab(const Liquid& liquid);
  // mu in (0, 1], h >= 0 [m].
  [[nodiscard]] Straight straight(float mu, float h) const;
  [[nodiscard]] Diffuse diffuse(float h) const;
  [[nodiscard]] const Liquid& liquid() const { return liquid_; }

private:
  Liquid liquid_;
  bool turbid_;
  double internal_; // r
};

// Diffuse by h, prepared at many thicknesses and interpolated between them.
class DiffuseTable {
public:
  // For thicknesses from `least` to `greatest` [m]; others are taken as the nearer end.
  DiffuseTable(const Slab& slab, float least, float greatest);
  [[nodiscard]] Diffuse at(float h) const;

private:
  std::vector<Diffuse> entries_;
  float start_, per_log_; // log2 of the first thickness, entries by octave
};

} // namespace sheet::render
