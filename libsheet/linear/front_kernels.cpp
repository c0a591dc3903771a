// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the kernels for this processor.
#include "libsheet/linear/front_kernels.h"

namespace sheet {

extern const FrontKernels<float> avx512_float, avx2_float, plain_float;
extern const FrontKernels<double> avx512_double, avx2_double, plain_double;

namespace {

template <class Kernels>
std::vector<const Kernels*> choose(const Kernels& avx512, const Kernels& avx2, const Kernels& plain) {
  std::vector<const Kernels*> found;
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    found.push_back(&avx512);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    found.push_back(&avx2);
  found.push_back(&plain);
  return found;
}

} // namespace

template <> std::vector<const FrontKernels<float>*> available_front_kernels<float>() {
  return choose(avx512_float, avx2_float, plain_float);
}

template <> std::vector<const FrontKernels<double>*> available_front_kernels<double>() {
  return choose(avx512_double, avx2_double, plain_double);
}

template <class Real> const FrontKernels<Real>& front_kernels() {
  static const FrontKernels<Real>& fastest = *available_front_kernels<Real>().front();
  return fastest;
}

template const FrontKernels<float>& front_kernels<float>();
template const FrontKernels<double>& front_kernels<double>();

} // namespace sheet
