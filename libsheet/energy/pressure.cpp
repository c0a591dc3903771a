// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure as minus the work on the enclosed volume.
#include "libsheet/energy/pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libsheet/geometry/capped_volume.h"

namespace sheet {

namespace {
double ball_radius(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }
} // namespace

double Pressure::signed_volume(const VectorN<9>& u) const {
  const Vector3 a = u.segment<3>(0) - origin_;
  return a.dot((u.segment<3>(3) - origin_).cross(u.segment<3>(6) - origin_)) / 6;
}

VectorN<9> Pressure::corners(const Unknowns& u, std::size_t i) const {
  const Corners& v = mesh_->triangles[i];
  VectorN<9> x;
  x << Stage::position(u, v[0]), Stage::position(u, v[1]), Stage::position(u, v[2]);
  return x;
}

double Pressure::change(std::size_t i, const VectorN<9>& u) const {
  if (!encloses(i))
    return 0;
  double sum = signed_volume(u) - start_[i];
  if (!lagged_.empty()) {
    const Corners& v = mesh_->triangles[i];
    for (int a = 0; a < 3; ++a)
      sum += lagged_[i].segment<3>(3 * a).dot(u.segment<3>(3 * a) - start_positions_[v[a]]);
  }
  return sum;
}

VectorN<9> Pressure::volume_gradient(std::size_t i, const VectorN<9>& u) const {
  if (!encloses(i))
    return VectorN<9>::Zero();
  const Vector3 x[3] = {u.segment<3>(0) - origin_, u.segment<3>(3) - origin_, u.segment<3>(6) - origin_};
  VectorN<9> g;
  g << x[1].cross(x[2]), x[2].cross(x[0]), x[0].cross(x[1]);
  g /= 6;
  if (!lagged_.empty())
    g += lagged_[i];
  return g;
}

void Pressure::begin(const Stage& stage) {
  const State& state = *stage.start;
  mesh_ = state.mesh;
  start_positions_ = state.positions;
  duration_ = stage.duration;
  const Connectivity& mesh = *mesh_;
  origin_.setZero();
  for (const Vector3& x : state.positions)
    origin_ += x / static_cast<double>(state.positions.size());
  start_.resize(mesh.triangles.size());
  start_enclosed_ = 0;
  bool rim = false;
  for (std::size_t t = 0; t < start_.size(); ++t) {
    if (!encloses(t))
      continue;
    const Corners& v = mesh.triangles[t];
    VectorN<9> u;
    u << state.positions[v[0]], state.positions[v[1]], state.positions[v[2]];
    start_enclosed_ += start_[t] = signed_volume(u);
    for (const auto e : mesh.triangle_edges[t])
      rim = rim || mesh.on_rim(e);
  }
  lagged_.clear();
  if (rim) {
    // A rim edge a -> b of a counter-clockwise triangle leaves -(a × b)/6 of the cap's cone at both its ends.
    lagged_.assign(start_.size(), VectorN<9>::Zero());
    for (std::size_t t = 0; t < start_.size(); ++t)
      for (int k = 0; k < 3 && encloses(t); ++k)
        if (mesh.on_rim(mesh.triangle_edges[t][k])) {
          const int a = (k + 1) % 3, b = (k + 2) % 3;
          const Vector3 cap =
              (stage.predicted[mesh.triangles[t][a]] - origin_).cross(stage.predicted[mesh.triangles[t][b]] - origin_) /
              6;
          lagged_[t].segment<3>(3 * a) += cap;
          lagged_[t].segment<3>(3 * b) += cap;
        }
  }
  reference_change_ = 0;
  if (law_.kind == PressureLaw::Kind::draining && stage.previous)
    for (std::size_t t = 0; t < start_.size(); ++t)
      reference_change_ += stage.ratio * change(t, corners(*stage.previous, t));
  if (law_.kind == PressureLaw::Kind::gas)
    begin_gas(stage);
  prepare(stage.begin);
}

// What caps sweep with their rims counts, at the predicted place.
void Pressure::begin_gas(const Stage& stage) {
  const State& state = *stage.start;
  const Connectivity& mesh = *state.mesh;
  const auto whole = [&](std::span<const Vector3> x) {
    return capped_volume(mesh, x, law_.part) + law_.gas.more_volume;
  };
  start_enclosed_ = whole(state.positions);
  gas_reference_ = law_.number < state.gas.size() ? state.gas[law_.number] : Gas{.amount = law_.gas.amount};
  if (!law_.gas.flows())
    gas_reference_.amount = law_.gas.amount;
  else if (stage.previous) {
    std::vector<Vector3> first(stage.vertices());
    for (std::uint32_t v = 0; v < first.size(); ++v)
      first[v] = stage.position(*stage.previous, v);
    const Gas gas = gas_in(law_.gas, whole(first), gas_reference_.amount, stage.duration);
    gas_reference_.amount += stage.ratio * (gas.amount - gas_reference_.amount);
    gas_reference_.escaped += stage.ratio * gas.escaped;
  }
  if (lagged_.empty())
    return;
  const double caps = whole(stage.predicted) - start_enclosed_;
  double swept = 0;
  for (std::size_t t = 0; t < start_.size(); ++t) {
    const Corners& v = mesh.triangles[t];
    VectorN<9> x;
    x << stage.predicted[v[0]], stage.predicted[v[1]], stage.predicted[v[2]];
    swept += change(t, x);
  }
  start_enclosed_ += caps - swept;
}

void Pressure::finish(const Unknowns& last, State& end) {
  if (law_.kind != PressureLaw::Kind::gas)
    return;
  prepare(last);
  end.gas.resize(std::max(end.gas.size(), law_.number + 1));
  end.gas[law_.number] = gas_;
  end.gas[law_.number].escaped += gas_reference_.escaped;
}

void Pressure::prepare(const Unknowns& u) {
  double sum = 0;
  for (std::size_t t = 0; t < start_.size(); ++t)
    sum += change(t, corners(u, t));
  enclosed_ = start_enclosed_ + sum;
  switch (law_.kind) {
  case PressureLaw::Kind::constant:
    scale_ = pressure_ = law_.value;
    stiffness_ = 0;
    break;
  case PressureLaw::Kind::draining:
    stiffness_ = 1 / (law_.conductance * duration_);
    pressure_ = -stiffness_ * (sum - reference_change_);
    scale_ = -stiffness_ * (0.5 * sum - reference_change_); // W up to the constant of Ω̄
    break;
  case PressureLaw::Kind::inverse_square: {
    const double r = ball_radius(enclosed_), r_start = ball_radius(start_enclosed_);
    const double k = 4 * std::numbers::pi * law_.value * law_.reference_radius * law_.reference_radius;
    pressure_ = law_.value * (law_.reference_radius / r) * (law_.reference_radius / r);
    stiffness_ = std::max(0.0, pressure_ / (2 * std::numbers::pi * r * r * r));
    // k (r - r_start)/(Ω - Ω_start), without cancellation: r³ - r_start³ = 3 (Ω - Ω_start)/(4π)
    scale_ = k * 3 / (4 * std::numbers::pi) / (r * r + r * r_start + r_start * r_start);
    break;
  }
  case PressureLaw::Kind::gas:
    gas_ = gas_in(law_.gas, enclosed_, gas_reference_.amount, duration_);
    pressure_ = gas_.pressure;
    stiffness_ = gas_.stiffness;
    scale_ = mean_pressure(law_.gas, start_enclosed_, enclosed_, gas_reference_.amount, duration_);
    break;
  }
}

double Pressure::rank_one(const Unknowns& u, Eigen::VectorXd& g) const {
  if (stiffness_ == 0)
    return 0;
  g.setZero(u.size());
  for (std::size_t t = 0; t < start_.size(); ++t) {
    const VectorN<9> part = volume_gradient(t, corners(u, t));
    for (int a = 0; a < 3; ++a)
      g.segment<3>(3 * mesh_->triangles[t][a]) += part.segment<3>(3 * a);
  }
  return stiffness_;
}

double Pressure::value(std::size_t i, const VectorN<9>& u) const { return -scale_ * change(i, u); }

double Pressure::derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                             bool definite) const {
  gradient = -pressure_ * volume_gradient(i, u);
  hessian.setZero();
  if (!definite && encloses(i)) {
    const Vector3 x[3] = {u.segment<3>(0) - origin_, u.segment<3>(3) - origin_, u.segment<3>(6) - origin_};
    for (int a = 0; a < 3; ++a) { // ∂(x_b × x_c)/∂x_b = -[x_c]ₓ
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      hessian.block<3, 3>(3 * a, 3 * b) = (pressure_ / 6) * skew(x[c]);
      hessian.block<3, 3>(3 * a, 3 * c) = (-pressure_ / 6) * skew(x[b]);
    }
  }
  return value(i, u);
}

} // namespace sheet
