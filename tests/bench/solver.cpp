// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a time step and of its parts at 5,000, 15,000 and 50,000 vertices: one Newton iteration (assembly + factorise
// + solve) over the numeric factorisation alone, analysis over factorisation, the mid-edge step over the hinge step,
// each term's share, peak memory. Medians; models take turns step by step, so that a busy machine slows them all alike.
//   bench_solver [--steps 5] [--threads 1] [VERTICES...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "libsheet/base/parallel.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/linear/cholmod_library.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

struct Choice {
  const char* name;
  Bending bending;
  bool tension;
};
constexpr Choice choices[] = {{"membrane", Bending::none, false},
                              {"hinge", Bending::hinge, false},
                              {"mid-edge", Bending::mid_edge, false},
                              {"mid-edge with tension", Bending::mid_edge, true}};
constexpr std::size_t hinge = 1, with_tension = 3; // of these

// A square sheet of edge length 1 that sags between two held sides.
State sheet_of(int vertices) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(vertices))) - 1);
  return test::at_rest(test::rectangle(1, 1, n, n, 0.2), 0.01);
}

Model model_of(const Choice& choice, const State& s) {
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -9.81};
  m.liquid.surface_tension = choice.tension ? 0.03 : 0;
  m.bending = choice.bending;
  Hold hold;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (s.positions[v].x() == 0 || s.positions[v].x() == 1)
      hold.vertices.push_back(v);
  m.holds.push_back(hold);
  return m;
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() / 2];
}

double peak_megabytes(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

constexpr double step_length = 0.02; // [s]

// In a process of its own: peak memory of a step, less what the mesh alone needs.
double step_megabytes(const Choice& choice, int vertices) {
  int channel[2];
  if (pipe(channel) != 0)
    return 0;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    State s = sheet_of(vertices);
    const double before = peak_megabytes(RUSAGE_SELF);
    Stepper stepper(model_of(choice, s), {});
    stepper.step(s, step_length);
    const double used = peak_megabytes(RUSAGE_SELF) - before;
    const bool told = write(channel[1], &used, sizeof used) == sizeof used;
    _exit(told ? 0 : 1);
  }
  double used = 0;
  close(channel[1]);
  if (read(channel[0], &used, sizeof used) != sizeof used)
    used = 0;
  close(channel[0]);
  waitpid(child, nullptr, 0);
  return used;
}

void bench(int vertices, int steps, const std::vector<double>& memory) {
  struct Sample {
    std::vector<double> analysis, assembly, factor, solve, search, step, over_factor;
    std::vector<TermTime> terms;
    double later_analysis = 0;
    int iterations = 0, factorizations = 0;
  };
  std::vector<Stepper> steppers;
  std::vector<State> states;
  std::vector<Sample> samples(std::size(choices));
  for (const Choice& choice : choices) {
    states.push_back(sheet_of(vertices));
    steppers.emplace_back(model_of(choice, states.back()), StepOptions{});
  }
  for (int k = 0; k <= steps; ++k)
    for (std::size_t c = 0; c < steppers.size(); ++c) {
      const auto before = std::chrono::steady_clock::now();
      const StepReport r = steppers[c].step(states[c], step_length);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
      Sample& s = samples[c];
      if (k == 0) {
        s.analysis.push_back(r.seconds_analysis);
        continue;
      }
      const NewtonReport& t = r.newton;
      const double f = t.seconds_factor / t.factorizations, a = t.seconds_assembly / t.factorizations,
                   b = t.seconds_solve / t.iterations;
      s.assembly.push_back(a), s.factor.push_back(f), s.solve.push_back(b);
      s.search.push_back(t.seconds_search / t.iterations);
      s.over_factor.push_back((a + f + b) / f);
      s.step.push_back(seconds);
      s.later_analysis += r.seconds_analysis;
      s.terms = r.terms;
      s.iterations += t.iterations, s.factorizations += t.factorizations;
    }
  for (int k = 0; k < steps; ++k)
    for (std::size_t c = 0; c < steppers.size(); ++c) {
      const Model& m = steppers[c].model();
      const LinearSystem system(states[c].mesh, make_terms(m, states[c].mesh), m.has_angles());
      samples[c].analysis.push_back(system.seconds_analysis());
    }
  for (std::size_t c = 0; c < steppers.size(); ++c) {
    const Sample& s = samples[c];
    std::printf("%zu,%s,%.1f,%.2f,%.2f,%.2f,%.2f,%.3f,%.3f,%.3f,%.1f,%.3f,%.1f,%.1f\n", states[c].positions.size(),
                choices[c].name, static_cast<double>(s.iterations) / steps, 1e3 * median(s.assembly),
                1e3 * median(s.factor), 1e3 * median(s.solve), 1e3 * median(s.search), median(s.over_factor),
                median(s.analysis) / median(s.factor), s.later_analysis, 1e3 * median(s.step),
                median(s.step) / median(samples[hinge].step), memory[c],
                1024 * memory[c] / static_cast<double>(states[c].positions.size()));
    std::fflush(stdout);
  }
  std::printf("# shares of a step's element work, %s:", choices[with_tension].name);
  double sum = 0;
  for (const TermTime& t : samples[with_tension].terms)
    sum += t.seconds;
  for (const TermTime& t : samples[with_tension].terms)
    std::printf(" %s %.1f %%;", t.name.c_str(), 100 * t.seconds / sum);
  std::printf("\n");
}

} // namespace

int main(int argc, char** argv) {
  int steps = 5, threads = 1;
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) {
    const std::string a = argv[k];
    if ((a == "--steps" || a == "--threads") && k + 1 < argc)
      (a == "--steps" ? steps : threads) = std::max(1, std::atoi(argv[++k]));
    else if (const int n = std::atoi(argv[k]); n > 0)
      sizes.push_back(n);
    else {
      std::fprintf(stderr, "bench_solver [--steps N] [--threads N] [VERTICES...]\n");
      return 2;
    }
  }
  if (sizes.empty())
    sizes = {5000, 15000, 50000};
  const ThreadLimit limit(threads);
  std::printf("# BLAS core %s, %d threads, medians of %d SDIRK2 steps\n", blas_core_name().c_str(), threads, steps);
  std::printf("vertices,model,newton_per_step,assembly_ms,factor_ms,solve_ms,search_ms,iteration_over_factor,"
              "analysis_over_factor,analysis_later_s,step_ms,step_over_hinge_step,peak_MB,kB_per_vertex\n");
  std::vector<std::vector<double>> memory; // first, while this process is small: a child starts with its parent's peak
  for (const int n : sizes)
    for (auto* of_size = &memory.emplace_back(); const Choice& choice : choices)
      of_size->push_back(step_megabytes(choice, n));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    bench(sizes[k], steps, memory[k]);
}
