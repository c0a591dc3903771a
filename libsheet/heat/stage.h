// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit stage of heat. Of each triangle, with V its volume, A its area and h = V/A,
//   ρ c V (T - T̄)/τ = conduction along the sheet - what leaves through its faces + sources,
// at the geometry of the stage's end. Conduction is Raviart and Thomas' mixed method of lowest order [1977] with the
// temperature of every edge as multiplier [Arnold and Brezzi 1985] (conduction.h): second order on irregular meshes,
// obtuse ones too. Faces give heat to their surroundings and to walls that they touch; radiation is solved for by
// Newton's method. Across the thickness the temperature is one number, the parabola of the fluxes, or has modes of its
// own (profile.h). Heat does not pass a rim, nor from layer to layer: what lies on each other exchanges heat by
// `sources` of opposite sign, if at all. An edge has at most two triangles (Connectivity).
//
// Two stages make a step of second order [Alexander 1977], as those of the mechanics do: T1 of T̄ = T0, then T2 of
// T̄ = T0 + s (T1 - T0), s = (1 - γ)/γ; modes likewise. The heat that flowed in the step is s times that of the first
// stage plus that of the second.
//
// With no conductivity (0) nothing passes between triangles, and the profile is that of a sheet of one temperature
// across. The same bits come out for any number of threads.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/heat/profile.h"
#include "libsheet/heat/surroundings.h"

namespace sheet::heat {

// A part of a triangle's face that touches a wall.
struct WallContact {
  std::uint32_t triangle = 0;
  Face face = lower;
  std::uint32_t wall = 0; // for the account, from 0
  double conductance = 0; // contact conductance times the area that touches [W/K]
  double temperature = 0; // of the wall [K]
};

// What a stage starts from. Spans are of one entry a triangle.
struct Problem {
  double heat_capacity = 0;                     // ρ c [J/(m³ K)], positive
  std::span<const double> heat_capacities = {}; // of each triangle, in its place if not empty
  double conductivity = 0;                      // k [W/(m K)]
  double duration = 0;                          // τ [s], positive
  Profile profile = {};

  std::span<const Vector3> squared_lengths;      // of its edges, edge i opposite its corner i, at the stage's end [m²]
  std::span<const double> volumes;               // V [m³], positive
  std::span<const double> temperatures;          // T̄ [K], positive
  std::span<const double> modes = {};            // of T̄ beyond the mean, (modes - 1) a triangle; not if they follow
  std::span<const double> sources = {};          // [W], spread evenly across the thickness; none if empty
  std::array<Surroundings, 2> surroundings = {}; // of each face
  std::array<std::span<const Surroundings>, 2> local_surroundings = {}; // of each triangle, in their place if not empty
  std::array<std::span<const double>, 2> exposed = {}; // part of each face that they see, 0 to 1; all if empty
  std::span<const WallContact> contacts = {};          // in ascending order of triangles
  std::size_t walls = 0;                               // how many `wall` counts

  [[nodiscard]] double capacity(std::size_t triangle) const {
    return heat_capacities.empty() ? heat_capacity : heat_capacities[triangle];
  }
  [[nodiscard]] const Surroundings& around(std::size_t triangle, Face face) const {
    return local_surroundings[face].empty() ? surroundings[face] : local_surroundings[face][triangle];
  }
};

// Heat that the stage moved [J]: stored = generated - Σ faces - Σ walls, to round-off.
struct Account {
  double stored = 0;                // Σ ρ c V (T - T̄)
  double generated = 0;             // by sources
  std::array<double, 2> faces = {}; // to the surroundings, through the upper face and the lower one
  std::vector<double> walls = {};   // to each wall
};

struct Result {
  std::vector<double> temperatures; // T [K], of each triangle
  std::vector<double> modes;        // beyond the mean, (profile.modes() - 1) a triangle [K]
  Account account;
  int iterations = 0; // of Newton's method: 1 without radiation
};

// Squared edge lengths of every triangle, as Problem has them.
[[nodiscard]] std::vector<Vector3> squared_lengths_of(const Connectivity& mesh, std::span<const Vector3> positions);

// Stages on one mesh. What depends on the connectivity alone is kept.
class Solver {
public:
  explicit Solver(std::shared_ptr<const Connectivity> mesh);
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  // Throws std::logic_error if a span has the wrong size or contacts are out of order, Error (did not converge) if
  // Newton's method does not end.
  [[nodiscard]] Result stage(const Problem& problem);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sheet::heat
