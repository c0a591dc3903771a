// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels for any x86-64 processor.
#include "libsheet/energy/mid_edge_kernels.inc"

namespace sheet {

extern const MidEdgeKernels plain_mid_edge;
const MidEdgeKernels plain_mid_edge = kernel_table;

} // namespace sheet
