// SPDX-License-Identifier: GPL-3.0-or-later
// Linear solvers on the structure of a square sheet's matrix (mid-edge bending with tension, as in bench_solver):
// ordering, symbolic analysis, the first factorisation after it, a later one, and a solution, by CHOLMOD and by the
// multifrontal factor in float and double. Medians of processor and elapsed time [ms], and the exponent by which the
// processor time of factorising grows with the number of vertices.
//   bench_factor [--threads 1] [--repeat 7] [--without-cholmod] [VERTICES...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "libsheet/base/parallel.h"
#include "libsheet/energy/assembly.h"
#include "libsheet/energy/model.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/linear/cholmod_library.h"
#include "libsheet/linear/elimination_order.h"
#include "libsheet/linear/supernodal_factor.h"
#include "tests/support/cholesky.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

constexpr int solutions = 3; // after each factorisation

struct Time {
  double processor = 0, elapsed = 0; // [ms]
};

template <class Work> Time time_of(const Work& work) {
  const auto processor = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
  };
  const double before = processor();
  const auto start = std::chrono::steady_clock::now();
  work();
  return {processor() - before,
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()};
}

Time median(std::vector<Time> t) {
  const auto middle = [&](double Time::*part) {
    std::nth_element(t.begin(), t.begin() + t.size() / 2, t.end(),
                     [&](const Time& a, const Time& b) { return a.*part < b.*part; });
    return t[t.size() / 2].*part;
  };
  return {middle(&Time::processor), middle(&Time::elapsed)};
}

struct Problem {
  std::size_t vertices;
  Time ordering;
  SparseLower matrix;
  NodeGraph graph;
};

// A square sheet of edge length 1. Values are those of a weighted Laplacian, whose factor decays as slowly as a
// sheet's.
Problem problem_of(int wanted, int repeat) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(wanted))) - 1);
  const State s = test::at_rest(test::rectangle(1, 1, n, n, 0.2), 0.01);
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = Vector3(0, 0, -9.81);
  m.liquid.surface_tension = 0.03;
  m.bending = Bending::mid_edge;
  Assembly assembly(s.mesh, make_terms(m, s.mesh), true);
  const std::vector<Edge> graph = assembly.vertex_graph();
  std::vector<std::uint32_t> order;
  std::vector<Time> ordering;
  for (int k = 0; k < repeat; ++k)
    ordering.push_back(time_of([&] { order = elimination_order(s.positions.size(), graph); }));
  assembly.set_order(order);
  SparseLower a = assembly.pattern().structure();
  std::vector<double> sums(static_cast<std::size_t>(a.size), 1e-4);
  for (int c = 0; c < a.size; ++c)
    for (int p = a.starts[c] + 1; p < a.starts[c + 1]; ++p) {
      a.values[p] = -0.02 - 0.01 * std::sin(p);
      sums[c] -= a.values[p];
      sums[a.rows[p]] -= a.values[p];
    }
  for (int c = 0; c < a.size; ++c)
    a.values[a.starts[c]] = sums[c];
  return {s.positions.size(), median(ordering), std::move(a), assembly.pattern().node_graph()};
}

struct Result {
  Time analysis, first, next, solve;
  double residual = 0, flops = 0;
};

Eigen::VectorXd residual(const SparseLower& a, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  Eigen::VectorXd r = b;
  for (int c = 0; c < a.size; ++c)
    for (int p = a.starts[c]; p < a.starts[c + 1]; ++p) {
      r[a.rows[p]] -= a.values[p] * x[c];
      if (a.rows[p] != c)
        r[c] -= a.values[p] * x[a.rows[p]];
    }
  return r;
}

void analyze(Cholesky& solver, const Problem& p) { solver.analyze(p.matrix); }
template <class Real> void analyze(SupernodalFactor<Real>& solver, const Problem& p) { solver.analyze(p.graph); }
bool factorize(Cholesky& solver, const Problem& p) { return solver.factorize(p.matrix, 0); }
template <class Real> bool factorize(SupernodalFactor<Real>& solver, const Problem& p) {
  return solver.factorize(p.matrix, Eigen::VectorXd::Ones(p.matrix.size), 0);
}

template <class Solver> Result measure(Solver& solver, const Problem& p, int repeat) {
  const SparseLower& a = p.matrix;
  Result result;
  std::vector<Time> analysis, first, next, solve;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(a.size, -1, 1);
  Eigen::VectorXd x;
  bool good = true;
  for (int k = 0; k <= repeat; ++k) { // the first round, which also waits for memory, does not count
    const Time t = time_of([&] { analyze(solver, p); });
    const Time f = time_of([&] { good = factorize(solver, p) && good; });
    if (k == 0 && repeat > 1)
      continue;
    analysis.push_back(t);
    first.push_back(f);
    next.push_back(time_of([&] { good = factorize(solver, p) && good; }));
    for (int i = 0; i < solutions; ++i)
      solve.push_back(time_of([&] { x = solver.solve(b); }));
  }
  result.analysis = median(analysis);
  result.first = median(first);
  result.next = median(next);
  result.solve = median(solve);
  result.residual = good ? residual(a, x, b).norm() / b.norm() : -1;
  result.flops = solver.flops();
  return result;
}

void print(const Problem& p, const char* name, const Result& r, double bytes, double growth) {
  std::printf("%zu,%s,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.1e,%.3g,%.2f,%.2f\n", p.vertices, name,
              p.ordering.processor, p.ordering.elapsed, r.analysis.processor, r.analysis.elapsed, r.first.processor,
              r.first.elapsed, r.next.processor, r.next.elapsed, r.solve.processor, r.solve.elapsed, r.residual,
              1e-9 * r.flops, bytes / 1024 / static_cast<double>(p.vertices), growth);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  int repeat = 7, threads = 1;
  bool cholmod = true;
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) {
    const std::string a = argv[k];
    if ((a == "--repeat" || a == "--threads") && k + 1 < argc)
      (a == "--repeat" ? repeat : threads) = std::max(1, std::atoi(argv[++k]));
    else if (a == "--without-cholmod")
      cholmod = false;
    else if (const int n = std::atoi(argv[k]); n > 0)
      sizes.push_back(n);
    else {
      std::fprintf(stderr, "bench_factor [--threads N] [--repeat N] [--without-cholmod] [VERTICES...]\n");
      return 2;
    }
  }
  if (sizes.empty())
    sizes = {5000, 15000, 50000};
  const ThreadLimit limit(threads);
  std::printf("# BLAS core %s, %d threads, medians of %d\n", blas_core_name().c_str(), threads, repeat);
  std::printf("vertices,solver,order_cpu,order,analysis_cpu,analysis,first_cpu,first,next_cpu,next,solve_cpu,solve,"
              "residual,gigaflops,kB_per_vertex,growth\n");
  std::vector<double> last(3, 0); // processor time of factorising the size before
  double vertices = 0;
  Cholesky cholesky;
  SupernodalFactor<float> single;
  SupernodalFactor<double> full;
  for (const int n : sizes) {
    const Problem p = problem_of(n, repeat);
    const auto report = [&](int solver, const char* name, const Result& r, double bytes) {
      const double now = r.next.processor;
      print(p, name, r, bytes,
            vertices > 0 ? std::log(now / last[solver]) / std::log(static_cast<double>(p.vertices) / vertices) : 0);
      last[solver] = now;
    };
    if (cholmod) {
      const Result r = measure(cholesky, p, repeat);
      report(0, "CHOLMOD", r, 8 * cholesky.factor_entries());
    }
    const Result f = measure(single, p, repeat), d = measure(full, p, repeat);
    report(1, "float", f, static_cast<double>(single.bytes()));
    report(2, "double", d, static_cast<double>(full.bytes()));
    vertices = static_cast<double>(p.vertices);
  }
}
