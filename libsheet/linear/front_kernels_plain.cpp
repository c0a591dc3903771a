// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels for every processor.
#define VECTOR_BYTES 16
#define TILE_STRIPS 1
#define TILE_COLUMNS 2
#define SHUFFLES 0
#include "libsheet/linear/front_kernels.inc"

namespace sheet {

extern const FrontKernels<float> plain_float;
extern const FrontKernels<double> plain_double;
const FrontKernels<float> plain_float = Kernels<float>::table;
const FrontKernels<double> plain_double = Kernels<double>::table;

} // namespace sheet
