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

void add_area_hessian(const TriangleArea& a, int side, double factor, MatrixN<12>& hessian) {
  a.each_second(true, [&](int i, int j, const Matrix3& block) {
    hessian.block<3, 3>(3 * corners[side][i], 3 * corners[side][j]) += factor * block;
  });
}

// ∇∇l times a factor, of the edge from the first vertex to the second, `along` its direction.
void add_length_hessian(const Vector3& along, double length, double factor, MatrixN<12>& hessian) {
  const Matrix3 turn = factor / length * (Matrix3::Identity() - along * along.transpose());
  hessian.block<3, 3>(0, 0) += turn;
  hessian.block<3, 3>(3, 3) += turn;
  hessian.block<3, 3>(0, 3) -= turn;
  hessian.block<3, 3>(3, 0) -= turn;
}

// Two triangles about an edge, with what the energy is made of, and its first derivatives.
struct Pair {
  Pair(const VectorN<12>& u, const std::array<double, 2>& volumes)
      : triangles{triangle(u, 0), triangle(u, 1)}, edge(u.segment<3>(3) - u.segment<3>(0)), length(edge.norm()),
        jump(volumes[0] / triangles[0].area - volumes[1] / triangles[1].area),
        p(2 * (triangles[0].area + triangles[1].area) / 3), q(length * jump / 2) {
    for (const int side : {0, 1})
      falls[side] = (side == 0 ? 1 : -1) * volumes[static_cast<std::size_t>(side)] /
                    (triangles[side].area * triangles[side].area);
  }

  // Of the two areas and the length, by the vertices.
  [[nodiscard]] Eigen::Matrix<double, 12, 3> derivatives() const {
    Eigen::Matrix<double, 12, 3> of;
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < 3; ++k)
        of.block<3, 1>(3 * corners[side][k], side) = triangles[side].gradient(k);
      of.block<3, 1>(3 * (side == 0 ? 3 : 2), side).setZero(); // the other one's apex
    }
    const Vector3 along = edge / length;
    of.col(2) << -along, along, Vector3::Zero(), Vector3::Zero();
    return of;
  }

  TriangleArea triangles[2];
  Vector3 edge;
  double length, jump, p, q;
  double falls[2]; // -∂jump/∂A
};

// The factor of a thread's edges, f = 1 + ε s/(2 l), s = h1 + h2, and its derivatives by the areas and the length.
struct ThreadFactor {
  ThreadFactor(const Pair& pair, double epsilon) {
    const double part = epsilon / (2 * pair.length);
    double sum = 0;
    for (int side = 0; side < 2; ++side) {
      const double area = pair.triangles[side].area, by_area_squared = std::abs(pair.falls[side]); // V/A²
      sum += by_area_squared * area;
      by_area[side] = -part * by_area_squared;
      area2[side] = 2 * part * by_area_squared / area;
      mixed[side] = -by_area[side] / pair.length;
    }
    value += part * sum;
    by_length = -part * sum / pair.length;
    length2 = -2 * by_length / pair.length;
  }
  double value = 1, by_length = 0, length2 = 0;
  double by_area[2], area2[2], mixed[2]; // mixed: by an area and the length
};

// W, and its derivatives by p and q; `curvature` is the factor of (q ∇p - p ∇q)² in the second ones.
struct Energy {
  Energy(double p, double q, const std::array<double, 2>& tensions) {
    for (const int steeper : {1, 2}) {
      const double tension = tensions[static_cast<std::size_t>(steeper - 1)], slope = steeper * q;
      if (tension == 0)
        continue;
      const double r = std::sqrt(p * p + slope * slope), over = slant(p, slope);
      value += tension * over;
      by_p -= tension * over / r;
      by_q += tension * steeper * slope / r;
      curvature += tension * steeper * steeper / (r * r * r);
    }
  }
  double value = 0, by_p = 0, by_q = 0, curvature = 0;
};

} // namespace

void SlopeTension::begin(const Stage& stage) {
  const Connectivity& mesh = *stage.start->mesh;
  loads_.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    double filled = 0;
    for (const auto v : edges_[i].vertices)
      if (const WallSite* site = site_at(stage, v); site != nullptr && site->channel != no_index)
        filled += stage.channels[site->channel].filled / 4;
    const auto [one, two] = mesh.edge_triangles[edges_[i].edge];
    const double mean = 0.5 * (stage.surface_tension(one) + stage.surface_tension(two));
    const double gamma = (1 - filled) * mean;
    loads_[i] = {{stage.start->volumes[one], stage.start->volumes[two]},
                 {2 * edges_[i].two_faces * gamma, edges_[i].one_face * gamma},
                 edges_[i].of_thread * thread_slope};
  }
}

double SlopeTension::value(std::size_t i, const VectorN<12>& u) const {
  const Pair pair(u, loads_[i].volumes);
  const double slope =
      loads_[i].tensions[0] * slant(pair.p, pair.q) + loads_[i].tensions[1] * slant(pair.p, 2 * pair.q);
  return slope * ThreadFactor(pair, loads_[i].thread).value;
}

double SlopeTension::gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const {
  const Pair pair(u, loads_[i].volumes);
  const Energy energy(pair.p, pair.q, loads_[i].tensions);
  const ThreadFactor factor(pair, loads_[i].thread);
  const double by_length = factor.value * energy.by_q * pair.jump / 2 + energy.value * factor.by_length;
  const Vector3 of_length = by_length / pair.length * pair.edge;
  gradient << -of_length, of_length, Vector3::Zero(), Vector3::Zero();
  for (int side = 0; side < 2; ++side) {
    const double by_area = factor.value * (2 * energy.by_p / 3 - energy.by_q * pair.length * pair.falls[side] / 2) +
                           energy.value * factor.by_area[side];
    for (int k = 0; k < 3; ++k)
      gradient.segment<3>(3 * corners[side][k]) += by_area * pair.triangles[side].gradient(k);
  }
  return factor.value * energy.value;
}

double SlopeTension::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  const Pair pair(u, loads_[i].volumes);
  const Energy energy(pair.p, pair.q, loads_[i].tensions);
  const ThreadFactor factor(pair, loads_[i].thread);
  const Eigen::Matrix<double, 12, 3> of = pair.derivatives();
  const Vector3 of_p(2.0 / 3, 2.0 / 3, 0),
      of_q(-pair.length * pair.falls[0] / 2, -pair.length * pair.falls[1] / 2, pair.jump / 2);
  const Vector3 of_factor(factor.by_area[0], factor.by_area[1], factor.by_length);
  const Vector3 of_slopes = energy.by_p * of_p + energy.by_q * of_q;
  const Vector3 first = factor.value * of_slopes + energy.value * of_factor;
  gradient.noalias() = of * first;
  const Vector3 across = pair.q * of_p - pair.p * of_q;
  const double curvature = factor.value * energy.curvature;
  if (definite) {
    const VectorN<12> of_across = of * across;
    hessian.noalias() = (curvature * of_across) * of_across.transpose();
    return factor.value * energy.value;
  }
  Matrix3 second =
      curvature * across * across.transpose() + of_factor * of_slopes.transpose() + of_slopes * of_factor.transpose();
  for (int side = 0; side < 2; ++side) {
    const double by_jump = factor.value * energy.by_q * pair.falls[side];
    second(side, side) += by_jump * pair.length / pair.triangles[side].area + energy.value * factor.area2[side];
    const double mixed = energy.value * factor.mixed[side] - by_jump / 2;
    second(side, 2) += mixed;
    second(2, side) += mixed;
  }
  second(2, 2) += energy.value * factor.length2;
  const Eigen::Matrix<double, 12, 3> weighted = of.lazyProduct(second);
  for (int c = 0; c < 12; ++c)
    hessian.col(c).noalias() = weighted.col(0) * of(c, 0) + weighted.col(1) * of(c, 1) + weighted.col(2) * of(c, 2);
  for (int side = 0; side < 2; ++side)
    add_area_hessian(pair.triangles[side], side, first[side], hessian);
  add_length_hessian(of.block<3, 1>(3, 2), pair.length, first[2], hessian);
  return factor.value * energy.value;
}

} // namespace sheet
