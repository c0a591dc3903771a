// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of one Newton iteration (assemble, factorise, solve) over the numeric factorisation of its matrix alone, and of
// the analysis, by number of vertices and bending model. Processor time of the whole process, so that other load on the
// machine matters little: run with one thread for the ratios. newton_iteration [threads [repetitions]]
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <sys/resource.h>

#include "libsheet/base/parallel.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/solve/cholesky.h"
#include "libsheet/solve/newton.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Mean of `repetitions` calls, in milliseconds.
template <class F> double measure(int repetitions, F&& f) {
  const double start = processor_seconds();
  for (int k = 0; k < repetitions; ++k)
    f();
  return 1e3 * (processor_seconds() - start) / repetitions;
}

} // namespace

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1, repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  const ThreadLimit limit(threads);
  std::printf("BLAS core %s, %d thread(s), processor time, ms\n", blas_core_name().c_str(), threads);
  std::printf("vertices,bending,Mflop,analysis,exact,positive,factor,solve,product,gradient,value,peak_MB\n");
  for (const int n : {70, 122, 223})
    for (const std::string name : {"none", "hinge", "mid-edge", "mid-edge arcs"}) {
      State s = test::at_rest(test::rectangle(1, 1, n, n, 0.2), 0.01);
      Model m;
      m.viscosity = 100;
      m.density = 1000;
      m.gravity = {0, 0, -9.81};
      m.bending = name == "none" ? Bending::none : name == "hinge" ? Bending::hinge : Bending::mid_edge;
      m.arcs = name == "mid-edge arcs";
      const Terms terms = make_terms(m, s.mesh);
      std::unique_ptr<LinearSystem> system;
      const double analysis =
          measure(2, [&] { system = std::make_unique<LinearSystem>(s.mesh, terms, m.has_angles()); });
      for (std::size_t v = 0; v < s.positions.size(); ++v)
        s.velocities[v] = 0.1 * Vector3(s.positions[v].y(), s.positions[v].z(), std::sin(5 * s.positions[v].x()));
      const Stage stage = first_stage(s, 0.01, 0.01, m.has_angles());
      for (const auto& term : terms)
        term->begin(stage);
      Unknowns u = stage.begin;
      for (std::size_t v = 0; v < s.positions.size(); ++v)
        u.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
      Eigen::VectorXd gradient;
      const auto derivatives = [&](bool definite) { (void)system->hessian(terms, u, definite, gradient); };
      const double exact = measure(repetitions, [&] { derivatives(false); });
      const double positive = measure(repetitions, [&] { derivatives(true); });
      bool good = system->factorize(0, Precision::single);
      const double factor = measure(repetitions, [&] { good = system->factorize(0, Precision::single) && good; });
      Eigen::VectorXd rows = system->to_rows(gradient);
      const double solve = measure(repetitions, [&] { rows = system->solve(rows); });
      const double product = measure(repetitions, [&] { rows = system->multiply(rows); });
      const double slope = measure(repetitions, [&] { (void)system->gradient(terms, u, gradient); });
      const double value = measure(repetitions, [&] { (void)system->value(terms, u); });
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      std::printf("%zu,%s,%.0f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.0f%s\n", s.positions.size(), name.c_str(),
                  1e-6 * system->flops(), analysis, exact, positive, factor, solve, product, slope, value,
                  static_cast<double>(usage.ru_maxrss) / 1024, good ? "" : " NOT POSITIVE DEFINITE");
      const auto& seconds = system->assembly().seconds();
      for (std::size_t t = 0; t < seconds.size(); ++t)
        std::printf("    %-28s %.2f ms an evaluation\n", t < terms.size() ? terms[t]->name() : "gathering",
                    1e3 * seconds[t] / (2 * repetitions));
      std::fflush(stdout);
    }
}
