// SPDX-License-Identifier: GPL-3.0-or-later
// Many rates at once. Where the C library has powers of vectors, the compiler takes those, for
// each instruction set: to a few units in the last place.
#include "libsheet/base/instruction_sets.h"
#include "libsheet/material/power_sum.h"

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
extern "C" {
__attribute__((simd("notinbranch"))) double pow(double, double) noexcept;
}
#endif

namespace sheet {

namespace {

template <int Count>
[[gnu::always_inline]] inline void fill(PowerSum powers, int count, const double* __restrict squared_rates,
                                        double* __restrict potentials, double* __restrict viscosities,
                                        double* __restrict slopes) {
  for (int i = 0; i < count; ++i) {
    const FlowPoint point = flow_point<Count>(powers, squared_rates[i]);
    potentials[i] = point.potential;
    viscosities[i] = point.viscosity;
    slopes[i] = point.slope;
  }
}

} // namespace

SHEET_FOR_INSTRUCTION_SETS("arch=x86-64-v4", "arch=x86-64-v3")
void flow_points(const PowerSum& powers, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes) {
  if (powers.terms == 1)
    fill<1>(powers, count, squared_rates, potentials, viscosities, slopes);
  else
    fill<2>(powers, count, squared_rates, potentials, viscosities, slopes);
}

} // namespace sheet
