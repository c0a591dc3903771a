// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of the parts of sheet-collide with the number of triangles, for a pile of wavy layers at 0.8 of the contact
// distance that are pressed together: every vertex has contacts, and some thousandth of the pairs hit.
//   bench_self_contact [MOST]     up to MOST triangles (default 200000); medians of 3 runs; processor time of all
// threads together, which other work on the machine disturbs least
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <random>
#include <vector>

#include <fmt/core.h>

#include "libsheet/collide/contact_springs.h"
#include "libsheet/collide/self_response.h"
#include "libsheet/scene/read.h"
#include "tests/support/meshes.h"

namespace {

using namespace sheet;
using namespace sheet::collide;

template <class Work> double median_cpu_ms(Work&& work) {
  std::array<double, 3> times{};
  for (double& time : times) {
    const std::clock_t start = std::clock();
    work();
    time = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::sort(times.begin(), times.end());
  return times[1];
}

struct Pile {
  std::vector<Vector3> start, end;
  std::vector<Corners> triangles;
  static constexpr double thickness = 0.01, edge = 0.02;

  Pile(int layers, int cells) {
    for (int layer = 0; layer < layers; ++layer) {
      const test::Mesh mesh = test::rectangle(cells * edge, cells * edge, cells, cells, 0.2);
      const auto first = static_cast<std::uint32_t>(start.size());
      for (const Vector3& x : mesh.positions)
        start.push_back(x + Vector3(0.3 * edge * layer, 0.2 * edge * layer,
                                    0.8 * thickness * layer + 0.05 * std::sin(10 * x.x()) * std::cos(8 * x.y())));
      for (const Corners& t : mesh.triangles)
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(0, 0.25 * thickness);
    for (const Vector3& x : start)
      end.push_back(x + Vector3(0.1, 0, normal(random)));
  }
};

} // namespace

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 200000;
  const Scene scene = parse_scene("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n"
                                  "[material]\nviscosity = 1\ndensity = 1000\n[contact]\n",
                                  "bench");
  fmt::print("{:>9} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>14}\n", "triangles", "hits", "springs", "check ms",
             "search ms", "respond", "near ms", "all/(n log2 n)");
  for (int cells = 16; 4 * 2 * cells * cells <= most; cells = cells * 7 / 5) {
    const Pile pile(4, cells);
    const Connectivity mesh = connect(pile.start.size(), pile.triangles);
    const SelfSearch unused(mesh); // each part starts with a search that has gathered nothing, but the last one, which
                                   // in a step follows the response
    std::optional<SelfSearch> search;
    const std::vector<double> reach(pile.start.size(), Pile::thickness);
    const double check = median_cpu_ms([&] { (void)SelfSearch(unused).crossing(pile.start); });
    std::size_t hits = 0, springs = 0;
    const double find = median_cpu_ms([&] { hits = SelfSearch(unused).hits(pile.start, pile.end, reach).size(); });
    std::vector<Vector3> safe;
    const double respond = median_cpu_ms([&] {
      StepPath path;
      path.end_time = 0.01;
      path.triangles = pile.triangles;
      path.start = pile.start;
      path.end = pile.end;
      path.velocity.assign(pile.start.size(), Vector3::Zero());
      path.mass.assign(pile.start.size(), 1);
      path.fixed.assign(pile.start.size(), 0);
      resolve_self(path, search.emplace(unused), reach);
      safe = path.end;
    });
    const double near = median_cpu_ms([&] {
      const std::vector<double> ones(pile.start.size(), 1);
      const SpringSheet sheet{pile.start, safe, reach, reach, ones, std::vector<Axes>(safe.size(), 0), 0.01};
      std::vector<ContactSpring> list;
      SelfSearch own(*search);
      add_springs(list, own, scene, sheet);
      springs = list.size();
    });
    const auto n = static_cast<double>(pile.triangles.size());
    fmt::print("{:>9} {:>8} {:>8} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>11.1f} ns\n", pile.triangles.size(), hits,
               springs, check, find, respond, near, 1e6 * (check + respond + near) / (n * std::log2(n)));
  }
  return 0;
}
