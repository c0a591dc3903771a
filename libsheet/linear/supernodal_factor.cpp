// SPDX-License-Identifier: GPL-3.0-or-later
// The multifrontal method: where everything lies, and in what order the fronts are eliminated.
#include "libsheet/linear/supernodal_factor.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <type_traits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include "libsheet/linear/dense_front.h"
#include "libsheet/linear/kept_buffer.h"
#include "libsheet/linear/supernodes.h"

namespace sheet {

namespace {
constexpr double task_part = 1.0 / 48; // of all products: subtrees below it are one task
constexpr double least_task = 2e6;     // products of a subtree that is never divided
constexpr std::size_t ahead = 1 << 14; // bytes of the next front that a solution asks for
constexpr int most_unknowns = 3;       // of a node, which has three or one
constexpr int fronts_at_once = 64;     // of a task that only places entries

// Numbers too small for full precision count as zero while it lives: processors are slow with them, and the factors of
// matrices with a strong diagonal are full of them in float. TBB carries this setting to the threads of a context.
class FlushToZero {
public:
  FlushToZero() : saved_(__builtin_ia32_stmxcsr()) { __builtin_ia32_ldmxcsr(saved_ | results | inputs); }
  ~FlushToZero() { __builtin_ia32_ldmxcsr(saved_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

private:
  static constexpr unsigned results = 0x8000, inputs = 0x0040;
  unsigned saved_;
};

constexpr auto carry_setting = tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings;
} // namespace

template <class Real> struct SupernodalFactor<Real>::Impl {
  using Shape = FrontShape<Real>;
  static constexpr int S = strip_rows<Real>;

  // Where a front's numbers lie.
  struct Place {
    std::size_t panel;  // in panels
    std::size_t vector; // of all its rows, in vectors
    std::size_t update; // in upper if `above` or the parent is, else in the task's stack
    std::size_t places; // of its update rows, in places
    int in_panel;       // how many of these are pivots of the parent
    bool above;         // not within a task's subtree
    bool shared;        // the update matrix lies in upper
  };

  // What is factorised.
  struct Matrix {
    const SparseLower& a;
    const Eigen::VectorXd& scale;
    Real shift;
  };

  NodeGraph graph;
  Supernodes symbolic;
  std::vector<Place> place;
  std::vector<int> tasks;      // fronts: roots of subtrees, and those above that have no children
  std::vector<int> task_first; // first front of each task's subtree
  std::vector<double> work;    // products of a front's subtree
  std::vector<std::size_t> stack[2], space;
  std::vector<char> odd; // depth of a front
  std::size_t stack_size[2] = {0, 0};
  std::vector<std::uint32_t> block_row; // of each entry of graph.later: its first row in the column's front
  KeptBuffer<std::uint32_t> places;     // rows of the parent's front
  KeptBuffer<Real> panels, upper;
  mutable KeptBuffer<Real> vectors;
  mutable std::vector<std::atomic<int>> waiting; // children of a front above that are not done
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> row_of_node; // in the front at work
  tbb::enumerable_thread_specific<KeptBuffer<Real>> stacks;
  mutable tbb::enumerable_thread_specific<KeptBuffer<Real>> sums;
  int widest = 0; // pivots

  [[nodiscard]] Shape shape(int s) const { return {symbolic.fronts[s].pivots, symbolic.fronts[s].rows}; }
  [[nodiscard]] int count() const { return static_cast<int>(symbolic.fronts.size()); }

  void divide_into_tasks();
  void plan_stacks();
  void plan_upper();
  void plan_fronts();
  void place_blocks();
  void place_front(int s, std::vector<std::uint32_t>& row_of);

  Real* update_of(int s, Real* stack_base) const {
    return (place[s].shared ? upper.data() : stack_base) + place[s].update;
  }
  ChildUpdate<Real> child(int c, Real* stack_base) const {
    return {shape(c), update_of(c, stack_base), places.data() + place[c].places, place[c].in_panel};
  }
  void scatter(const Matrix& matrix, int s) const;
  bool eliminate(const Matrix& matrix, int s, Real* stack_base) const;
  void ask_for(int s) const;
  void forward(int s, const Eigen::VectorXd& b) const;
  void backward(int s, Eigen::VectorXd& x) const;
  template <class Front> void upwards(const Front& front) const;
  template <class Front> void downwards(const Front& front) const;
};

// Subtrees of little work are tasks; what is above them waits for its children.
template <class Real> void SupernodalFactor<Real>::Impl::divide_into_tasks() {
  const auto& fronts = symbolic.fronts;
  work.assign(fronts.size(), 0);
  double all = 0;
  for (int s = 0; s < count(); ++s) {
    const double n = fronts[s].pivots, below = fronts[s].rows - n;
    const double own = n * (below * (below + n) / 2 + n * n / 6);
    work[s] += own;
    all += own;
    if (fronts[s].parent != -1)
      work[fronts[s].parent] += work[s];
  }
  const double most = std::max(least_task, task_part * all);
  tasks.clear();
  task_first.clear();
  int begin = 0; // of the subtree that the next task would have
  for (int s = 0; s < count(); ++s) {
    place[s].above = work[s] > most;
    const bool root = fronts[s].parent == -1 || work[fronts[s].parent] > most;
    place[s].shared = place[s].above || root;
    if (place[s].above ? fronts[s].children == 0 : root) {
      tasks.push_back(s);
      task_first.push_back(begin);
    }
    if (place[s].shared)
      begin = s + 1;
  }
  if (waiting.size() < fronts.size())
    waiting = std::vector<std::atomic<int>>(fronts.size() + fronts.size() / 4);
}

// Update matrices within a task lie on two stacks, of the even and of the odd depths: a front's is put on one while its
// children's are taken from the other, and nothing needs to be moved.
template <class Real> void SupernodalFactor<Real>::Impl::plan_stacks() {
  const auto& fronts = symbolic.fronts;
  odd.assign(fronts.size(), 0);
  for (int s = count() - 1; s >= 0; --s)
    if (fronts[s].parent != -1)
      odd[s] = !odd[fronts[s].parent];
  stack_size[0] = stack_size[1] = 0;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    std::size_t used[2] = {0, 0};
    for (int s = task_first[t]; s <= tasks[t]; ++s) {
      const int side = odd[s];
      if (!place[s].shared) {
        place[s].update = used[side];
        used[side] += static_cast<std::size_t>(shape(s).update_size());
        stack_size[side] = std::max(stack_size[side], used[side]);
      }
      if (!place[s].above)
        for (int i = 0; i < fronts[s].children; ++i)
          used[1 - side] -= static_cast<std::size_t>(shape(symbolic.children[fronts[s].first_child + i]).update_size());
    }
  }
  for (int s = 0; s < count(); ++s)
    if (!place[s].shared && odd[s])
      place[s].update += stack_size[0];
}

// Above the tasks a front's update matrix takes the place of its grandchildren's, which are used up by then.
template <class Real> void SupernodalFactor<Real>::Impl::plan_upper() {
  const auto& fronts = symbolic.fronts;
  space.assign(fronts.size(), 0); // first what the grandchildren take, then where they begin
  const auto grandparent = [&](int s) {
    const int up = fronts[s].parent;
    return up == -1 ? -1 : fronts[up].parent;
  };
  std::size_t all = 0;
  const auto need = [&](int s) { return std::max(space[s], static_cast<std::size_t>(shape(s).update_size())); };
  for (int s = 0; s < count(); ++s)
    if (place[s].shared && grandparent(s) != -1)
      space[grandparent(s)] += need(s);
  for (int s = count() - 1; s >= 0; --s)
    if (place[s].shared) {
      std::size_t& next = grandparent(s) == -1 ? all : space[grandparent(s)];
      place[s].update = next;
      next += need(s);
      space[s] = place[s].update;
    }
  upper.reserve(all);
}

template <class Real> void SupernodalFactor<Real>::Impl::plan_fronts() {
  std::size_t panel = 0, vector = 0, update_rows = 0;
  widest = 0;
  for (int s = 0; s < count(); ++s) {
    const Shape f = shape(s);
    if (static_cast<std::size_t>(f.panel_size()) > std::numeric_limits<std::uint32_t>::max())
      fail(ExitCode::internal, "a front of {} x {} is too big", f.rows, f.pivots);
    place[s].panel = panel;
    place[s].vector = vector;
    place[s].places = update_rows;
    panel += static_cast<std::size_t>(f.panel_size());
    vector += static_cast<std::size_t>(f.strips()) * S;
    update_rows += static_cast<std::size_t>(f.rows - f.pivots);
    widest = std::max(widest, f.pivots);
  }
  panels.reserve(panel);
  vectors.reserve(vector);
  places.reserve(update_rows);
  block_row.resize(graph.later.size());
}

// Where the blocks of the front's columns go, and the rows of its children. row_of: for each node, scratch.
template <class Real> void SupernodalFactor<Real>::Impl::place_front(int s, std::vector<std::uint32_t>& row_of) {
  const Supernode& f = symbolic.fronts[s];
  std::uint32_t row = 0;
  const auto number = [&](int node) {
    row_of[node] = row;
    row += static_cast<std::uint32_t>(symbolic.width_at[node]);
  };
  for (int k = f.first_node; k < f.end_node; ++k)
    number(k);
  for (std::size_t p = f.first_touched; p < f.end_touched; ++p)
    number(symbolic.touched[p]);
  for (int k = f.first_node; k < f.end_node; ++k) {
    std::uint32_t* out = block_row.data() + graph.start[symbolic.node_at[k]];
    for (const int other : symbolic.neighbours(k))
      *out++ = row_of[other];
  }
  for (int i = 0; i < f.children; ++i) {
    const int c = symbolic.children[f.first_child + i];
    const Supernode& child = symbolic.fronts[c];
    std::uint32_t* out = places.data() + place[c].places;
    int in_panel = 0;
    for (std::size_t p = child.first_touched; p < child.end_touched; ++p) {
      const int node = symbolic.touched[p], width = symbolic.width_at[node];
      for (int d = 0; d < width; ++d)
        *out++ = row_of[node] + static_cast<std::uint32_t>(d);
      in_panel += node < f.end_node ? width : 0;
    }
    place[c].in_panel = in_panel;
  }
}

template <class Real> void SupernodalFactor<Real>::Impl::place_blocks() {
  tbb::parallel_for(tbb::blocked_range<int>(0, count(), fronts_at_once), [&](const auto& range) {
    std::vector<std::uint32_t>& row_of = row_of_node.local();
    if (row_of.size() < symbolic.node_at.size())
      row_of.resize(symbolic.node_at.size());
    for (int s = range.begin(); s < range.end(); ++s)
      place_front(s, row_of);
  });
}

// The columns of the pivots, by blocks of two nodes.
template <class Real> void SupernodalFactor<Real>::Impl::scatter(const Matrix& matrix, int s) const {
  const Supernode& f = symbolic.fronts[s];
  const Shape front = shape(s);
  Real* const panel = panels.data() + place[s].panel;
  std::memset(panel, 0, sizeof(Real) * static_cast<std::size_t>(front.panel_size()));
  const double* const scale = matrix.scale.data();
  int pivot = 0; // the node's first
  for (int k = f.first_node; k < f.end_node; ++k) {
    const int node = symbolic.node_at[k], first = graph.first[node], width = graph.width(node);
    const double* from[most_unknowns]; // of each column, from the node's first row on
    for (int d = 0; d < width; ++d)
      from[d] = matrix.a.values.data() + matrix.a.starts[first + d] - d;
    Real* const column = panel + std::ptrdiff_t{S} * pivot;
    for (int d = 0; d < width; ++d)
      for (int r = d; r < width; ++r)
        column[front.panel_strip((pivot + r) / S) + (pivot + r) % S + std::ptrdiff_t{S} * d] =
            static_cast<Real>(from[d][r] * scale[first + d] * scale[first + r]);
    int above = width; // rows of the node's blocks that have been placed, counted in its first column
    for (int p = graph.start[node]; p < graph.start[node + 1]; ++p) {
      const int other = graph.later[p], rows = graph.width(other), row = static_cast<int>(block_row[p]);
      const double* const row_scale = scale + graph.first[other];
      Real* const to = column + front.panel_strip(row / S) + row % S;
      const auto whole = [&]<int Rows>(std::integral_constant<int, Rows>) {
        for (int d = 0; d < width; ++d)
          for (int r = 0; r < Rows; ++r)
            to[std::ptrdiff_t{S} * d + r] = static_cast<Real>(from[d][above + r] * scale[first + d] * row_scale[r]);
      };
      if (row % S + rows > S) // a strip ends within them
        for (int r = 0; r < rows; ++r) {
          Real* const part = column + front.panel_strip((row + r) / S) + (row + r) % S;
          for (int d = 0; d < width; ++d)
            part[std::ptrdiff_t{S} * d] = static_cast<Real>(from[d][above + r] * scale[first + d] * row_scale[r]);
        }
      else if (rows == 3)
        whole(std::integral_constant<int, 3>());
      else
        whole(std::integral_constant<int, 1>());
      above += rows;
    }
    pivot += width;
  }
  for (int k = 0; k < f.pivots; ++k)
    panel[front.panel_strip(k / S) + std::ptrdiff_t{S} * k + k % S] += matrix.shift;
}

template <class Real>
bool SupernodalFactor<Real>::Impl::eliminate(const Matrix& matrix, int s, Real* stack_base) const {
  const Supernode& f = symbolic.fronts[s];
  const Shape front = shape(s);
  Real* const panel = panels.data() + place[s].panel;
  scatter(matrix, s);
  const int* children = symbolic.children.data() + f.first_child;
  for (int i = 0; i < f.children; ++i)
    add_child_to_panel(child(children[i], stack_base), front, panel);
  if (!factor_panel(front, panel))
    return false;
  if (f.rows == f.pivots)
    return true;
  Real* const update = update_of(s, stack_base);
  form_update(front, panel, update);
  for (int i = 0; i < f.children; ++i)
    add_child_to_update(child(children[i], stack_base), front, update);
  return true;
}

// Calls front(s) for every front after its children.
template <class Real> template <class Front> void SupernodalFactor<Real>::Impl::upwards(const Front& front) const {
  const auto& fronts = symbolic.fronts;
  const FlushToZero flush;
  tbb::task_group_context context(tbb::task_group_context::bound, carry_setting);
  for (int s = 0; s < count(); ++s)
    if (place[s].above)
      waiting[s].store(fronts[s].children, std::memory_order_relaxed);
  const auto climb = [&](int t) {
    for (int s = task_first[t]; s <= tasks[t]; ++s)
      front(s);
    for (int s = fronts[tasks[t]].parent; s != -1 && waiting[s].fetch_sub(1) == 1; s = fronts[s].parent)
      front(s);
  };
  tbb::parallel_for(0, static_cast<int>(tasks.size()), climb, context);
}

// Calls front(s) for every front after its parent.
template <class Real> template <class Front> void SupernodalFactor<Real>::Impl::downwards(const Front& front) const {
  const auto& fronts = symbolic.fronts;
  std::vector<int> first_of(fronts.size(), -1), roots;
  for (std::size_t t = 0; t < tasks.size(); ++t)
    if (!place[tasks[t]].above)
      first_of[tasks[t]] = task_first[t];
  for (int s = 0; s < count(); ++s)
    if (fronts[s].parent == -1)
      roots.push_back(s);
  const FlushToZero flush;
  tbb::task_group_context context(tbb::task_group_context::bound, carry_setting);
  const auto descend = [&](int s, tbb::feeder<int>& feeder) {
    for (int k = s, end = first_of[s] == -1 ? s : first_of[s]; k >= end; --k)
      front(k);
    if (place[s].above)
      for (int i = 0; i < fronts[s].children; ++i)
        feeder.add(symbolic.children[fronts[s].first_child + i]);
  };
  tbb::parallel_for_each(roots.begin(), roots.end(), descend, context);
}

// The beginning of a panel from memory, while another front is solved.
template <class Real> void SupernodalFactor<Real>::Impl::ask_for(int s) const {
  const char* const panel = reinterpret_cast<const char*>(panels.data() + place[s].panel);
  const std::size_t bytes = std::min(ahead, sizeof(Real) * static_cast<std::size_t>(shape(s).panel_size()));
  for (std::size_t at = 0; at < bytes; at += 64)
    __builtin_prefetch(panel + at);
}

template <class Real> void SupernodalFactor<Real>::Impl::forward(int s, const Eigen::VectorXd& b) const {
  const Supernode& f = symbolic.fronts[s];
  Real* const x = vectors.data() + place[s].vector;
  std::memset(x, 0, sizeof(Real) * static_cast<std::size_t>(shape(s).strips()) * S);
  Real* out = x;
  for (int k = f.first_node; k < f.end_node; ++k) {
    const int node = symbolic.node_at[k];
    for (int c = graph.first[node]; c < graph.first[node + 1]; ++c)
      *out++ = static_cast<Real>(b[c]);
  }
  for (int i = 0; i < f.children; ++i) {
    const int c = symbolic.children[f.first_child + i];
    const Supernode& child = symbolic.fronts[c];
    const std::uint32_t* rows = places.data() + place[c].places;
    const Real* from = vectors.data() + place[c].vector + child.pivots;
    for (int r = 0; r < child.rows - child.pivots; ++r)
      x[rows[r]] += from[r];
  }
  if (s + 1 < count())
    ask_for(s + 1);
  front_kernels<Real>().forward(shape(s), panels.data() + place[s].panel, x);
}

template <class Real> void SupernodalFactor<Real>::Impl::backward(int s, Eigen::VectorXd& x) const {
  const Supernode& f = symbolic.fronts[s];
  Real* const own = vectors.data() + place[s].vector;
  if (f.parent != -1) {
    const std::uint32_t* rows = places.data() + place[s].places;
    const Real* from = vectors.data() + place[f.parent].vector;
    for (int r = f.pivots; r < f.rows; ++r)
      own[r] = from[*rows++];
  }
  KeptBuffer<Real>& scratch = sums.local();
  scratch.reserve(static_cast<std::size_t>(widest + S) * S);
  if (s > 0)
    ask_for(s - 1);
  front_kernels<Real>().backward(shape(s), panels.data() + place[s].panel, own, scratch.data());
  const Real* in = own;
  for (int k = f.first_node; k < f.end_node; ++k) {
    const int node = symbolic.node_at[k];
    for (int c = graph.first[node]; c < graph.first[node + 1]; ++c)
      x[c] = *in++;
  }
}

template <class Real> SupernodalFactor<Real>::SupernodalFactor() : impl_(std::make_unique<Impl>()) {}
template <class Real> SupernodalFactor<Real>::~SupernodalFactor() = default;
template <class Real> SupernodalFactor<Real>::SupernodalFactor(SupernodalFactor&&) noexcept = default;
template <class Real> SupernodalFactor<Real>& SupernodalFactor<Real>::operator=(SupernodalFactor&&) noexcept = default;

template <class Real> void SupernodalFactor<Real>::analyze(const NodeGraph& graph) {
  impl_->graph = graph;
  impl_->symbolic.analyze(graph);
  impl_->place.assign(impl_->symbolic.fronts.size(), {});
  impl_->divide_into_tasks();
  impl_->plan_stacks();
  impl_->plan_upper();
  impl_->plan_fronts();
  impl_->place_blocks();
}

template <class Real>
bool SupernodalFactor<Real>::factorize(const SparseLower& a, const Eigen::VectorXd& scale, double shift) {
  const typename Impl::Matrix matrix{a, scale, static_cast<Real>(shift)};
  std::atomic<bool> good = true;
  impl_->upwards([&](int s) {
    if (!good.load(std::memory_order_relaxed))
      return;
    Real* stack = nullptr;
    if (!impl_->place[s].above) {
      KeptBuffer<Real>& own = impl_->stacks.local();
      own.reserve(impl_->stack_size[0] + impl_->stack_size[1]);
      stack = own.data();
    }
    // A thread that waits for others to do parts of a front must not begin another subtree: its stack is in use.
    if (!tbb::this_task_arena::isolate([&] { return impl_->eliminate(matrix, s, stack); }))
      good = false;
  });
  return good;
}

template <class Real> Eigen::VectorXd SupernodalFactor<Real>::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size());
  impl_->upwards([&](int s) { impl_->forward(s, b); });
  impl_->downwards([&](int s) { impl_->backward(s, x); });
  return x;
}

template <class Real> double SupernodalFactor<Real>::flops() const {
  double sum = 0;
  for (const Supernode& f : impl_->symbolic.fronts)
    for (int k = 0; k < f.pivots; ++k)
      sum += static_cast<double>(f.rows - k) * (f.rows - k);
  return sum;
}

template <class Real> std::size_t SupernodalFactor<Real>::bytes() const {
  const Impl& i = *impl_;
  std::size_t sum = i.panels.bytes() + i.upper.bytes() + i.vectors.bytes() + i.places.bytes() +
                    sizeof(std::uint32_t) * i.block_row.size();
  for (const auto& stack : i.stacks)
    sum += stack.bytes();
  return sum;
}

template class SupernodalFactor<float>;
template class SupernodalFactor<double>;

} // namespace sheet
