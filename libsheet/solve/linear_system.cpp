// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/linear_system.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_invoke.h>

#include "libsheet/base/each.h"
#include "libsheet/base/stopwatch.h"
#include "libsheet/linear/conjugate_gradients.h"
#include "libsheet/linear/elimination_order.h"

namespace sheet {

namespace {
constexpr double response = 0.1; // what respond() leaves
constexpr int response_products = 10;
constexpr int coordinates = 3, with_angles = 6; // at a vertex, which has three edges
constexpr double spread_shift = 1e-6;           // for a starting point only
} // namespace

void LinearSystem::analyze(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles) {
  Stopwatch watch;
  const std::size_t vertices = mesh->vertices;
  assembly_ = Assembly(std::move(mesh), terms, angles);
  const int unknowns = angles ? with_angles : coordinates;
  assembly_.set_order(elimination_order(vertices, assembly_.vertex_graph(), unknowns));
  const NodeGraph graph = assembly_.pattern().node_graph();
  tbb::parallel_invoke([&] { single_.analyze(graph); },
                       [&] {
                         matrix_ = assembly_.pattern().structure();
                         product_.analyze(graph);
                       });
  positive_.size = 0;
  full_is_analyzed_ = false;
  has_factor_ = false;
  seconds_analysis_ = watch.lap();
}

void LinearSystem::constrain(Constraints constraints, double floor) {
  constraints_ = std::move(constraints);
  floor_ = floor;
  has_factor_ = false;
}

EnergySum LinearSystem::gradient(const Terms& terms, const Unknowns& u, Eigen::VectorXd& g) {
  return assembly_.gradient(terms, u, constraints_, g);
}

EnergySum LinearSystem::hessian(const Terms& terms, const Unknowns& u, Eigen::VectorXd& g) {
  const EnergySum energy = assembly_.derivatives(terms, u, false, constraints_, g, matrix_);
  find_rank_ones(terms, u);
  if (has_factor_)
    rank_ones_to_rows();
  return energy;
}

void LinearSystem::find_positive_form(const Terms& terms, const Unknowns& u) {
  if (positive_.size == 0)
    positive_ = matrix_;
  Eigen::VectorXd gradient;
  (void)assembly_.derivatives(terms, u, true, constraints_, gradient, positive_);
  find_rank_ones(terms, u);
}

void LinearSystem::find_rank_ones(const Terms& terms, const Unknowns& u) {
  of_hessian_.clear();
  for (const auto& term : terms) {
    Eigen::VectorXd g;
    const double stiffness = term->rank_one(u, g);
    if (stiffness == 0)
      continue;
    constraints_.project(g);
    of_hessian_.push_back({stiffness, std::move(g)});
  }
}

void LinearSystem::rank_ones_to_rows() {
  of_operator_.clear();
  for (const RankOne& part : of_hessian_)
    of_operator_.push_back({part.stiffness, to_rows(part.g)});
}

// The factors that bring the matrix to a diagonal of ones (of mean one over the three coordinates of a vertex). Held
// rows keep theirs.
void LinearSystem::find_scale(const SparseLower& matrix) {
  const auto& permutation = assembly_.pattern().permutation();
  scale_.resize(matrix.size);
  const std::vector<char>& held = constraints_.held;
  const auto fixed = [&](int row) { return !held.empty() && held[permutation[static_cast<std::size_t>(row)]] != 0; };
  for (int k = 0; k < matrix.size;) {
    const int width = permutation[static_cast<std::size_t>(k)] < 3 * assembly_.vertices() ? 3 : 1;
    double sum = 0;
    int count = 0;
    for (int row = k; row < k + width; ++row)
      if (!fixed(row)) {
        sum += std::abs(matrix.values[static_cast<std::size_t>(matrix.starts[static_cast<std::size_t>(row)])]);
        ++count;
      }
    for (int row = k; row < k + width; ++row)
      scale_[row] = fixed(row) || sum == 0 ? 1 : std::sqrt(count / sum);
    k += width;
  }
}

bool LinearSystem::factorize_matrix(const SparseLower& matrix, double shift, Precision precision) {
  precision_ = precision;
  if (precision == Precision::single)
    return single_.factorize(matrix, scale_, shift);
  if (!full_is_analyzed_)
    full_.analyze(assembly_.pattern().node_graph());
  full_is_analyzed_ = true;
  return full_.factorize(matrix, scale_, shift);
}

bool LinearSystem::factorize(double shift, Precision precision, Form form) {
  const SparseLower& matrix = form == Form::exact ? matrix_ : positive_;
  find_scale(matrix);
  has_factor_ = factorize_matrix(matrix, std::max(shift, floor_), precision);
  if (!has_factor_)
    return false;
  of_factor_.clear();
  rank_ones_to_rows();
  for (const RankOne& part : of_operator_) {
    Eigen::VectorXd solved = solve(part.g);
    const double factor = part.stiffness / (1 + part.stiffness * part.g.dot(solved));
    of_factor_.push_back({part.g, std::move(solved), factor});
  }
  return true;
}

Eigen::VectorXd LinearSystem::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y;
  product_.multiply(matrix_, x.cwiseProduct(scale_), y);
  y.array() = y.array() * scale_.array() + floor_ * x.array();
  for (const RankOne& part : of_operator_)
    y += (part.stiffness * part.g.dot(x)) * part.g;
  return y;
}

// What slides may do so in other directions than when the factor was made.
Eigen::VectorXd LinearSystem::solve(const Eigen::VectorXd& b) const {
  const bool slides = !constraints_.slides.empty();
  Eigen::VectorXd free;
  if (slides) {
    free = b;
    project_rows(free);
  }
  const Eigen::VectorXd& rows = slides ? free : b;
  Eigen::VectorXd x = precision_ == Precision::single ? single_.solve(rows) : full_.solve(rows);
  for (const SolvedRankOne& part : of_factor_)
    x -= (part.part * part.g.dot(x)) * part.solved;
  if (slides)
    project_rows(x);
  return x;
}

// The three rows of a vertex have one scale, but those that are held.
void LinearSystem::project_rows(Eigen::VectorXd& rows) const {
  for (const Slide& slide : constraints_.slides) {
    auto x = rows.segment<3>(assembly_.pattern().first_row(slide.vertex));
    x = Vector3(slide.free * x);
  }
}

Eigen::VectorXd LinearSystem::to_rows(const Eigen::VectorXd& forces) const {
  const auto& permutation = assembly_.pattern().permutation();
  Eigen::VectorXd rows(forces.size());
  each_in_parallel(permutation.size(), [&](std::size_t row) {
    const auto k = static_cast<Eigen::Index>(row);
    rows[k] = scale_[k] * forces[permutation[row]];
  });
  return rows;
}

Eigen::VectorXd LinearSystem::to_unknowns(const Eigen::VectorXd& rows) const {
  const auto& permutation = assembly_.pattern().permutation();
  Eigen::VectorXd step(rows.size());
  each_in_parallel(permutation.size(), [&](std::size_t row) {
    const auto k = static_cast<Eigen::Index>(row);
    step[permutation[row]] = scale_[k] * rows[k];
  });
  return step;
}

void LinearSystem::balance(const Eigen::VectorXd& force, Eigen::VectorXd& step) const {
  const std::vector<char>& held = constraints_.held;
  if (floor_ > 0 || !constraints_.slides.empty() || std::find(held.begin(), held.end(), char{1}) != held.end())
    return;
  const Eigen::VectorXd residual = force - multiply(step);
  // Rows of a unit translation are 1 / scale.
  Vector3 stiffness = assembly_.pattern().sum_of_blocks(matrix_), left = Vector3::Zero();
  const auto each_vertex = [&](const auto& visit) {
    for (std::uint32_t v = 0; v < assembly_.vertices(); ++v)
      visit(assembly_.pattern().first_row(v));
  };
  std::vector<Vector3> of_parts(of_operator_.size(), Vector3::Zero());
  each_vertex([&](Eigen::Index row) {
    const Vector3 scale = scale_.segment<3>(row);
    left += residual.segment<3>(row).cwiseQuotient(scale);
    for (std::size_t p = 0; p < of_parts.size(); ++p)
      of_parts[p] += of_operator_[p].g.segment<3>(row).cwiseQuotient(scale);
  });
  for (std::size_t p = 0; p < of_parts.size(); ++p)
    stiffness += of_operator_[p].stiffness * of_parts[p].cwiseAbs2();
  Vector3 shift = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (stiffness[axis] > 0)
      shift[axis] = left[axis] / stiffness[axis];
  each_vertex([&](Eigen::Index row) { step.segment<3>(row) += shift.cwiseQuotient(scale_.segment<3>(row)); });
}

Eigen::VectorXd LinearSystem::respond(Eigen::VectorXd force) const {
  constraints_.project(force);
  const Eigen::VectorXd rows = to_rows(force);
  const auto product = [&](const Eigen::VectorXd& x) { return multiply(x); };
  const auto precondition = [&](const Eigen::VectorXd& b) { return solve(b); };
  return to_unknowns(conjugate_gradients(product, precondition, rows, solve(rows), response, response_products).x);
}

bool LinearSystem::spread_held_motion(const Terms& terms, const Unknowns& target, Unknowns& u) {
  const auto& permutation = assembly_.pattern().permutation();
  Eigen::VectorXd gradient;
  has_factor_ = false;
  // For a start, what slides is held.
  std::vector<char> held = constraints_.held;
  held.resize(static_cast<std::size_t>(u.size()), 0);
  for (const Slide& slide : constraints_.slides)
    std::fill_n(held.begin() + 3 * static_cast<std::ptrdiff_t>(slide.vertex), 3, char{1});
  assembly_.derivatives(terms, u, true, {}, gradient, matrix_);
  SparseLower& a = matrix_;
  Eigen::VectorXd rhs(u.size()), move(u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const auto unknown = permutation[static_cast<std::size_t>(k)];
    move[k] = held[unknown] ? target[unknown] - u[unknown] : 0;
    rhs[k] = -gradient[unknown];
  }
  for (int c = 0; c < a.size; ++c) {
    const bool fixed = held[permutation[static_cast<std::size_t>(c)]];
    for (auto p = static_cast<std::size_t>(a.starts[static_cast<std::size_t>(c)]);
         p < static_cast<std::size_t>(a.starts[static_cast<std::size_t>(c) + 1]); ++p) {
      const int r = a.rows[p];
      rhs[r] -= a.values[p] * move[c];
      if (r != c)
        rhs[c] -= a.values[p] * move[r];
      if (fixed || held[permutation[static_cast<std::size_t>(r)]])
        a.values[p] = r == c ? 1 : 0;
    }
  }
  for (Eigen::Index k = 0; k < u.size(); ++k)
    if (held[permutation[static_cast<std::size_t>(k)]])
      rhs[k] = move[k];
  find_scale(matrix_);
  if (!factorize_matrix(matrix_, spread_shift, Precision::single))
    return false;
  const Eigen::VectorXd step = single_.solve(rhs.cwiseProduct(scale_));
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const auto unknown = permutation[static_cast<std::size_t>(k)];
    u[unknown] += held[unknown] ? move[k] : scale_[k] * step[k];
  }
  return u.allFinite();
}

} // namespace sheet
