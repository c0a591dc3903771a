// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled with -ffast-math, without which the compiler takes no vector functions; so there is nothing here but them.
#include "libsheet/geometry/angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "libsheet/base/instruction_sets.h"

namespace sheet {

namespace {

// Sine and cosine in loops of their own: together they become one call that has no vector form.
SHEET_FOR_INSTRUCTION_SETS("avx512f", "avx2") void sines(const double* angles, std::size_t count, double* sine) {
  for (std::size_t i = 0; i < count; ++i)
    sine[i] = std::sin(angles[i]);
}

SHEET_FOR_INSTRUCTION_SETS("avx512f", "avx2") void cosines(const double* angles, std::size_t count, double* cosine) {
  for (std::size_t i = 0; i < count; ++i)
    cosine[i] = std::cos(angles[i]);
}

SHEET_FOR_INSTRUCTION_SETS("avx512f", "avx2") void arctangents(const double* x, std::size_t count, double* y) {
  for (std::size_t i = 0; i < count; ++i)
    y[i] = std::atan2(y[i], x[i]);
}

// What is left of a block is done one by one, to other bits; so blocks do not depend on the number of threads.
template <class Work> void each_block(std::size_t count, const Work& work) {
  constexpr std::size_t block = 1024;
  tbb::parallel_for(std::size_t{0}, (count + block - 1) / block,
                    [&](std::size_t b) { work(b * block, std::min(block, count - b * block)); });
}

} // namespace

void sines_and_cosines(std::span<const double> angles, std::span<double> sine, std::span<double> cosine) {
  each_block(angles.size(), [&](std::size_t first, std::size_t count) {
    sines(&angles[first], count, &sine[first]);
    cosines(&angles[first], count, &cosine[first]);
  });
}

void angles_of(std::span<const double> x, std::span<double> y) {
  each_block(y.size(), [&](std::size_t first, std::size_t count) { arctangents(&x[first], count, &y[first]); });
}

} // namespace sheet
