// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the kernels for this processor.
#include "libsheet/solve/front_kernels.h"

namespace sheet {

extern const FrontKernels<float> avx512_float, avx2_float, plain_float;
extern const FrontKernels<double> avx512_double, avx2_double, plain_double;

namespace {

template <class Kernels> const Kernels& choose(const Kernels& avx512, const Kernels& avx2, const Kernels& plain) {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return avx512;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? avx2 : plain;
}

} // namespace

template <> const FrontKernels<float>& front_kernels<float>() {
  static const FrontKernels<float>& chosen = choose(avx512_float, avx2_float, plain_float);
  return chosen;
}

template <> const FrontKernels<double>& front_kernels<double>() {
  static const FrontKernels<double>& chosen = choose(avx512_double, avx2_double, plain_double);
  return chosen;
}

} // namespace sheet
