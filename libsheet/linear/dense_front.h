// SPDX-License-Identifier: GPL-3.0-or-later
// Partial Cholesky factorisation of one front, by blocks. Big fronts are cut into blocks whose size does not depend on
// the number of threads, and every entry is summed in the same order whoever does it: so the bits are the same too.
#pragma once
#include "libsheet/linear/front_kernels.h"

namespace sheet {

// Eliminates the pivots in the panel. False if one is not positive and finite.
template <class Real> [[nodiscard]] bool factor_panel(const FrontShape<Real>& shape, Real* panel);
// update = -L L^T of the panel's rows below the pivots.
template <class Real> void form_update(const FrontShape<Real>& shape, const Real* panel, Real* update);
// Adds a child's update matrix to the panel or to the update matrix.
template <class Real>
void add_child_to_panel(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* panel);
template <class Real>
void add_child_to_update(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* update);

} // namespace sheet
