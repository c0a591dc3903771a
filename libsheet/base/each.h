// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over numbers that do not depend on each other, on all threads.
#pragma once
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sheet {

// work(i) for every i < count, in any order; it may write only what belongs to i, so that the result does not depend on
// the number of threads. For work of some tens of nanoseconds or more.
template <class Work> void each_in_parallel(std::size_t count, const Work& work) {
  constexpr std::size_t at_once = 512;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, at_once), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      work(i);
  });
}

} // namespace sheet
