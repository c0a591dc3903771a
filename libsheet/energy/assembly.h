// SPDX-License-Identifier: GPL-3.0-or-later
// The sum of all terms over all their elements: value [J], gradient [N, or N m for angles], Hessian. Written once for
// every term. Elements with the same stencil share a place in one buffer, which the MatrixPattern gathers into the
// matrix.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libsheet/energy/constraints.h"
#include "libsheet/energy/pattern.h"
#include "libsheet/energy/term.h"

namespace sheet {

class Assembly {
public:
  Assembly() = default;
  // angles: whether every edge has an unknown. The terms of all calls below are these, or others in the same order with
  // the same elements (a model whose numbers have changed); another number of terms throws std::logic_error.
  Assembly(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles);

  [[nodiscard]] std::size_t unknowns() const { return 3 * mesh_->vertices + (angles_ ? mesh_->edges.size() : 0); }
  [[nodiscard]] std::size_t vertices() const { return mesh_->vertices; }
  [[nodiscard]] bool angles() const { return angles_; }
  // Pairs of vertices that share an element (each once, either order); what a fill-reducing order is made from.
  [[nodiscard]] std::vector<Edge> vertex_graph() const;
  // Sets the order of elimination, from an order of the vertices: each edge comes just before the first of its
  // vertices.
  void set_order(std::span<const std::uint32_t> vertex_order);
  [[nodiscard]] const MatrixPattern& pattern() const { return *pattern_; }

  [[nodiscard]] EnergySum value(const Terms& terms, const Unknowns& u);
  // Value and gradient, without the Hessian's cost.
  EnergySum gradient(const Terms& terms, const Unknowns& u, const Constraints& constraints, Eigen::VectorXd& gradient);
  // The gradient of those terms alone that act from outside the sheet or on its mass (Term::external), unconstrained.
  [[nodiscard]] Eigen::VectorXd external_gradient(const Terms& terms, const Unknowns& u);
  // Gradient and Hessian are those of what the constraints leave free.
  EnergySum derivatives(const Terms& terms, const Unknowns& u, bool definite, const Constraints& constraints,
                        Eigen::VectorXd& gradient, SparseLower& matrix);
  // The Hessian at u of the terms of one kind (inertial or elastic) times a vector.
  [[nodiscard]] Eigen::VectorXd multiply(const Terms& terms, Kind kind, const Unknowns& u, const Eigen::VectorXd& x);
  // Seconds spent in each term (summed over threads) and, last, in gathering, since construction or clear_seconds.
  [[nodiscard]] const std::vector<double>& seconds() const { return seconds_; }
  void clear_seconds() { std::ranges::fill(seconds_, 0.0); }

private:
  void prepare(const Terms& terms, const Unknowns& u) const;
  [[nodiscard]] std::size_t chunks() const;
  template <class Visit> void each_chunk(Visit&& visit) const;
  void gather_gradient(const Constraints& constraints, Eigen::VectorXd& gradient);
  void collect(const ElementGroup& group, std::size_t first, std::size_t last, const Unknowns& u, double* out) const;

  std::shared_ptr<const Connectivity> mesh_;
  bool angles_ = false;
  int stride_ = 9;
  std::vector<ElementGroup> groups_;
  std::vector<int> group_of_term_;
  std::vector<std::size_t> term_order_; // a group's first term has all of its nodes, so it need not add, but sets
  std::optional<MatrixPattern> pattern_;
  std::unique_ptr<double[]> gradients_, hessians_; // of all elements; not read before they are written
  std::size_t gradient_numbers_ = 0;
  std::vector<double> seconds_;
};

} // namespace sheet
