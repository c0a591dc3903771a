// SPDX-License-Identifier: GPL-3.0-or-later
// What refine/coarsen cycles keep, as CSV: relative changes of volume, enclosed volume, area, momentum, angular
// momentum, the range of the thickness, the width of a step of thickness in edges, and pairs of triangles that
// intersect.
//   bench_remesh_cycles [CYCLES, default 1000] [NAME]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <fmt/core.h>

#include "libsheet/measure/intersections.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/cycles.h"
#include "tests/support/remesh/flows.h"

namespace {

using namespace sheet;

struct Case {
  std::string name;
  TriangleMesh mesh;
  double edge_length;
  std::function<double(const Vector3&)> thickness;
};

MeshOptions edges(double length) {
  MeshOptions options;
  options.edge_length = length;
  return options;
}

// Width of a step between the thicknesses `low` and `high` across x, as if it were a ramp, over which the mean of
// (h - low) (high - h) is a sixth of the step's square [m]. The square is 1 wide.
double step_width(const formats::Frame& frame, double low, double high) {
  double sum = 0;
  const auto x = positions(frame);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const double area = 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm(), h = volumes(frame)[t] / area;
    sum += 6 * area * (h - low) * (high - h) / ((high - low) * (high - low));
  }
  return sum;
}

std::uint64_t intersecting_pairs(const formats::Frame& frame) {
  const std::vector<bool> usable(frame.triangles, true);
  return find_intersections(positions(frame), triangles(frame), usable, 1).count;
}

} // namespace

int main(int argc, char** argv) {
  const int cycles = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::string only = argc > 2 ? argv[2] : ""; // the names that start so
  const auto even = [](const Vector3&) { return 0.01; };
  const std::vector<Case> cases = {
      {"sphere", make_sphere(1, edges(0.15)), 0.15, even},
      {"torus", test::torus(1, 0.4, 48, 20), 0.12, even},
      {"wrinkled 7 edges a wave", test::wrinkled(0.02, 0.015), 0.02, even},
      {"wrinkled 5 edges a wave (half)", test::wrinkled(0.0285, 0.015, 0.5), 0.0285, even},
      {"wrinkled 10 edges a wave (half)", test::wrinkled(0.0143, 0.015, 0.5), 0.0143, even},
      {"wrinkled 14 edges a wave (half)", test::wrinkled(0.01, 0.015, 0.5), 0.01, even},
      {"step", make_rectangle(1, 1, edges(0.04)), 0.04, [](const Vector3& x) { return x[0] < 0 ? 0.01 : 0.02; }},
      {"two caps", test::two_caps(0.1, 0.005), 0.1, even},
      {"z fold", test::z_fold(0.05, 0.005), 0.05, even},
  };
  fmt::print(
      "case,cycle,edits,triangles,volume,enclosed,area,momentum,angular_momentum,energy,thickness_min,thickness_max,"
      "step_width,intersections\n");
  for (const Case& c : cases) {
    if (!c.name.starts_with(only))
      continue;
    formats::Frame frame = test::frame_of(c.mesh, 1);
    for (Vector3& x : positions(frame)) // an open sheet's volume is that below, and small
      x[2] += c.name.starts_with("wrinkled") ? 0.015 : 0;
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const Corners& k = triangles(std::as_const(frame))[t];
      const auto x = positions(std::as_const(frame));
      volumes(frame)[t] *= c.thickness((x[k[0]] + x[k[1]] + x[k[2]]) / 3);
    }
    for (std::size_t v = 0; v < frame.vertices; ++v) {
      const Vector3 x = positions(std::as_const(frame))[v];
      velocities(frame)[v] = {std::sin(3 * x[0]) + x[1], std::cos(2 * x[1]), x[0] * x[1] + 0.5};
    }
    remesh::Options options;
    options.size.edge_length = c.edge_length;
    options.smooth = true;
    const test::Account start = test::account_of(frame);
    std::uint64_t edits = 0;
    const double closed = std::abs(start.enclosed);
    for (int i = 1; i <= cycles; ++i) {
      edits += test::cycle(frame, options);
      if (i != 1 && i != 10 && i != 100 && i != cycles && i % 250 != 0)
        continue;
      const test::Account now = test::account_of(frame);
      fmt::print("{},{},{},{},{:.1e},{:.2e},{:.2e},{:.1e},{:.1e},{:.4f},{:.10g},{:.10g},{:.2f},{}\n", c.name, i, edits,
                 frame.triangles, now.volume / start.volume - 1, (now.enclosed - start.enclosed) / closed,
                 now.area / start.area - 1, (now.momentum - start.momentum).norm() / start.speed_sum,
                 (now.angular_momentum - start.angular_momentum).norm() / start.speed_sum,
                 now.kinetic_energy / start.kinetic_energy, now.thickness_min, now.thickness_max,
                 c.name == "step" ? step_width(frame, 0.01, 0.02) / c.edge_length : 0.0, intersecting_pairs(frame));
      std::fflush(stdout);
    }
  }
}
