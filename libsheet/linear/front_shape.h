// SPDX-License-Identifier: GPL-3.0-or-later
// How a front lies in memory. A front is the dense lower triangle of the rows that a supernode's elimination touches:
// first its pivots, then the rows that it updates. Rows are cut into strips of one cache line (16 floats or 8 doubles),
// and of a strip all columns follow each other, so that every kernel reads memory in one piece, in whole vectors.
// The panel (columns of the pivots) is what remains as the factor; the update matrix (the other columns) goes to the
// parent front. Strips that cross the diagonal have only the columns up to it, rounded up.
#pragma once
#include <algorithm>
#include <cstddef>

namespace sheet {

constexpr int columns_at_once = 8; // columns of the product kernel's tile

template <class Real> inline constexpr int strip_rows = static_cast<int>(64 / sizeof(Real));

// Always inlined: sources for different instruction sets share it.
template <class Real> struct FrontShape {
  int pivots = 0, rows = 0;

  static constexpr int S = strip_rows<Real>;
  [[gnu::always_inline]] int strips() const { return (rows + S - 1) / S; }
  [[gnu::always_inline]] int first_update_strip() const { return pivots / S; }

  // Where strip t of the panel begins; its column k is S k numbers further.
  [[gnu::always_inline]] std::ptrdiff_t panel_strip(int t) const {
    const std::ptrdiff_t whole = pivots / S, above = t < whole ? t : whole;
    return S * (S * (above * (above + 1) / 2) + (t - above) * pivots);
  }
  [[gnu::always_inline]] std::ptrdiff_t panel_size() const { return panel_strip(strips()); }

  // Columns of the update matrix, counted in the front; the first ones may still be pivots, and mean nothing.
  [[gnu::always_inline]] int first_update_column() const { return pivots / columns_at_once * columns_at_once; }
  [[gnu::always_inline]] int update_columns_end(int t) const {
    const int end = (rows + columns_at_once - 1) / columns_at_once * columns_at_once, diagonal = S * (t + 1);
    return end < diagonal ? end : diagonal;
  }
  // Where column 0 of strip t of the update matrix would be; column j is S j numbers further.
  [[gnu::always_inline]] std::ptrdiff_t update_strip(int t) const {
    const std::ptrdiff_t t0 = first_update_strip(), c0 = first_update_column(), u = t;
    return S * (S * (u * (u + 1) / 2 - t0 * (t0 + 1) / 2) - c0 * (u - t0) - c0);
  }
  [[gnu::always_inline]] std::ptrdiff_t update_size() const {
    const int last = strips() - 1;
    return rows == pivots ? 0 : update_strip(last) + std::ptrdiff_t{S} * update_columns_end(last);
  }
};

} // namespace sheet
