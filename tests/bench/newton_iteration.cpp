// SPDX-License-Identifier: GPL-3.0-or-later
// One Newton iteration (exact Hessian and gradient, factor in single precision, a product and a solution) of a square
// sheet with mid-edge bending, arcs, tension, weight and inertia, on one thread and on two, beside the same iteration
// with CHOLMOD's factor of the same matrix. Medians of processor and elapsed time [ms], and the memory held. Each size
// is a process of its own.
//   bench_newton_iteration [--repeat 5] [--cholmod-up-to 200000] [VERTICES...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "libsheet/base/parallel.h"
#include "libsheet/energy/model.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/linear/cholmod_library.h"
#include "libsheet/solve/linear_system.h"
#include "tests/support/cholesky.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

struct Time {
  double processor = 0, elapsed = 0; // [ms]
  Time operator+(const Time& other) const { return {processor + other.processor, elapsed + other.elapsed}; }
};

// Medians of `repeat` calls; the first one, which also waits for memory, does not count.
template <class Work> Time median_of(int repeat, const Work& work) {
  std::vector<double> processor, elapsed;
  for (int k = 0; k <= repeat; ++k) {
    timespec before{}, after{};
    const auto start = std::chrono::steady_clock::now();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    work();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    elapsed.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    processor.push_back(1e3 * static_cast<double>(after.tv_sec - before.tv_sec) +
                        1e-6 * static_cast<double>(after.tv_nsec - before.tv_nsec));
  }
  const auto median = [](std::vector<double> t) {
    t.erase(t.begin());
    std::nth_element(t.begin(), t.begin() + t.size() / 2, t.end());
    return t[t.size() / 2];
  };
  return {median(processor), median(elapsed)};
}

double peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

Model model_of_bench() {
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -9.81};
  m.liquid.surface_tension = 0.03;
  m.bending = Bending::mid_edge;
  m.arcs = true;
  return m;
}

// A square sheet of edge length 1 that stretches and bends, in the first stage of a step of 10 ms.
struct Problem {
  State state;
  Model model = model_of_bench();
  Terms terms;
  Unknowns u;

  explicit Problem(int vertices) {
    const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(vertices))) - 1);
    state = test::at_rest(test::rectangle(1, 1, n, n, 0.2), 0.01);
    terms = make_terms(model, state.mesh);
    for (std::size_t v = 0; v < state.positions.size(); ++v)
      state.velocities[v] =
          0.1 * Vector3(state.positions[v].y(), state.positions[v].z(), std::sin(5 * state.positions[v].x()));
  }
};

struct Row {
  const char* solver;
  Time analysis, assembly, factor, solution;
};

void print(std::size_t vertices, int threads, const Row& row, double kilobytes, double& iteration) {
  const Time sum = row.assembly + row.factor + row.solution;
  iteration = sum.elapsed;
  std::printf("%zu,%d,%s,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f\n", vertices, threads, row.solver,
              row.analysis.processor, row.analysis.elapsed, row.assembly.processor, row.assembly.elapsed,
              row.factor.processor, row.factor.elapsed, row.solution.processor, row.solution.elapsed, sum.processor,
              sum.elapsed, kilobytes / static_cast<double>(vertices));
  std::fflush(stdout);
}

void bench(int vertices, int repeat, bool with_cholmod) {
  Problem p(vertices);
  const std::size_t count = p.state.positions.size();
  const double before = peak_kilobytes();
  LinearSystem system;
  Cholesky cholesky;
  double held = 0;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Row own{"own", median_of(1, [&] { system.analyze(p.state.mesh, p.terms, true); }), {}, {}, {}};
    const Stage stage = first_stage(p.state, p.model.liquid, 0.01, 0.01, true);
    for (const auto& term : p.terms)
      term->begin(stage);
    Unknowns u = stage.begin;
    for (std::size_t v = 0; v < count; ++v)
      u.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
    Eigen::VectorXd gradient;
    bool good = true;
    own.assembly = median_of(repeat, [&] { (void)system.hessian(p.terms, u, gradient); });
    own.factor = median_of(repeat, [&] { good = system.factorize(0, Precision::single) && good; });
    const Eigen::VectorXd force = system.to_rows(gradient);
    Eigen::VectorXd x;
    own.solution = median_of(repeat, [&] {
      x = system.solve(force);
      (void)system.multiply(x);
    });
    if (held == 0)
      held = peak_kilobytes() - before;
    double iteration = 0, reference = 0;
    print(count, threads, own, held, iteration);
    if (!good)
      std::printf("# not positive definite\n");
    if (!with_cholmod)
      continue;
    Row other{"CHOLMOD", {}, own.assembly, {}, {}};
    other.analysis = median_of(1, [&] { cholesky.analyze(system.matrix()); });
    other.factor = median_of(repeat, [&] { good = cholesky.factorize(system.matrix(), 0) && good; });
    other.solution = median_of(repeat, [&] { x = cholesky.solve(force); });
    print(count, threads, other, peak_kilobytes() - before - held, reference);
    std::printf("# iteration: CHOLMOD's over own %.2f, factor and solution alone %.2f%s\n", reference / iteration,
                (other.factor + other.solution).elapsed / (own.factor + own.solution).elapsed,
                good ? "" : ", not positive definite");
  }
}

} // namespace

int main(int argc, char** argv) {
  int repeat = 5, largest_of_cholmod = 200000;
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) {
    const std::string a = argv[k];
    if ((a == "--repeat" || a == "--cholmod-up-to") && k + 1 < argc)
      (a == "--repeat" ? repeat : largest_of_cholmod) = std::max(1, std::atoi(argv[++k]));
    else if (const int n = std::atoi(argv[k]); n > 0)
      sizes.push_back(n);
    else {
      std::fprintf(stderr, "bench_newton_iteration [--repeat N] [--cholmod-up-to N] [VERTICES...]\n");
      return 2;
    }
  }
  if (sizes.empty())
    sizes = {5000, 15000, 50000, 200000};
  std::printf("# BLAS core %s, medians of %d\n", blas_core_name().c_str(), repeat);
  std::printf("vertices,threads,solver,analysis_cpu,analysis,assembly_cpu,assembly,factor_cpu,factor,solution_cpu,"
              "solution,iteration_cpu,iteration,kB_per_vertex\n");
  for (const int n : sizes) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      bench(n, repeat, n <= largest_of_cholmod + largest_of_cholmod / 20);
      std::fflush(stdout);
      _exit(0);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
      std::fprintf(stderr, "bench_newton_iteration: %d vertices ended with status %d\n", n, status);
      return 1;
    }
  }
}
