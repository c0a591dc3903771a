// SPDX-License-Identifier: GPL-3.0-or-later
// Continuous collision queries: missed collisions, false alarms, processor time per query.
//   bench_swept_pair [FOLDER] [N]
// FOLDER: the sample queries of [Wang et al. 2021, "A large-scale benchmark ... continuous collision detection"], CSV,
// eight rows a query (docs/collisions.md); "-" for none. N: number of random queries decided exactly (default 1000000).
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "libsheet/collide/swept_pair.h"
#include "tests/support/exact_touch.h"

namespace {

using namespace sheet;
using namespace sheet::collide;

// Of this thread [s]: other work on the machine disturbs it least.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Tally {
  int queries = 0, touching = 0, missed = 0, false_alarms = 0;
  double seconds = 0, worst = 0;

  void ask(const SweptPair& pair, bool touches) {
    const double start = processor_time();
    const bool found = first_contact(pair, {.gap = 0}).has_value();
    const double took = processor_time() - start;
    ++queries;
    touching += touches;
    missed += touches && !found;
    false_alarms += found && !touches;
    seconds += took;
    worst = std::max(worst, took);
  }
  void print(const std::string& name) const {
    fmt::print("{:<54} {:>9} {:>9} {:>7} {:>7} {:>9.2f} {:>9.1f}\n", name, queries, touching, missed, false_alarms,
               1e6 * seconds / queries, 1e6 * worst);
  }
};

void ask_file(const std::filesystem::path& path, std::map<std::string, Tally>& tallies) {
  const bool edges = path.filename().string().find("edge-edge") != std::string::npos;
  const std::string scene = path.filename().string().substr(0, 9) == "unit-test" ? "unit tests" : "simulations";
  std::ifstream file(path);
  std::string line;
  SweptPair pair;
  pair.features = edges ? Features::edge_edge : Features::vertex_triangle;
  for (std::size_t row = 0; std::getline(file, line); ++row) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Vector3 point;
    int truth = 0;
    for (int k = 0; k < 3; ++k) {
      std::string numerator, denominator;
      words >> numerator >> denominator;
      point[k] = std::stod(numerator) / std::stod(denominator);
    }
    words >> truth;
    (row % 8 < 4 ? pair.start : pair.end)[row % 4] = point;
    if (row % 8 == 7)
      tallies[scene + (edges ? ", edges" : ", vertex and triangle")].ask(pair, truth != 0);
  }
}

// Points at random integers up to `range`, times `spacing`, moved by up to `noise`: small ranges make queries that
// touch in an edge, a vertex, or in a plane; a little noise makes them nearly do so.
struct Lattice {
  int range, spacing, noise;
  const char* name;
};

void ask_random(int count, const Lattice& lattice, bool edges, std::map<std::string, Tally>& tallies) {
  std::mt19937_64 random(static_cast<std::uint64_t>(lattice.range) * 2 + edges);
  std::uniform_int_distribution<int> place(-lattice.range, lattice.range), move(-lattice.noise, lattice.noise);
  const auto coordinate = [&] { return lattice.spacing * place(random) + move(random); };
  int undecided = 0;
  const std::string name = fmt::format("{}{}", lattice.name, edges ? ", edges" : ", vertex and triangle");
  for (int i = 0; i < count; ++i) {
    std::array<test::IntegerPoint, 4> start, end;
    SweptPair pair;
    pair.features = edges ? Features::edge_edge : Features::vertex_triangle;
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t k = 0; k < 3; ++k) {
        pair.start[p][static_cast<Eigen::Index>(k)] = start[p][k] = coordinate();
        pair.end[p][static_cast<Eigen::Index>(k)] = end[p][k] = coordinate();
      }
    const test::Touch truth = test::exact_touch(edges, start, end);
    if (truth == test::Touch::undecided)
      ++undecided;
    else
      tallies[name].ask(pair, truth == test::Touch::yes);
  }
  fmt::print("# {}: {} of {} left out, undecided\n", name, undecided, count);
}

} // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : "-";
  const int count = argc > 2 ? std::atoi(argv[2]) : 1000000;
  std::map<std::string, Tally> tallies;
  if (folder != "-") {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".csv")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& path : files)
      ask_file(path, tallies);
  }
  for (const Lattice& lattice :
       {Lattice{1, 1, 0, "integers to 1"}, Lattice{3, 1, 0, "integers to 3"}, Lattice{10, 1, 0, "integers to 10"},
        Lattice{250, 1, 0, "integers to 250"}, Lattice{1, 250, 1, "250 times integers to 1, off by 1"}})
    for (const bool edges : {false, true})
      ask_random(count / 10, lattice, edges, tallies);
  fmt::print("{:<54} {:>9} {:>9} {:>7} {:>7} {:>9} {:>9}\n", "queries", "number", "touching", "missed", "false",
             "mean us", "worst us");
  bool missed = false;
  for (const auto& [name, tally] : tallies) {
    tally.print(name);
    missed = missed || tally.missed > 0;
  }
  return missed ? 1 : 0;
}
