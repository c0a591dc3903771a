// SPDX-License-Identifier: GPL-3.0-or-later
// Many rates at once. Where the C library has logarithms and exponentials for vectors, the compiler takes those, for
// each instruction set: to a few units in the last place.
#include "libsheet/material/power_sum.h"

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {
__attribute__((simd("notinbranch"))) double exp(double) noexcept;
__attribute__((simd("notinbranch"))) double log(double) noexcept;
}
#define SHEET_FOR_EACH_INSTRUCTION_SET __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define SHEET_FOR_EACH_INSTRUCTION_SET
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

SHEET_FOR_EACH_INSTRUCTION_SET
void flow_points(const PowerSum& powers, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes) {
  if (powers.terms == 1)
    fill<1>(powers, count, squared_rates, potentials, viscosities, slopes);
  else
    fill<2>(powers, count, squared_rates, potentials, viscosities, slopes);
}

} // namespace sheet
