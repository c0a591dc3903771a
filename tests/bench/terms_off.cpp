// SPDX-License-Identifier: GPL-3.0-or-later
// What a term costs that is there, and that it costs nothing where it is not: the time of one Newton iteration
// (assembly, factorisation, solution) with all terms, and with each one switched off, beside the share that the terms'
// own clocks tell (what sheet-step -v prints). Processor time, medians of turns in which every variant runs once, so
// that other load on the machine matters little. CSV.
//   bench_terms_off [VERTICES [TURNS]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>

#include "libsheet/base/parallel.h"
#include "libsheet/energy/model.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/linear/cholmod_library.h"
#include "libsheet/solve/newton.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double least(const std::vector<double>& x) { return *std::min_element(x.begin(), x.end()); }

struct Variant {
  std::string off;
  Terms terms;
  std::unique_ptr<LinearSystem> system;
  Stage stage;
  Unknowns u;
  std::vector<double> assembly, rest;
  std::vector<std::vector<double>> by_term; // seconds of an evaluation, for each turn
};

void prepare(Variant& v, const State& s, const Model& m) {
  v.terms = make_terms(m, s.mesh);
  v.system = std::make_unique<LinearSystem>(s.mesh, v.terms, m.has_angles());
  v.stage = first_stage(s, m.liquid, 0.01, 0.01, m.has_angles());
  for (const auto& term : v.terms)
    term->begin(v.stage);
  v.u = v.stage.begin;
  for (std::size_t k = 0; k < s.positions.size(); ++k)
    v.u.segment<3>(static_cast<Eigen::Index>(3 * k)) = v.stage.predicted[k];
}

void iterate(Variant& v) {
  Eigen::VectorXd gradient;
  LinearSystem& system = *v.system;
  const std::vector<double> before = system.assembly().seconds();
  system.constrain({}, 1e-10);
  (void)system.gradient(v.terms, v.u, gradient);
  const double start = processor_seconds();
  system.find_positive_form(v.terms, v.u);
  const double assembled = processor_seconds();
  if (!system.factorize(0, Precision::single))
    std::printf("# not positive definite without %s\n", v.off.c_str());
  gradient = system.solve(system.to_rows(gradient));
  v.rest.push_back(processor_seconds() - assembled);
  v.assembly.push_back(assembled - start);
  v.by_term.resize(before.size());
  for (std::size_t t = 0; t < before.size(); ++t)
    v.by_term[t].push_back(system.assembly().seconds()[t] - before[t]);
}

} // namespace

int main(int argc, char** argv) {
  const int vertices = argc > 1 ? std::atoi(argv[1]) : 15000, turns = argc > 2 ? std::atoi(argv[2]) : 31;
  const ThreadLimit limit(1);
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(vertices))) - 1);
  State s = test::at_rest(test::rectangle(1, 1, n, n, 0.2), 0.01);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    s.velocities[v] = 0.1 * Vector3(s.positions[v].y(), s.positions[v].z(), std::sin(5 * s.positions[v].x()));
  Model all;
  all.liquid.viscosity = 100;
  all.liquid.density = 1000;
  all.gravity = {0, 0, -9.81};
  all.liquid.surface_tension = 0.03;
  all.bending = Bending::mid_edge;
  all.bath = BathLiquid{1200, 0};
  std::vector<Variant> variants(6);
  const char* names[] = {"nothing", "bending", "surface tension", "inertia", "bath", "gravity and bath"};
  for (std::size_t k = 0; k < variants.size(); ++k) {
    Model m = all;
    if (k == 1)
      m.bending = Bending::none;
    else if (k == 2)
      m.liquid.surface_tension = 0;
    else if (k == 3)
      m.inertia = false;
    else if (k >= 4)
      m.bath.reset();
    if (k == 5)
      m.gravity.setZero();
    variants[k].off = names[k];
    prepare(variants[k], s, m);
  }
  for (int turn = 0; turn < turns; ++turn)
    for (Variant& v : variants)
      iterate(v);
  const double whole = least(variants[0].assembly) + least(variants[0].rest);
  std::printf("# %zu vertices, BLAS core %s, one thread, the least of %d turns; shares of the whole iteration\n",
              s.positions.size(), blas_core_name().c_str(), turns);
  std::printf("off,assembly_ms,factor_and_solve_ms,assembly_saved_share\n");
  for (const Variant& v : variants)
    std::printf("%s,%.2f,%.2f,%.4f\n", v.off.c_str(), 1e3 * least(v.assembly), 1e3 * least(v.rest),
                (least(variants[0].assembly) - least(v.assembly)) / whole);
  std::printf("term,ms,share_by_its_own_clock\n");
  for (std::size_t t = 0; t < variants[0].by_term.size(); ++t) {
    const double seconds = least(variants[0].by_term[t]);
    std::printf("%s,%.2f,%.4f\n", t < variants[0].terms.size() ? variants[0].terms[t]->name() : "gathering",
                1e3 * seconds, seconds / whole);
  }
}
