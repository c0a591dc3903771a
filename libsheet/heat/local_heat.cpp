// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/heat/local_heat.h"

#include <algorithm>
#include <cmath>

#include "libsheet/geometry/metric.h"
#include "libsheet/heat/conduction.h"

namespace sheet::heat {

namespace {

// Newton's method for T⁴ starts no colder than this part of what radiates: from far below it would go far beyond.
constexpr double least_start = 0.5;

// J x = b for both columns of b, by elimination without pivots, as J is positive definite.
template <class Matrix, class Columns> void solve(Matrix& j, Columns& b) {
  const Eigen::Index n = j.cols();
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const double part = j(i, k) / j(k, k);
      for (Eigen::Index m = i; m < n; ++m)
        j(m, i) -= part * j(m, k);
      b.row(i) -= part * b.row(k);
    }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    for (Eigen::Index i = k + 1; i < n; ++i)
      b.row(k) -= j(i, k) * b.row(i);
    b.row(k) /= j(k, k);
  }
}

} // namespace

template <int Count>
LocalHeat<Count>::LocalHeat(const Problem& problem)
    : problem_(problem), degrees_(problem.conductivity > 0 ? problem.profile.degrees : std::vector<int>{0}) {
  const int n = modes();
  across_ = Matrix::Zero(n, n);
  for (const Face face : {upper, lower})
    at_face_[face] = Modes::Ones(n);
  for (int i = 0; i < n; ++i) {
    at_face_[lower][i] = degrees_[static_cast<std::size_t>(i)] % 2 == 0 ? 1 : -1;
    for (int j = 0; j < n; ++j) {
      const int a = degrees_[static_cast<std::size_t>(i)], b = degrees_[static_cast<std::size_t>(j)];
      const int less = std::min(a, b);
      across_(i, j) = (a - b) % 2 == 0 ? 2 * less * (less + 1) : 0;
    }
  }
  first_contact_.assign(problem.temperatures.size() + 1, 0);
  for (const WallContact& contact : problem.contacts)
    ++first_contact_[contact.triangle + 1];
  for (std::size_t t = 1; t < first_contact_.size(); ++t)
    first_contact_[t] += first_contact_[t - 1];
}

template <int Count> std::span<const WallContact> LocalHeat<Count>::contacts(std::size_t t) const {
  return problem_.contacts.subspan(first_contact_[t], first_contact_[t + 1] - first_contact_[t]);
}

template <int Count> double LocalHeat<Count>::area(std::size_t t) const {
  return 0.5 * std::sqrt(std::max(0.0, form_determinant(problem_.squared_lengths[t])));
}

template <int Count> double LocalHeat<Count>::seen_area(std::size_t t, Face face) const {
  const std::span<const double> exposed = problem_.exposed[face];
  return area(t) * (exposed.empty() ? 1 : exposed[t]);
}

template <int Count> typename LocalHeat<Count>::Modes LocalHeat<Count>::before(std::size_t t) const {
  Modes modes = Modes::Zero(this->modes());
  modes[0] = problem_.temperatures[t];
  const auto beyond = static_cast<std::size_t>(modes.size()) - 1;
  for (std::size_t k = 0; k < beyond && !problem_.profile.follows && !problem_.modes.empty(); ++k)
    modes[static_cast<Eigen::Index>(k + 1)] = problem_.modes[t * beyond + k];
  return modes;
}

template <int Count> typename LocalHeat<Count>::State LocalHeat<Count>::start(std::size_t t) const {
  State state{before(t), {}};
  for (const Face face : {upper, lower})
    if (const Surroundings& around = problem_.around(t, face); around.emissivity > 0)
      state.modes[0] = std::max(state.modes[0], least_start * around.radiant);
  return state;
}

template <int Count>
typename LocalHeat<Count>::Step LocalHeat<Count>::step(std::size_t t, State& state, double exchange,
                                                       bool new_slopes) const {
  const double volume = problem_.volumes[t], a = conducting_area(problem_.squared_lengths[t]);
  const double by_area = a > 0 ? problem_.conductivity * a * a / volume : 1; // k A/h; what is a point has no faces
  const Modes before = this->before(t);
  Matrix j = by_area * across_;
  Modes residual = j * state.modes;
  for (int k = 0; k < modes(); ++k) {
    if (k > 0 && problem_.profile.follows)
      break;
    const double capacity =
        problem_.capacity(t) * volume / (problem_.duration * (2 * degrees_[static_cast<std::size_t>(k)] + 1));
    j(k, k) += capacity;
    residual[k] += capacity * (state.modes[k] - before[k]);
  }
  residual[0] -= problem_.sources.empty() ? 0 : problem_.sources[t];
  std::array<double, 2> leaving{};
  for (const Face face : {upper, lower}) {
    const double seen = seen_area(t, face), there = face_temperature(state, face);
    leaving[face] = seen * problem_.around(t, face).flux(there);
    if (new_slopes)
      state.slopes[face] = seen * problem_.around(t, face).slope(there);
  }
  std::array<double, 2> slope = state.slopes;
  for (const WallContact& contact : contacts(t)) {
    leaving[contact.face] += contact.conductance * (face_temperature(state, contact.face) - contact.temperature);
    slope[contact.face] += contact.conductance;
  }
  for (const Face face : {upper, lower}) {
    residual += leaving[face] * at_face_[face];
    j += slope[face] * at_face_[face] * at_face_[face].transpose();
  }
  Eigen::Matrix<double, Count, 2, Eigen::RowMajor, most, 2> columns(modes(), 2);
  columns.col(0) = residual;
  columns.col(1) = Modes::Unit(modes(), 0);
  solve(j, columns);
  return {state.modes - columns.col(0), columns.col(1), 1 / (1 + exchange * columns(0, 1))};
}

template <int Count>
double LocalHeat<Count>::advance(std::size_t t, const Step& step, double to_edges, State& state) const {
  const Modes change = step.alone - to_edges * step.answer - state.modes;
  for (const Face face : {upper, lower}) {
    const double leaving = seen_area(t, face) * problem_.around(t, face).flux(face_temperature(state, face));
    state.surroundings[face] = leaving + state.slopes[face] * at_face_[face].dot(change);
  }
  state.modes += change;
  return change.cwiseAbs().maxCoeff();
}

template <int Count> double LocalHeat<Count>::lost(std::size_t t, const State& state) const {
  double sum = state.surroundings[upper] + state.surroundings[lower];
  for (const WallContact& contact : contacts(t))
    sum += contact.conductance * (face_temperature(state, contact.face) - contact.temperature);
  return sum;
}

template class LocalHeat<1>;
template class LocalHeat<3>;
template class LocalHeat<Eigen::Dynamic>;

} // namespace sheet::heat
