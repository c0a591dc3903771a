// SPDX-License-Identifier: GPL-3.0-or-later
// What a triangle does by itself in a stage of heat: its modes a across the thickness (profile.h), with n of them
//   D (a - ā)/τ + (k A/h) K a + Σ_f Φ_f(v_f·a) v_f + (E - source) (1, 0, ...) = 0,   E = g (a_0 - λ̄),
// D = ρ c V/(2n+1), v_f the modes at a face, Φ_f the heat that leaves through it [W], E what its edges take. Newton's
// matrix J of all but E is symmetric positive definite. If the edges took nothing, a step would lead to a*; with
// u = J⁻¹ (1, 0, ...) and the part 1/(1 + g u_0) [Sherman and Morrison 1950],
//   E = part g (a*_0 - λ̄),   a = a* - E u,
// in which nothing cancels, however well the sheet conducts.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "libsheet/heat/stage.h"

namespace sheet::heat {

// Count: that of the modes, if it is known when this is compiled, which it is for one temperature across and for the
// parabola; else Eigen::Dynamic.
template <int Count> class LocalHeat {
public:
  static constexpr int most = Count == Eigen::Dynamic ? most_modes : Count;
  using Modes = Eigen::Matrix<double, Count, 1, 0, most, 1>;
  using Matrix = Eigen::Matrix<double, Count, Count, 0, most, most>;

  struct State {
    Modes modes;                             // a [K]
    std::array<double, 2> slopes = {};       // of what leaves to the surroundings through each face [W/K]
    std::array<double, 2> surroundings = {}; // heat that leaves to them through each face [W]
  };
  // A step of Newton's method.
  struct Step {
    Modes alone;     // a* [K]
    Modes answer;    // u [K/W]
    double part = 1; // 1/(1 + g u_0)
    // E [W].
    [[nodiscard]] double exchanged(double exchange, double edges) const { return part * exchange * (alone[0] - edges); }
  };

  explicit LocalHeat(const Problem& problem);
  [[nodiscard]] int modes() const { return Count == Eigen::Dynamic ? static_cast<int>(degrees_.size()) : Count; }
  [[nodiscard]] State start(std::size_t t) const;
  // exchange: g [W/K]. Takes new slopes, or those that the state has: then J is what it was.
  [[nodiscard]] Step step(std::size_t t, State& state, double exchange, bool new_slopes) const;
  // Takes a step that gives `to_edges` [W] to the edges. The greatest change of a mode [K].
  double advance(std::size_t t, const Step& step, double to_edges, State& state) const;
  // What leaves through both faces [W], to walls too.
  [[nodiscard]] double lost(std::size_t t, const State& state) const;
  [[nodiscard]] double face_temperature(const State& state, Face face) const { return at_face_[face].dot(state.modes); }

private:
  [[nodiscard]] Modes before(std::size_t t) const; // ā
  [[nodiscard]] std::span<const WallContact> contacts(std::size_t t) const;
  [[nodiscard]] double area(std::size_t t) const;
  [[nodiscard]] double seen_area(std::size_t t, Face face) const;

  const Problem& problem_;
  std::vector<int> degrees_;
  std::array<Modes, 2> at_face_; // v_f
  Matrix across_;                // K
  std::vector<std::uint32_t> first_contact_;
};

extern template class LocalHeat<1>;
extern template class LocalHeat<3>;
extern template class LocalHeat<Eigen::Dynamic>;

} // namespace sheet::heat
