// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/deposit.h"

#include <map>
#include <utility>

#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/sheet/transfer.h"

namespace sheet::flow {

using formats::Frame;
using formats::Place;
using formats::Transfer;

namespace {

// How much of the volume of one row goes to another one [m³], sorted.
using Flows = std::map<std::pair<std::uint32_t, std::uint32_t>, double>; // {to, from}

// Rows that have received are means, by volume, of their own and of what they received; amounts follow the volume.
Lineage lineage_of(const Flows& flows, std::span<const double> volume) {
  std::vector<double> left(volume.begin(), volume.end()), whole(volume.begin(), volume.end());
  for (const auto& [ends, moved] : flows) {
    whole[ends.first] += moved;
    whole[ends.second] -= moved;
    left[ends.second] -= moved;
  }
  Lineage lineage;
  auto flow = flows.begin();
  for (std::uint32_t row = 0; row < volume.size(); ++row) {
    const double all = left[row] > 0 ? left[row] / volume[row] : 0;
    std::vector<Parent> parents{{row, 1, all}};
    double given = 0;
    for (; flow != flows.end() && flow->first.first == row; ++flow) {
      const std::uint32_t from = flow->first.second;
      const double weight = flow->second / whole[row];
      parents.push_back({from, weight, flow->second / volume[from]});
      given += weight;
    }
    parents[0].weight = 1 - given;
    lineage.add(parents);
  }
  return lineage;
}

} // namespace

std::vector<Vector3> deposit(Frame& frame, std::span<const Lying> parts) {
  const auto corners = triangles(std::as_const(frame));
  const auto volume = volumes(std::as_const(frame));
  Flows of_triangles, of_vertices;
  std::vector<Vector3> moment(frame.vertices, Vector3::Zero());
  for (const Lying& part : parts) {
    const double moved = part.part * volume[part.upper];
    of_triangles[{part.lower, part.upper}] += moved;
    for (const std::uint32_t to : corners[part.lower]) {
      moment[to] += part.gap * moved / 3 * part.normal;
      for (const std::uint32_t from : corners[part.upper])
        of_vertices[{to, from}] += moved / 9;
    }
  }
  const std::vector<double> carried =
      vertex_shares(frame.vertices, corners, [&](std::uint32_t t) { return volume[t]; });
  const Lineage vertices = lineage_of(of_vertices, carried);
  const Lineage triangle_rows = lineage_of(of_triangles, volume), means = triangle_rows.by_volume(volume);
  for (formats::Array& array : frame.arrays)
    if (array.transfer == Transfer::mean)
      array = transferred(array, means);
    else if ((array.transfer == Transfer::conserve || array.transfer == Transfer::interpolate) &&
             array.name != "position" && (array.place == Place::vertex || array.place == Place::triangle))
      array = transferred(array, array.place == Place::vertex ? vertices : triangle_rows);
  const std::vector<double> now = vertex_shares(frame.vertices, triangles(std::as_const(frame)),
                                                [&](std::uint32_t t) { return volumes(std::as_const(frame))[t]; });
  for (std::size_t v = 0; v < moment.size(); ++v)
    if (!moment[v].isZero(0))
      moment[v] /= now[v];
  return moment;
}

} // namespace sheet::flow
