// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/contact_dates.h"

#include <algorithm>

#include "libsheet/sheet/contact_spring.h"

namespace sheet::flow {

namespace {

std::vector<Dates> own_dates(const formats::Frame& frame, const Connectivity& mesh,
                             std::span<const TriangleArea> areas) {
  std::vector<Vector3> normal(mesh.vertices, Vector3::Zero());
  for (std::size_t t = 0; t < areas.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      normal[v] += areas[t].area * areas[t].normal;
  std::vector<Dates> dates(mesh.vertices, {ContactSpring::undated, ContactSpring::undated});
  for (const ContactSpring& s : read_springs(frame)) {
    const double since = s.since == ContactSpring::undated ? frame.time : s.since;
    for (std::size_t i = 0; i < 4; ++i) {
      if (s.weights[i] == 0)
        continue;
      const bool first = i < s.second_feature(); // to which the spring's normal points from the second one
      const bool positive = (s.normal.dot(normal[s.vertices[i]]) > 0) != first;
      double& date = dates[s.vertices[i]][positive ? 0 : 1];
      date = std::min(date, since);
    }
  }
  return dates;
}

} // namespace

std::vector<Dates> contact_dates(const formats::Frame& frame, const Connectivity& mesh,
                                 std::span<const TriangleArea> areas) {
  const std::vector<Dates> own = own_dates(frame, mesh, areas);
  std::vector<Dates> dates = own;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<double> youngest(mesh.vertices, ContactSpring::always), youngest_dated = youngest;
    for (const auto& [a, b] : mesh.edges)
      for (const auto& [v, neighbour] : {Edge{a, b}, Edge{b, a}}) {
        const double date = own[neighbour][side];
        youngest[v] = std::max(youngest[v], date);
        if (date != ContactSpring::undated)
          youngest_dated[v] = std::max(youngest_dated[v], date);
      }
    for (std::size_t v = 0; v < own.size(); ++v)
      if (own[v][side] != ContactSpring::undated)
        dates[v][side] = std::min(own[v][side], youngest[v]);
      else if (youngest_dated[v] != ContactSpring::always)
        dates[v][side] = youngest_dated[v];
  }
  return dates;
}

} // namespace sheet::flow
