// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/hinge.h"

#include <cmath>
#include <numbers>

#include "libsheet/geometry/dihedral.h"

namespace sheet {

namespace {
// The difference of two angles, in (-π, π]: a fold that passes flat contact does not unwind.
double turn(double difference) { return std::remainder(difference, 2 * std::numbers::pi); }
} // namespace

Hinge::Hinge(bool as_printed, const Connectivity& mesh) : as_printed_(as_printed) {
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    if (mesh.on_rim(e))
      continue;
    std::array<std::uint32_t, 4> n{mesh.edges[e][0], mesh.edges[e][1], 0, 0};
    for (std::size_t side = 0; side < 2; ++side) {
      const auto t = mesh.edge_triangles[e][side];
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh.triangle_edges[t][k] == e)
          n[2 + side] = mesh.triangles[t][k];
    }
    nodes_.push_back(n);
    edges_.push_back(e);
  }
}

void Hinge::begin(const Stage& stage) {
  const Connectivity& mesh = *stage.start->mesh;
  weight_.resize(nodes_.size());
  reference_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto angle = [&](const Unknowns& u) {
      return dihedral_angle(stage.position(u, nodes_[i][0]), stage.position(u, nodes_[i][1]),
                            stage.position(u, nodes_[i][2]), stage.position(u, nodes_[i][3]));
    };
    reference_[i] = angle(stage.begin);
    if (stage.previous)
      reference_[i] += stage.ratio * turn(angle(*stage.previous) - reference_[i]);
    double area = 0, thickness = 0, length = 0, viscosity = 0;
    for (const auto t : mesh.edge_triangles[edges_[i]]) {
      const RaisedMetric& a = stage.raised[t];
      area += a.area();
      viscosity += 0.5 * stage.viscosity[t] * stage.crust(t);
      thickness += 0.5 * stage.start->volumes[t] / a.area();
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh.triangle_edges[t][k] == edges_[i])
          length += 0.5 * a.lengths[static_cast<Eigen::Index>(k)];
    }
    weight_[i] =
        viscosity / (as_printed_ ? 3 : 18) / stage.duration * thickness * thickness * thickness * 3 * length / area;
  }
}

double Hinge::value(std::size_t i, const VectorN<12>& u) const {
  const double angle =
      turn(dihedral_angle(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6), u.segment<3>(9)) - reference_[i]);
  return weight_[i] * angle * angle;
}

double Hinge::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                          bool definite) const {
  const Vector3 x[4] = {u.segment<3>(0), u.segment<3>(3), u.segment<3>(6), u.segment<3>(9)};
  const Dihedral d = definite ? dihedral<false>(x[0], x[1], x[2], x[3]) : dihedral<true>(x[0], x[1], x[2], x[3]);
  const double angle = turn(d.angle - reference_[i]);
  gradient = (2 * weight_[i] * angle) * d.gradient;
  hessian = (2 * weight_[i]) * d.gradient * d.gradient.transpose();
  if (!definite)
    hessian += (2 * weight_[i] * angle) * d.hessian;
  return weight_[i] * angle * angle;
}

} // namespace sheet
