// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure on the side that the normals point away from: W = -∫ p dΩ, Ω the volume [m³] under the sheet, Σ det(x0, x1,
// x2)/6 about a fixed point. Laws:
//   constant         p
//   inverse square   p (r0/r)², r the radius of the ball of volume Ω: W = -4π p r0² (r - r_start)
//   draining         gas leaves at the rate c p: p = -(dΩ/dt)/c, W = (Ω - Ω̄)²/(2 c τ), Ω̄ the reference of the stage
//   gas              an amount of gas, compressed, and what leaves it (gas.h); its Ω has rims closed (capped_volume.h)
// Ω is that of a part of the sheet, if one is given; each enclosure has a law of its own then.
// On a closed sheet, or one whose rim is held, this is p n A exactly. On a free rim the gradient of Ω also holds a part
// that belongs to the missing cap; it is taken away with the rim at its predicted place, so the sum stays a potential:
// Ω then changes by what the sheet sweeps. The laws that depend on Ω couple all vertices: W'' g gᵀ, g = ∂Ω/∂x.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/energy/gas.h"

namespace sheet {

struct PressureLaw {
  enum class Kind { constant, inverse_square, draining, gas } kind = Kind::constant;
  double value = 0;            // [Pa]
  double reference_radius = 1; // r0 [m], inverse square
  double conductance = 1;      // c [m³/(Pa s)], draining
  GasLaw gas = {};
  std::size_t number = 0;               // of the enclosure, whose gas has this place in a state
  std::vector<char> part = {};          // of each triangle, whether it encloses; empty: all do
  std::optional<Gas> gas_at_start = {}; // of the step, if it is not as the step before has left it
  Vector3 hole_place = Vector3::Zero(); // of the widest hole [m]
};

class Pressure {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr bool external = true;
  explicit Pressure(PressureLaw law) : law_(std::move(law)) {}
  [[nodiscard]] const char* name() const { return "pressure"; }
  [[nodiscard]] std::size_t size() const { return start_.size(); }
  void begin(const Stage& stage);
  void prepare(const Unknowns& u);
  // W'' [J/m⁶] and g [m²] at the unknowns of the last prepare, which must be u.
  [[nodiscard]] double rank_one(const Unknowns& u, Eigen::VectorXd& g) const;
  // The present pressure [Pa] and volume [m³], after prepare.
  [[nodiscard]] double pressure() const { return pressure_; }
  [[nodiscard]] double enclosed() const { return enclosed_; }
  // The gas at the end of a step, to which the last stage led.
  void finish(const Unknowns& last, State& end);
  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const;
  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const;

private:
  [[nodiscard]] bool encloses(std::size_t i) const { return law_.part.empty() || law_.part[i] != 0; }
  [[nodiscard]] double signed_volume(const VectorN<9>& u) const;
  [[nodiscard]] VectorN<9> corners(const Unknowns& u, std::size_t i) const;
  [[nodiscard]] double change(std::size_t i, const VectorN<9>& u) const; // of Ω since the start
  [[nodiscard]] VectorN<9> volume_gradient(std::size_t i, const VectorN<9>& u) const;
  void begin_gas(const Stage& stage);

  PressureLaw law_;
  std::shared_ptr<const Connectivity> mesh_;
  std::vector<Vector3> start_positions_; // [m]
  double duration_ = 0;                  // τ [s]
  Vector3 origin_ = Vector3::Zero();
  std::vector<double> start_;      // each triangle's signed volume at the start of the step [m³]
  std::vector<VectorN<9>> lagged_; // the cap's part of the gradient of Ω at the predicted rim [m²]; empty without rim
  double start_enclosed_ = 0, enclosed_ = 0, pressure_ = 0;
  double reference_change_ = 0; // Ω̄ - Ω_start, draining [m³]
  double stiffness_ = 0;        // W''
  Gas gas_reference_;           // the amount of gas that the stage refers to, and what has escaped before
  Gas gas_;
  double scale_ = 0; // W = -scale_ Σ (each triangle's change of volume) [Pa]
};

} // namespace sheet
