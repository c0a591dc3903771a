// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels for AVX-512.
#define VECTOR_BYTES 64
#define TILE_STRIPS 2
#define TILE_COLUMNS 8
#define SHUFFLES 1
#include "libsheet/linear/front_kernels.inc"

namespace sheet {

extern const FrontKernels<float> avx512_float;
extern const FrontKernels<double> avx512_double;
const FrontKernels<float> avx512_float = Kernels<float>::table;
const FrontKernels<double> avx512_double = Kernels<double>::table;

} // namespace sheet
