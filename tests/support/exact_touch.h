// SPDX-License-Identifier: GPL-3.0-or-later
// Do two moving features touch? Decided exactly, for points at small integers: at the moment of touching their four
// points lie in a plane, a root of a cubic in time [Provot 1997], and there the touching points lie within the
// features, inequalities of degree 4. All polynomials are kept as Bernstein coefficients over a dyadic interval, scaled
// to integers, and the interval is halved until signs decide.
#pragma once
#include <array>
#include <cstdint>

namespace sheet::test {

enum class Touch { no, yes, undecided };

using IntegerPoint = std::array<int, 3>; // each within ±256

// Vertex 0 against triangle 1 2 3 if `edges` is false, else edge 0 1 against edge 2 3; closed features, times 0 to 1.
// Undecided where the features stay in a plane or degenerate at the moment in question.
[[nodiscard]] Touch exact_touch(bool edges, const std::array<IntegerPoint, 4>& start,
                                const std::array<IntegerPoint, 4>& end);

} // namespace sheet::test
