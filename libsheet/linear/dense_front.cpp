// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of a front: which strips and columns one call of a kernel works on.
#include "libsheet/linear/dense_front.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace sheet {

namespace {

constexpr int block = 128;             // pivots eliminated before the rest is updated by them
constexpr int depth_at_once = 384;     // columns of a product at once
constexpr int row_group = 256;         // rows of a task
constexpr int column_group = 256;      // columns of a task
constexpr double least_parallel = 5e5; // products below which a task is not worth its start

// Calls run(0) ... run(tasks - 1), in parallel if there is enough to do.
template <class Run> void each_task(int tasks, double products, const Run& run) {
  if (tasks > 1 && products > least_parallel)
    tbb::parallel_for(0, tasks, run);
  else
    for (int task = 0; task < tasks; ++task)
      run(task);
}

// Calls body(first, last) on groups of the strips [t0, t1).
template <class Real, class Body> void each_group(int t0, int t1, double products, const Body& body) {
  constexpr int size = row_group / strip_rows<Real>;
  each_task((t1 - t0 + size - 1) / size, products,
            [&](int g) { body(t0 + g * size, std::min(t1, t0 + (g + 1) * size)); });
}

// Calls body(first, last) on groups of the child's rows from `first` on, no two of which come into one strip of the
// parent.
template <class Real, class Body>
void each_group_of_child(const ChildUpdate<Real>& child, int first, double products, const Body& body) {
  const auto strip = [&](int r) { return child.places[r - child.shape.pivots] / strip_rows<Real>; };
  const int rows = child.shape.rows, groups = (rows - first + row_group - 1) / row_group;
  const auto start = [&](int g) {
    int r = std::min(rows, first + g * row_group);
    while (r > first && r < rows && strip(r) == strip(r - 1))
      ++r;
    return r;
  };
  each_task(groups, products, [&](int g) { body(start(g), start(g + 1)); });
}

// Columns [j0, j1) of strips [t0, t1), less the products of columns [0, depth); columns right of the diagonal are left
// out. end(t): columns that strip t has. start(t): its column 0.
template <class Real, class End, class Start>
void subtract_block(const FrontShape<Real>& shape, const Real* panel, int t0, int t1, int j0, int j1, int depth,
                    bool fresh, const End& end, const Start& start) {
  const auto& kernels = front_kernels<Real>();
  for (int k = 0; k < depth; k += depth_at_once) {
    const int last = std::min(depth, k + depth_at_once);
    for (int t = t0; t < t1; t += 2) {
      const int count = std::min(2, t1 - t);
      Real* const to[2] = {start(t), start(t + count - 1)};
      const int both = std::min(j1, end(t));
      if (both > j0)
        kernels.subtract(shape, panel, t, count, j0, both, k, last, to, fresh && k == 0);
      if (const int more = std::min(j1, end(t + count - 1)), from = std::max(j0, both); more > from)
        kernels.subtract(shape, panel, t + 1, 1, from, more, k, last, to + 1, fresh && k == 0);
    }
  }
}

} // namespace

template <class Real> bool factor_panel(const FrontShape<Real>& shape, Real* panel) {
  constexpr int S = strip_rows<Real>;
  const auto& kernels = front_kernels<Real>();
  const int strips = shape.strips();
  for (int p = 0; p < shape.pivots; p += block) {
    const int q = std::min(p + block, shape.pivots), below = (q + S - 1) / S;
    const double entries = static_cast<double>(shape.rows - p) * (q - p);
    if (p > 0)
      each_group<Real>(p / S, strips, entries * p, [&](int t0, int t1) {
        subtract_block(
            shape, panel, t0, t1, p, q, p, false, [&](int t) { return S * (t + 1); },
            [&](int t) { return panel + shape.panel_strip(t); });
      });
    for (int t = p / S; t < below; ++t)
      if (!kernels.eliminate(shape, panel, p, q, t, 1))
        return false;
    each_group<Real>(below, strips, entries * (q - p), [&](int t0, int t1) {
      for (int t = t0; t < t1; t += 2)
        kernels.eliminate(shape, panel, p, q, t, std::min(2, t1 - t));
    });
  }
  return true;
}

template <class Real> void form_update(const FrontShape<Real>& shape, const Real* panel, Real* update) {
  constexpr int size = row_group / strip_rows<Real>;
  const int first = shape.first_update_column(), first_strip = shape.first_update_strip(), strips = shape.strips();
  const int rows = (strips - first_strip + size - 1) / size;
  const int columns = (shape.rows - first + column_group - 1) / column_group;
  const auto end = [&](int t) { return shape.update_columns_end(t); };
  const auto start = [&](int t) { return update + shape.update_strip(t); };
  const auto run = [&](int tile) {
    const int t0 = first_strip + tile / columns * size, t1 = std::min(strips, t0 + size);
    const int j = first + tile % columns * column_group;
    if (j < end(t1 - 1))
      subtract_block(shape, panel, t0, t1, j, j + column_group, shape.pivots, true, end, start);
  };
  each_task(rows * columns, 0.5 * shape.pivots * (shape.rows - first) * (shape.rows - first), run);
}

template <class Real>
void add_child_to_panel(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* panel) {
  const int first = child.shape.pivots, rows = child.shape.rows - first;
  each_group_of_child(child, first, static_cast<double>(rows) * child.in_panel,
                      [&](int r0, int r1) { front_kernels<Real>().add_to_panel(child, shape, panel, r0, r1); });
}

template <class Real>
void add_child_to_update(const ChildUpdate<Real>& child, const FrontShape<Real>& shape, Real* update) {
  const int first = child.shape.pivots + child.in_panel;
  const double rows = child.shape.rows - first;
  each_group_of_child(child, first, rows * rows,
                      [&](int r0, int r1) { front_kernels<Real>().add_to_update(child, shape, update, r0, r1); });
}

template bool factor_panel(const FrontShape<float>&, float*);
template bool factor_panel(const FrontShape<double>&, double*);
template void form_update(const FrontShape<float>&, const float*, float*);
template void form_update(const FrontShape<double>&, const double*, double*);
template void add_child_to_panel(const ChildUpdate<float>&, const FrontShape<float>&, float*);
template void add_child_to_panel(const ChildUpdate<double>&, const FrontShape<double>&, double*);
template void add_child_to_update(const ChildUpdate<float>&, const FrontShape<float>&, float*);
template void add_child_to_update(const ChildUpdate<double>&, const FrontShape<double>&, double*);

} // namespace sheet
