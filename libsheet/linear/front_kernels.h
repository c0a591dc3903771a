// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loops of the factorisation, for one thread, in three versions: AVX-512, AVX2 with FMA, and plain. Sums are
// in a fixed order, so the same machine always gives the same bits; another instruction set may give others.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/linear/front_shape.h"

namespace sheet {

// A child's update matrix on its way into the parent front.
template <class Real> struct ChildUpdate {
  FrontShape<Real> shape;
  const Real* update;
  const std::uint32_t* places; // of its update rows among the parent's rows, ascending
  int in_panel;                // how many of them are pivots of the parent
};

template <class Real> struct FrontKernels {
  // Columns [j0, j1) of the strips t ... t + count - 1 (one or two), less the products of columns [k0, k1) of their
  // panel rows and of the rows j0 ... j1 - 1. to[i] is column 0 of strip t + i. fresh: what stood there counts as zero.
  void (*subtract)(const FrontShape<Real>& shape, const Real* panel, int t, int count, int j0, int j1, int k0, int k1,
                   Real* const* to, bool fresh);
  // Eliminates the columns [p, q) in the strips t ... t + count - 1, which have had the columns before p subtracted
  // and stand below the strips in which these columns are done already, or are the next one (count = 1).
  bool (*eliminate)(const FrontShape<Real>& shape, Real* panel, int p, int q, int t, int count);
  // Adds rows [r0, r1) of a child's update matrix, none of them a pivot of the child, to the panel, or, of rows that
  // are no pivots of the parent either, to its update matrix. Whole strips of the parent are read and written, so what
  // is added at the same time must not meet in one.
  void (*add_to_panel)(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* panel, int r0, int r1);
  void (*add_to_update)(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* update, int r0, int r1);
  // x: all rows of the front, in whole strips. Solves for the pivots and takes them out of the other rows.
  void (*forward)(const FrontShape<Real>& shape, const Real* panel, Real* x);
  // Solves the transposed system for the pivots, the other rows being known. sums: a strip for each pivot.
  void (*backward)(const FrontShape<Real>& shape, const Real* panel, Real* x, Real* sums);
};

// The kernels that this processor can run, the fastest first.
template <class Real> std::vector<const FrontKernels<Real>*> available_front_kernels();
template <> std::vector<const FrontKernels<float>*> available_front_kernels<float>();
template <> std::vector<const FrontKernels<double>*> available_front_kernels<double>();
// The fastest ones.
template <class Real> const FrontKernels<Real>& front_kernels();

} // namespace sheet
