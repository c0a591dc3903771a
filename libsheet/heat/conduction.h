// SPDX-License-Identifier: GPL-3.0-or-later
// Conduction along a sheet of thickness h by the mixed-hybrid method: in each triangle the heat flux is Raviart and
// Thomas' of lowest order [1977], and each edge has a temperature λ, Lagrange's multiplier of the flux's continuity
// [Arnold and Brezzi 1985]. Fluxes follow from T and λ in closed form: with edge vectors e_i, the area A and
// s = Σ |e_i|², the flux that leaves through edge i is
//   F_i = -k h Σ_j S_ij λ_j + (g/3) (T - λ̄),   S_ij = e_i·e_j/A,   g = 144 k h A/s,   λ̄ the mean of λ,
// as the mass matrix of the fluxes, ∫ (x - x_i)·(x - x_j)/(4 A² k h), has the eigenvector (1, 1, 1) with the value
// s/(48 A k h) and is the inverse of k h S on what is orthogonal to it. The rows of S sum up to zero, so T = λ = const
// has no flux. A triangle whose area is less than 1e-4 s (equilateral: 0.144) conducts as if it had that: its entries
// stay bounded.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet::heat {

// The area by which a triangle conducts, of its squared edge lengths [m²].
[[nodiscard]] double conducting_area(const Vector3& squared_lengths);

// Of one triangle [W/K].
struct Conductances {
  std::array<double, 3> off = {}; // k h S_ij, the pair opposite edge i
  double exchange = 0;            // g

  Conductances() = default;
  // squared_lengths [m²], volume [m³], k [W/(m K)].
  Conductances(const Vector3& squared_lengths, double volume, double conductivity);

  // F_i [W], of which the edges take `exchanged` = g (T - λ̄) together.
  [[nodiscard]] Vector3 fluxes(double exchanged, const Vector3& edge_temperatures) const;
};

// The symmetric positive definite system of the edges' temperatures: of each triangle k h S + w 1 1ᵀ, where w is what
// is left of g/9 when the triangle's own temperature is eliminated.
class EdgeSystem {
public:
  explicit EdgeSystem(const Connectivity& mesh);
  ~EdgeSystem();
  EdgeSystem(EdgeSystem&&) noexcept;
  EdgeSystem& operator=(EdgeSystem&&) noexcept;

  // Throws Error (did not converge) if the matrix is not positive definite.
  void factorize(std::span<const Conductances> conductances, std::span<const double> weights);
  // The edges' x with Σ over triangles of (k h S + w 1 1ᵀ) x = Σ over triangles of `loads`.
  [[nodiscard]] std::vector<double> solve(std::span<const Vector3> loads);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet::heat
