// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/slope_tension.h"

#include <cmath>

#include "libsheet/energy/walls.h"
#include "libsheet/geometry/area.h"

namespace sheet {

namespace {

// Corners of the two triangles among the element's vertices: the first one runs from the edge's lower vertex to the
// higher one (connectivity.h).
constexpr int corners[2][3] = {{2, 0, 1}, {3, 1, 0}};

TriangleArea triangle(const VectorN<12>& u, int side) {
  const int* c = corners[side];
  return {u.segment<3>(3 * c[0]), u.segment<3>(3 * c[1]), u.segment<3>(3 * c[2])};
}

VectorN<12> area_gradient(const TriangleArea& a, int side) {
  VectorN<12> gradient = VectorN<12>::Zero();
  for (int k = 0; k < 3; ++k)
    gradient.segment<3>(3 * corners[side][k]) = a.gradient(k);
  return gradient;
}

void add_area_hessian(const TriangleArea& a, int side, double factor, MatrixN<12>& hessian) {
  const MatrixN<9> h = factor * a.hessian(true);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      hessian.block<3, 3>(3 * corners[side][i], 3 * corners[side][j]) += h.block<3, 3>(3 * i, 3 * j);
}

// ∇∇l times a factor, of the edge from the first vertex to the second, `along` its direction.
void add_length_hessian(const Vector3& along, double length, double factor, MatrixN<12>& hessian) {
  const Matrix3 turn = factor / length * (Matrix3::Identity() - along * along.transpose());
  hessian.block<3, 3>(0, 0) += turn;
  hessian.block<3, 3>(3, 3) += turn;
  hessian.block<3, 3>(0, 3) -= turn;
  hessian.block<3, 3>(3, 0) -= turn;
}

} // namespace

void SlopeTension::begin(const Stage& stage) {
  const Connectivity& mesh = *stage.start->mesh;
  loads_.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    double filled = 0;
    for (const auto v : edges_[i].vertices)
      if (const WallSite* site = site_at(stage, v); site != nullptr && site->channel != no_index)
        filled += stage.channels[site->channel].filled / 4;
    const double gamma = (1 - filled) * stage.liquid.surface_tension, wall = edges_[i].on_wall;
    const auto [one, two] = mesh.edge_triangles[edges_[i].edge];
    loads_[i] = {{stage.start->volumes[one], stage.start->volumes[two]}, {2 * (1 - wall) * gamma, wall * gamma}};
  }
}

double SlopeTension::value(std::size_t i, const VectorN<12>& u) const {
  const auto& [volumes, tensions] = loads_[i];
  const double one = triangle(u, 0).area, two = triangle(u, 1).area;
  const double p = 2 * (one + two) / 3;
  const double q = (u.segment<3>(3) - u.segment<3>(0)).norm() * (volumes[0] / one - volumes[1] / two) / 2;
  return tensions[0] * slant(p, q) + tensions[1] * slant(p, 2 * q);
}

double SlopeTension::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  const auto& [volumes, tensions] = loads_[i];
  const TriangleArea triangles[2] = {triangle(u, 0), triangle(u, 1)};
  const VectorN<12> of_area[2] = {area_gradient(triangles[0], 0), area_gradient(triangles[1], 1)};
  const Vector3 edge = u.segment<3>(3) - u.segment<3>(0);
  const double length = edge.norm();
  const Vector3 along = edge / length;
  VectorN<12> of_length = VectorN<12>::Zero();
  of_length << -along, along, Vector3::Zero(), Vector3::Zero();
  const double h[2] = {volumes[0] / triangles[0].area, volumes[1] / triangles[1].area};
  const double falls[2] = {h[0] / triangles[0].area, -h[1] / triangles[1].area}; // -∂(h1 - h2)/∂A
  const double p = 2 * (triangles[0].area + triangles[1].area) / 3, jump = h[0] - h[1], q = length * jump / 2;
  const VectorN<12> of_p = 2 * (of_area[0] + of_area[1]) / 3;
  const VectorN<12> of_jump = -falls[0] * of_area[0] - falls[1] * of_area[1];
  const VectorN<12> of_q = (jump * of_length + length * of_jump) / 2;

  double value = 0, by_p = 0, by_q = 0, curvature = 0; // W, its derivatives, and the factor of (q ∇p - p ∇q)²
  for (const int steeper : {1, 2}) {
    const double tension = tensions[static_cast<std::size_t>(steeper - 1)], slope = steeper * q;
    const double r = std::hypot(p, slope);
    value += tension * slant(p, slope);
    by_p -= tension * slant(p, slope) / r;
    by_q += tension * steeper * slope / r;
    curvature += tension * steeper * steeper / (r * r * r);
  }
  gradient = by_p * of_p + by_q * of_q;
  const VectorN<12> across = q * of_p - p * of_q;
  hessian = curvature * across * across.transpose();
  if (definite)
    return value;
  for (int side = 0; side < 2; ++side) { // by_p ∇∇p, and of by_q ∇∇q what is of one area
    const double by_jump = by_q * length * falls[side];
    add_area_hessian(triangles[side], side, 2 * by_p / 3 - by_jump / 2, hessian);
    hessian += by_jump / triangles[side].area * of_area[side] * of_area[side].transpose();
  }
  hessian += by_q / 2 * (of_length * of_jump.transpose() + of_jump * of_length.transpose());
  add_length_hessian(along, length, by_q * jump / 2, hessian);
  return value;
}

} // namespace sheet
