// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels for AVX-512.
#include "libsheet/energy/mid_edge_kernels.inc"

namespace sheet {

extern const MidEdgeKernels avx512_mid_edge;
const MidEdgeKernels avx512_mid_edge = kernel_table;

} // namespace sheet
