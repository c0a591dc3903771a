// SPDX-License-Identifier: GPL-3.0-or-later
// Angles of triangles over whole runs in prescribed flows.   bench_remesh_flows [edge length, default 0.02]
#include <cstdlib>

#include <fmt/core.h>

#include "tests/support/remesh/flows.h"

int main(int argc, char** argv) {
  const double edge = argc > 1 ? std::atof(argv[1]) : 0.02;
  fmt::print(
      "flow,smoothing,safe,steps,triangles,edits,angle_min,angle_1_percent,angle_max,volume_error,ms_per_step\n");
  for (const auto& flow : {sheet::test::vortex(edge / 2), sheet::test::extension(2 * edge),
                           sheet::test::shear(2 * edge), sheet::test::inflation(edge), sheet::test::enright(edge)})
    for (const bool smooth : {false, true})
      for (const bool safe : {false, true}) {
        sheet::remesh::Options options;
        options.size.edge_length = flow.edge_length;
        options.smooth = smooth;
        options.intersections = safe;
        const auto r = sheet::test::run_flow(flow, 0.5, options);
        fmt::print("{},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{:.1e},{:.3f}\n", flow.name, smooth, safe, r.steps,
                   r.triangles, r.edits, r.worst.smallest, r.worst.first_percentile, r.worst.largest, r.volume_error,
                   1e3 * r.seconds / static_cast<double>(r.steps));
      }
}
