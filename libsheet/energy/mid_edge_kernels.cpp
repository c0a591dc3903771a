// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the kernels for this processor.
#include "libsheet/energy/mid_edge_kernels.h"

namespace sheet {

extern const MidEdgeKernels avx512_mid_edge, avx2_mid_edge, plain_mid_edge;

const MidEdgeKernels& mid_edge_kernels() {
  static const MidEdgeKernels& chosen = []() -> const MidEdgeKernels& {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
      return avx512_mid_edge;
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? avx2_mid_edge : plain_mid_edge;
  }();
  return chosen;
}

} // namespace sheet
