// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/whole_patches.h"

#include <algorithm>

#include "libsheet/flow/tear_cuts.h"
#include "libsheet/geometry/disjoint_sets.h"

namespace sheet::flow {

namespace {

// For each triangle, how many hang together with it across edges and go or stay as it does.
std::vector<std::size_t> sizes_of_parts(const Connectivity& mesh, const std::vector<bool>& taken) {
  DisjointSets sets(taken.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (const auto [s, t] = mesh.edge_triangles[e]; !mesh.on_rim(e) && taken[s] == taken[t])
      sets.join(s, t);
  const std::vector<std::uint64_t> part = sets.take();
  std::vector<std::size_t> count(taken.size(), 0), size;
  for (const std::uint64_t p : part)
    ++count[p];
  for (const std::uint64_t p : part)
    size.push_back(count[p]);
  return size;
}

// Vertices around which what stays is more than one fan: each has two edges with nothing on the other side.
std::vector<bool> pinched(const Connectivity& mesh, const std::vector<bool>& taken) {
  std::vector<int> ends(mesh.vertices, 0);
  const auto stays = [&](std::uint32_t t) { return t != no_index && !taken[t]; };
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (stays(mesh.edge_triangles[e][0]) != stays(mesh.edge_triangles[e][1]))
      for (const std::uint32_t v : mesh.edges[e])
        ++ends[v];
  std::vector<bool> pinched;
  for (const int count : ends)
    pinched.push_back(count > 2);
  return pinched;
}

} // namespace

void leave_whole_patches(const Connectivity& mesh, const std::function<bool(std::uint32_t)>& odd,
                         std::vector<bool>& taken) {
  for (bool changed = true; changed;) {
    const std::vector<std::size_t> size = sizes_of_parts(mesh, taken);
    std::vector<bool> wanted = pinched(mesh, taken); // vertices that want the triangles around them back
    for (std::uint32_t t = 0; t < taken.size(); ++t)
      if (!taken[t] && size[t] < crumb)
        for (const std::uint32_t v : mesh.triangles[t])
          wanted[v] = true;
    std::vector<std::uint32_t> back;
    for (std::uint32_t t = 0; t < taken.size(); ++t)
      if (taken[t] && (size[t] < crumb || odd(t) ||
                       std::ranges::any_of(mesh.triangles[t], [&](std::uint32_t v) { return wanted[v]; })))
        back.push_back(t);
    for (const std::uint32_t t : back)
      taken[t] = false;
    changed = !back.empty();
  }
}

} // namespace sheet::flow
