// SPDX-License-Identifier: GPL-3.0-or-later
// The linearised equations of one stage: the Hessian of the potential, exact and up to date, as an operator, and one
// factor, of this Hessian or an earlier or a positive one, as preconditioner of it. Both work on *rows*: unknowns in
// the order of elimination, scaled so that the factorised matrix has a unit diagonal; so shifts have no unit.
// Terms that couple all unknowns (an enclosed volume) add rank-one parts to both [Sherman and Morrison 1950].
// Memory is kept from one connectivity to the next.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "libsheet/energy/assembly.h"
#include "libsheet/energy/walls.h"
#include "libsheet/linear/supernodal_factor.h"
#include "libsheet/linear/symmetric_product.h"

namespace sheet {

enum class Precision {
  single, // a preconditioner, at half the cost and memory
  full
};

enum class Form { exact, positive }; // of the Hessian

class LinearSystem {
public:
  LinearSystem() = default;
  LinearSystem(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles) {
    analyze(std::move(mesh), terms, angles);
  }
  // Prepares for a connectivity and the elements of these terms; what was known of another is forgotten.
  void analyze(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles);
  [[nodiscard]] double seconds_analysis() const { return seconds_analysis_; }

  // What is prescribed, and the shift that every operator and factor has at least. Takes effect with the next Hessian
  // and factor.
  void constrain(Constraints constraints, double floor);
  // The same vertices slide in other directions: a factor still serves as preconditioner.
  void turn_slides(const Stage& stage) { sheet::turn_slides(stage, constraints_); }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }

  [[nodiscard]] double floor() const { return floor_; }

  [[nodiscard]] EnergySum value(const Terms& terms, const Unknowns& u) { return assembly_.value(terms, u); }
  // Value [J] and gradient [N, N m]; held unknowns have none.
  EnergySum gradient(const Terms& terms, const Unknowns& u, Eigen::VectorXd& g);
  // The same, and the exact Hessian.
  EnergySum hessian(const Terms& terms, const Unknowns& u, Eigen::VectorXd& g);
  // The Hessian's positive semidefinite approximation, to be factorised; the operator stays as it is.
  void find_positive_form(const Terms& terms, const Unknowns& u);

  // Factorises the present Hessian, or its positive form, + shift (of the scaled matrix). False if that is not positive
  // definite in this precision; the factor is then gone.
  [[nodiscard]] bool factorize(double shift, Precision precision, Form form = Form::exact);
  [[nodiscard]] bool has_factor() const { return has_factor_; }
  void forget_factor() { has_factor_ = false; }
  // Whether the factor alone, without products with the Hessian, is known or hoped to lead to the solution quickly.
  [[nodiscard]] bool factor_serves() const { return has_factor_ && factor_serves_; }
  void set_factor_serves(bool serves) { factor_serves_ = serves; }

  // Of rows; the floor is a part of the operator.
  [[nodiscard]] Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  // Forces in the order of the unknowns to rows, and steps in rows to unknowns.
  [[nodiscard]] Eigen::VectorXd to_rows(const Eigen::VectorXd& forces) const;
  [[nodiscard]] Eigen::VectorXd to_unknowns(const Eigen::VectorXd& rows) const;
  // Adds to a step [rows] the translations that leave of `force` none on the sheet as a whole: what inertia makes of a
  // sheet that nothing holds is then exact, whatever the precision of the factor. Does nothing where something is held.
  void balance(const Eigen::VectorXd& force, Eigen::VectorXd& step) const;

  // Solves H s = force, all in the order of the unknowns, to a tenth, with the last Hessian and factor. Held unknowns
  // feel no force.
  [[nodiscard]] Eigen::VectorXd respond(Eigen::VectorXd force) const;
  [[nodiscard]] Eigen::VectorXd multiply(const Terms& terms, Kind kind, const Unknowns& u, const Eigen::VectorXd& x) {
    return assembly_.multiply(terms, kind, u, x);
  }

  // Moves u by one linearised step that takes the held unknowns to their target, so that the others make way: a
  // starting point for motions of more than an edge. False if the matrix cannot be factorised. The factor is gone.
  [[nodiscard]] bool spread_held_motion(const Terms& terms, const Unknowns& target, Unknowns& u);

  [[nodiscard]] std::size_t unknowns() const { return assembly_.unknowns(); }
  // Of the terms that act from outside the sheet or on its mass, constraints or not.
  [[nodiscard]] Eigen::VectorXd external_gradient(const Terms& terms, const Unknowns& u) {
    return assembly_.external_gradient(terms, u);
  }
  [[nodiscard]] const Assembly& assembly() const { return assembly_; }
  void clear_seconds() { assembly_.clear_seconds(); }
  [[nodiscard]] const SparseLower& matrix() const { return matrix_; }
  [[nodiscard]] double flops() const { return single_.flops(); }

private:
  struct RankOne {
    double stiffness = 0;
    Eigen::VectorXd g;
  };
  struct SolvedRankOne {
    Eigen::VectorXd g, solved; // rows; solved: by the factor
    double part = 0;
  };
  void find_rank_ones(const Terms& terms, const Unknowns& u);
  void find_scale(const SparseLower& matrix);
  [[nodiscard]] bool factorize_matrix(const SparseLower& matrix, double shift, Precision precision);
  void rank_ones_to_rows();

  Assembly assembly_;
  SupernodalFactor<float> single_;
  SupernodalFactor<double> full_;
  Precision precision_ = Precision::single; // of the present factor
  bool full_is_analyzed_ = false;           // it is when first needed
  SparseLower matrix_, positive_;           // exact; positive form, whose structure is made when first needed
  SymmetricProduct product_;
  Eigen::VectorXd scale_; // of rows
  void project_rows(Eigen::VectorXd& rows) const;

  Constraints constraints_;
  double floor_ = 0;
  std::vector<RankOne> of_hessian_, of_operator_; // of unknowns, of rows
  std::vector<SolvedRankOne> of_factor_;
  bool has_factor_ = false, factor_serves_ = false;
  double seconds_analysis_ = 0;
};

} // namespace sheet
