// SPDX-License-Identifier: GPL-3.0-or-later
// For std::visit.
#pragma once

namespace sheet {

// One visitor from several lambdas.
template <class... F> struct Overloaded : F... { using F::operator()...; };
template <class... F> Overloaded(F...) -> Overloaded<F...>;

} // namespace sheet
