// SPDX-License-Identifier: GPL-3.0-or-later
// Angles of triangles over whole runs in prescribed flows.
//   bench_remesh_flows [EDGE]            all flows; the edge length of the first is half of it (default 0.02)
//   bench_remesh_flows EDGE FLOW FILE    one flow, by its number from 0, with smoothing; its frames go to FILE
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <fmt/core.h>

#include "formats/cpp/stream_writer.h"
#include "libsheet/base/files.h"
#include "tests/support/remesh/flows.h"

namespace {

using sheet::test::FlowResult;

FlowResult run(const sheet::test::Flow& flow, bool smooth, bool safe,
               const std::function<void(const sheet::formats::Frame&)>& watch) {
  sheet::remesh::Options options;
  options.size.edge_length = flow.edge_length;
  options.smooth = smooth;
  options.intersections = safe;
  const FlowResult r = sheet::test::run_flow(flow, 0.5, options, watch);
  fmt::print("{},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{},{:.1e},{:.3f}\n", flow.name, smooth, safe, r.steps, r.triangles,
             r.edits, r.worst.smallest, r.worst.first_percentile, r.worst.largest, r.worst.excepted, r.volume_error,
             1e3 * r.seconds / static_cast<double>(r.steps));
  std::fflush(stdout);
  return r;
}

} // namespace

int main(int argc, char** argv) {
  const double edge = argc > 1 ? std::atof(argv[1]) : 0.02;
  const std::vector<sheet::test::Flow> flows = {sheet::test::vortex(edge / 2), sheet::test::extension(2 * edge),
                                                sheet::test::shear(2 * edge), sheet::test::inflation(edge),
                                                sheet::test::enright(edge)};
  fmt::print("flow,smoothing,safe,steps,triangles,edits,angle_min,angle_1_percent,angle_max,in_corners,volume_error,ms_"
             "per_step\n");
  if (argc > 3) {
    sheet::OutputFile file(argv[3], sheet::OutputFile::Content::binary);
    sheet::formats::StreamWriter writer(file.descriptor(), file.name());
    run(flows.at(std::stoul(argv[2])), true, true, [&](const sheet::formats::Frame& frame) { writer.write(frame); });
    writer.end();
    file.close();
    return 0;
  }
  for (const sheet::test::Flow& flow : flows)
    for (const bool smooth : {false, true})
      for (const bool safe : {false, true})
        run(flow, smooth, safe, {});
}
