// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage of heat costs, for a triangle: on irregular squares whose faces radiate and are cooled by air. Medians
// of processor time [µs a triangle]: the first stage on a mesh (with the order of elimination and the analysis), a
// later one, one that conducts but does not radiate, one that conducts nothing; and iterations of Newton's method.
//   bench_heat [--threads 1] [--repeat 7] [--profile lumped|parabola|modes] [VERTICES...]
//   bench_heat errors    how far a stage and profiles are from closed forms: on irregular squares, across cooled slabs
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "libsheet/base/parallel.h"
#include "libsheet/heat/stage.h"
#include "tests/support/cooled_slab.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

template <class Work> double processor_time(const Work& work) { // [µs]
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
  };
  const double before = now();
  work();
  return now() - before;
}

double median(std::vector<double> times) {
  std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
  return times[times.size() / 2];
}

heat::Profile profile_of(const std::string& name) {
  if (name == "parabola")
    return heat::parabola();
  return name == "modes" ? heat::even_modes(3) : heat::uniform_profile();
}

void measure(int wanted, int repeat, const heat::Profile& profile) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(wanted))) - 1);
  const test::Mesh mesh = test::rectangle(1, 1, n, n, 0.2); // glass, of 3 mm
  const auto connectivity = std::make_shared<const Connectivity>(connect(mesh.positions.size(), mesh.triangles));
  const std::vector<Vector3> lengths = heat::squared_lengths_of(*connectivity, mesh.positions);
  std::vector<double> volumes, temperatures;
  for (const Corners& c : mesh.triangles) {
    const Vector3 &x = mesh.positions[c[0]], &y = mesh.positions[c[1]], &z = mesh.positions[c[2]];
    volumes.push_back(0.003 * (y - x).cross(z - x).norm() / 2);
    temperatures.push_back(900 + 100 * std::sin(9 * x.x()));
  }
  heat::Problem problem;
  problem.heat_capacity = 2500.0 * 1200;
  problem.duration = 0.1;
  problem.profile = profile;
  problem.squared_lengths = lengths;
  problem.volumes = volumes;
  problem.temperatures = temperatures;

  const auto triangles = static_cast<double>(mesh.triangles.size());
  std::vector<double> first, later, linear, local;
  int iterations = 0;
  for (int k = 0; k < repeat; ++k) {
    heat::Solver solver(connectivity);
    const auto time = [&] {
      return processor_time([&] { iterations = solver.stage(problem).iterations; }) / triangles;
    };
    problem.conductivity = 1;
    problem.surroundings = {{{20, 300, 0.9, 300}, {10, 300, 0.9, 400}}};
    first.push_back(time());
    later.push_back(time());
    const int of_radiation = iterations;
    problem.surroundings = {{{20, 300}, {10, 300}}};
    linear.push_back(time());
    problem.conductivity = 0;
    local.push_back(time());
    iterations = of_radiation;
  }
  std::printf("%zu,%zu,%.3f,%.3f,%.3f,%.3f,%d\n", mesh.positions.size(), mesh.triangles.size(), median(first),
              median(later), median(linear), median(local), iterations);
  std::fflush(stdout);
}

void print_errors() {
  std::printf("cells,shift,k t/(rho c),error\n");
  for (const double shift : {0.0, 0.15, 0.3})
    for (const double duration : {1e-3, 0.05, 10.0})
      for (const int cells : {16, 32, 64})
        std::printf("%d,%g,%g,%.2e\n", cells, shift, duration, heat::test::error_of_a_stage(cells, shift, duration));
  std::printf("Biot,profile,mean,points,viscosity,quarter points\n");
  const auto print = [](double biot, const char* name, const heat::Profile& profile) {
    const heat::test::ProfileErrors errors = heat::test::errors_of(profile, biot);
    std::printf("%g,%s,%.2g,%.2g,%.2g,%.2g\n", biot, name, errors.mean, errors.points, errors.viscosity,
                errors.quarter_viscosity);
  };
  for (const double biot : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    print(biot, "uniform", heat::uniform_profile());
    print(biot, "parabola", heat::parabola());
    for (const int modes : {2, 3, 4, 5})
      print(biot, (std::to_string(modes) + " modes").c_str(), heat::even_modes(modes));
  }
}

} // namespace

int main(int argc, char** argv) {
  int threads = 1, repeat = 7;
  std::string profile = "lumped";
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads" && i + 1 < argc)
      threads = std::atoi(argv[++i]);
    else if (word == "--repeat" && i + 1 < argc)
      repeat = std::atoi(argv[++i]);
    else if (word == "--profile" && i + 1 < argc)
      profile = argv[++i];
    else if (word == "errors") {
      print_errors();
      return 0;
    } else
      sizes.push_back(std::atoi(word.c_str()));
  }
  if (sizes.empty())
    sizes = {600, 2500, 10000, 40000};
  const ThreadLimit limit(threads);
  std::printf("vertices,triangles,first,later,linear,local,iterations\n");
  for (const int size : sizes)
    measure(size, repeat, profile_of(profile));
}
