// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels for AVX2 and FMA.
#define VECTOR_BYTES 32
#define TILE_STRIPS 1
#define TILE_COLUMNS 4
#define SHUFFLES 0
#include "libsheet/linear/front_kernels.inc"

namespace sheet {

extern const FrontKernels<float> avx2_float;
extern const FrontKernels<double> avx2_double;
const FrontKernels<float> avx2_float = Kernels<float>::table;
const FrontKernels<double> avx2_double = Kernels<double>::table;

} // namespace sheet
