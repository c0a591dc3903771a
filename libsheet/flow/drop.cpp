// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/drop.h"

#include <algorithm>

#include "libsheet/flow/cracks.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::flow {

Dropped drop(formats::Frame& frame, std::vector<bool> leaves, const Scene& scene, const BeforeLeaving& before) {
  const Connectivity mesh = connect(frame.vertices, triangles(static_cast<const formats::Frame&>(frame)));
  const auto x = positions(static_cast<const formats::Frame&>(frame));
  for (;;) {
    std::vector<bool> cut(mesh.edges.size(), false);
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
      cut[e] = !mesh.on_rim(e) && leaves[mesh.edge_triangles[e][0]] != leaves[mesh.edge_triangles[e][1]];
    const Fans fans = take_apart(mesh, cut);
    const std::vector<Vector3> opened = open_clear_cracks(mesh, fans, leaves, x);
    const std::vector<bool> crossing = crossing_at(mesh, x, fans, opened, leaves);
    bool any = false;
    for (std::size_t t = 0; t < leaves.size(); ++t)
      if (leaves[t] && std::ranges::any_of(mesh.triangles[t], [&](std::uint32_t v) { return crossing[v]; })) {
        leaves[t] = false;
        any = true;
      }
    if (any)
      continue;
    const Dropped dropped = sum_of(frame, leaves, scene);
    if (dropped.triangles > 0) {
      if (before)
        before(leaves);
      put_fans(frame, fans, leaves, opened);
    }
    return dropped;
  }
}

} // namespace sheet::flow
