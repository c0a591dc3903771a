// SPDX-License-Identifier: GPL-3.0-or-later
// The last resort of a step: Newton's method damped by a multiple of the unit matrix, which is adapted to how well the
// exact second-order model predicts the potential [Levenberg 1944, Marquardt 1963]. It creeps along narrow curved
// valleys, where stiff parts turn and soft ones follow, in which minimize() zigzags; elsewhere it takes more
// iterations.
#pragma once
#include "libsheet/solve/newton.h"

namespace sheet {

// As minimize(), with the same stopping rule for `tolerance`; options.hessian is not used.
[[nodiscard]] NewtonReport minimize_damped(LinearSystem& system, const Terms& terms, std::span<const char> held,
                                           const Eigen::VectorXd& scale, double floor, const NewtonOptions& options,
                                           Unknowns& u);

} // namespace sheet
