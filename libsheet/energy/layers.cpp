// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/layers.h"

#include <cmath>

#include "libsheet/energy/walls.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

LayerShares layer_shares(const Stage& stage) {
  const auto& triangles = stage.start->mesh->triangles;
  LayerShares s;
  s.area = vertex_shares(stage.vertices(), triangles, [&](std::uint32_t t) { return stage.raised[t].area(); });
  s.thickness = stage.vertex_volumes;
  for (std::size_t v = 0; v < s.area.size(); ++v)
    s.thickness[v] /= s.area[v];
  return s;
}

// Means are sums of differences to one of the values, so that equal values have just that mean.
std::vector<double> vertex_means(const Stage& stage, std::span<const double> values) {
  const auto& triangles = stage.start->mesh->triangles;
  std::vector<double> first(stage.vertices(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t])
      first[v] = values[t];
  std::vector<double> more(stage.vertices(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t])
      more[v] += stage.start->volumes[t] / 3 * (values[t] - first[v]);
  for (std::size_t v = 0; v < first.size(); ++v)
    first[v] += more[v] / stage.vertex_volumes[v];
  return first;
}

double mean_between(const ContactSpring& contact, std::span<const double> means) {
  const double first = means[contact.vertices[0]];
  double more = 0;
  for (std::size_t i = 1; i < 4; ++i)
    more += 0.5 * std::abs(contact.weights[i]) * (means[contact.vertices[i]] - first);
  return first + more;
}

LayerShear shear_on_wall(double lower, double upper, double slip_length) {
  if (slip_length == free_slip)
    return {1, (lower + upper) / 3, upper / 3};
  const double face = slip_length + lower / 2, mean = slip_length + lower / 3;
  return {face / mean, slip_length + lower + upper / 3 - face * face / mean, upper / 3};
}

LayerShear shear_in_stack(double lower, double upper) { return {1, (lower + upper) / 2, upper / 2}; }

} // namespace sheet
