// SPDX-License-Identifier: GPL-3.0-or-later
// The last resort of a step: Newton's method damped by a multiple of the unit matrix, which is adapted to how well the
// exact second-order model predicts the potential [Levenberg 1944, Marquardt 1963]. It creeps along narrow curved
// valleys, where stiff parts turn and soft ones follow, in which minimize() zigzags; elsewhere it takes more
// iterations.
#pragma once
#include "libsheet/solve/newton.h"

namespace sheet {

// As minimize(), with the stopping rule for `tolerance`, by the lengths of the steps. Leaves no factor.
[[nodiscard]] NewtonReport minimize_damped(LinearSystem& system, const Terms& terms, const Eigen::VectorXd& scale,
                                           const NewtonOptions& options, Unknowns& u);

} // namespace sheet
