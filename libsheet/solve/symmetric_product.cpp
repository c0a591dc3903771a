// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/symmetric_product.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sheet {

namespace {
constexpr int rows_at_once = 512;
}

void SymmetricProduct::analyze(const SparseLower& a) {
  const auto size = static_cast<std::size_t>(a.size);
  starts_.assign(size + 1, 0);
  for (std::size_t c = 0; c < size; ++c)
    for (int p = a.starts[c] + 1; p < a.starts[c + 1]; ++p)
      ++starts_[static_cast<std::size_t>(a.rows[static_cast<std::size_t>(p)]) + 1];
  for (std::size_t r = 0; r < size; ++r)
    starts_[r + 1] += starts_[r];
  columns_.resize(static_cast<std::size_t>(starts_[size]));
  places_.resize(columns_.size());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t c = 0; c < size; ++c)
    for (int p = a.starts[c] + 1; p < a.starts[c + 1]; ++p) {
      const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(a.rows[static_cast<std::size_t>(p)])]++);
      columns_[at] = static_cast<int>(c);
      places_[at] = p;
    }
}

void SymmetricProduct::multiply(const SparseLower& a, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(a.size);
  const double* values = a.values.data();
  const int* rows = a.rows.data();
  tbb::parallel_for(tbb::blocked_range<int>(0, a.size, rows_at_once), [&](const auto& range) {
    for (int r = range.begin(); r < range.end(); ++r) {
      const auto row = static_cast<std::size_t>(r);
      double left = 0, below = 0;
      for (int s = starts_[row]; s < starts_[row + 1]; ++s)
        left += values[places_[static_cast<std::size_t>(s)]] * x[columns_[static_cast<std::size_t>(s)]];
      for (int p = a.starts[row]; p < a.starts[row + 1]; ++p)
        below += values[p] * x[rows[p]];
      y[r] = left + below;
    }
  });
}

} // namespace sheet
