// SPDX-License-Identifier: GPL-3.0-or-later
// A direction for Newton's method: preconditioned conjugate gradients on the Hessian, ended where the residual is small
// enough or the curvature is not positive [Steihaug 1983].
#pragma once
#include <functional>

#include <Eigen/Core>

namespace sheet {

struct ConjugateGradients {
  Eigen::VectorXd x;        // of A x = b
  Eigen::VectorXd residual; // b - A x
  int products = 0;         // with A
  bool negative = false;    // a direction of no or negative curvature was met
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// Solves A x = b until √(rᵀ M⁻¹ r), r the residual, is below `forcing` times what it was, or after `products` products.
// preconditioned: M⁻¹ b, known already. Where the first direction has no positive curvature x is that direction, else
// what was reached before.
[[nodiscard]] ConjugateGradients conjugate_gradients(const LinearMap& multiply, const LinearMap& precondition,
                                                     const Eigen::VectorXd& b, const Eigen::VectorXd& preconditioned,
                                                     double forcing, int products);

} // namespace sheet
