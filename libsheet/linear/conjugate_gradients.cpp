// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/conjugate_gradients.h"

namespace sheet {

ConjugateGradients conjugate_gradients(const LinearMap& multiply, const LinearMap& precondition,
                                       const Eigen::VectorXd& b, const Eigen::VectorXd& preconditioned, double forcing,
                                       int products) {
  ConjugateGradients result;
  result.x = Eigen::VectorXd::Zero(b.size());
  result.residual = b;
  Eigen::VectorXd p = preconditioned;
  double rz = b.dot(preconditioned);
  const double enough = forcing * forcing * rz;
  while (result.products < products && rz > enough) {
    const Eigen::VectorXd ap = multiply(p);
    const double curvature = p.dot(ap);
    ++result.products;
    if (!(curvature > 0)) {
      result.negative = true;
      if (result.products == 1)
        result.x = preconditioned;
      break;
    }
    const double length = rz / curvature;
    result.x += length * p;
    result.residual -= length * ap;
    const Eigen::VectorXd z = precondition(result.residual);
    const double next = result.residual.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  return result;
}

} // namespace sheet
