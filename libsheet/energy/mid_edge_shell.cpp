// SPDX-License-Identifier: GPL-3.0-or-later
// The chain rule runs over six numbers a triangle: three squared lengths q and three heights g.
#include "libsheet/energy/mid_edge_shell.h"

#include "libsheet/energy/edge_springs.h"

namespace sheet {

namespace {

// β = -2 K g with K = [[0,1,1],[1,0,1],[1,1,0]]; its transpose is itself.
Vector3 curvature(const Vector3& g) { return {-2 * (g[1] + g[2]), -2 * (g[2] + g[0]), -2 * (g[0] + g[1])}; }

constexpr double kCap = 0.92; // -cos 157°: triangles with a greater angle are caps

VectorN<9> corners(const VectorN<12>& u) { return u.head<9>(); }

} // namespace

Vector3 MidEdgeShell::heights(std::size_t i, const VectorN<12>& u) const {
  Vector3 g;
  for (int k = 0; k < 3; ++k) {
    const Corner c = corner(i, k);
    const Vector3 low = u.segment<3>(3 * c.low), high = u.segment<3>(3 * c.high), apex = u.segment<3>(3 * k);
    g[k] = director_height<0>(stage_->frames[mesh_->triangle_edges[i][static_cast<std::size_t>(k)]], high - low,
                              0.5 * (low + high) - apex, u[9 + k])
               .value;
  }
  return g;
}

void MidEdgeShell::begin(const Stage& stage) {
  stage_ = &stage;
  mesh_ = stage.start->mesh.get();
  reference_.resize(mesh_->triangles.size());
  for (std::size_t t = 0; t < reference_.size(); ++t) {
    const auto local = [&](const Unknowns& u) {
      VectorN<12> x;
      for (std::size_t k = 0; k < 3; ++k) {
        x.segment<3>(static_cast<Eigen::Index>(3 * k)) = stage.position(u, mesh_->triangles[t][k]);
        x[static_cast<Eigen::Index>(9 + k)] =
            u[static_cast<Eigen::Index>(3 * stage.vertices() + mesh_->triangle_edges[t][k])];
      }
      return x;
    };
    const auto arc_lengths = [&](const VectorN<12>& x, const Vector3& beta) {
      return Vector3(EdgeSprings(corners(x)).squared_lengths() + beta.cwiseProduct(beta) / 12);
    };
    const VectorN<12> start = local(stage.begin);
    const Vector3 g0 = heights(t, start);
    const Vector3 beta = curvature(g0);
    Reference& r = reference_[t];
    r.curvature = beta;
    r.lengths = arc_lengths(start, beta);
    Vector3 g = g0;
    if (stage.previous) {
      const VectorN<12> previous = local(*stage.previous);
      const Vector3 g1 = heights(t, previous);
      g += stage.ratio * (g1 - g0);
      const Vector3 beta_previous = curvature(g1);
      r.curvature += stage.ratio * (beta_previous - beta);
      r.lengths += stage.ratio * (arc_lengths(previous, beta_previous) - r.lengths);
    }
    const double volume = stage.start->volumes[t], thickness = volume / stage.raised[t].area();
    r.membrane = volume * viscosity_ / (2 * stage.duration);
    r.weight = r.membrane * thickness * thickness / 3;
    stiffen_cap(r, stage.raised[t], g);
  }
}

void MidEdgeShell::stiffen_cap(Reference& r, const RaisedMetric& metric, const Vector3& heights) const {
  const Vector3& q = metric.lengths;
  const double longest = q.maxCoeff(&r.longest), p = q[(r.longest + 1) % 3], s = q[(r.longest + 2) % 3];
  const double flatness = (longest - p - s) / (2 * std::sqrt(p * s)); // -cos α
  const double part = std::max(0.0, (flatness - kCap) / (1 - kCap));
  const double squared_height = metric.determinant / longest;
  r.stiffness = 4 * part * r.weight / (squared_height * squared_height);
  r.height = heights[r.longest];
}

double MidEdgeShell::value(std::size_t i, const VectorN<12>& u) const {
  const Reference& r = reference_[i];
  const RaisedMetric& a = stage_->raised[i];
  const auto dissipation = [&](const Vector3& m) {
    const double trace = a.trace.dot(m);
    return 2 * trace * trace - 2 * form_determinant(m) / a.determinant;
  };
  const Vector3 g = heights(i, u);
  const Vector3 beta = curvature(g);
  double w = 0.5 * r.weight * dissipation(beta - r.curvature);
  const double turned = g[r.longest] - r.height;
  w += 0.5 * r.stiffness * turned * turned;
  if (arcs_)
    w += 0.5 * r.membrane *
         dissipation(EdgeSprings(corners(u)).squared_lengths() + beta.cwiseProduct(beta) / 12 - r.lengths);
  return w;
}

double MidEdgeShell::gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const {
  const Reference& r = reference_[i];
  const RaisedMetric& a = stage_->raised[i];
  Vector3 g;
  DirectorHeight height[3];
  for (int k = 0; k < 3; ++k) {
    const Corner c = corner(i, k);
    const Vector3 low = u.segment<3>(3 * c.low), high = u.segment<3>(3 * c.high), apex = u.segment<3>(3 * k);
    height[k] = director_height<1>(stage_->frames[mesh_->triangle_edges[i][static_cast<std::size_t>(k)]], high - low,
                                   0.5 * (low + high) - apex, u[9 + k]);
    g[k] = height[k].value;
  }
  const Vector3 beta = curvature(g), strain = beta - r.curvature;
  Vector3 s = r.weight * a.dissipated(strain); // ∂W/∂β
  double w = 0.5 * strain.dot(s);
  gradient.setZero();
  if (arcs_) {
    const EdgeSprings springs(corners(u));
    const Vector3 m = springs.squared_lengths() + beta.cwiseProduct(beta) / 12 - r.lengths;
    const Vector3 tension = r.membrane * a.dissipated(m);
    w += 0.5 * m.dot(tension);
    VectorN<9> part;
    springs.gradient(tension, part);
    gradient.head<9>() = part;
    s += tension.cwiseProduct(beta) / 6;
  }
  Vector3 sg = curvature(s); // from β to g
  const double turned = g[r.longest] - r.height;
  w += 0.5 * r.stiffness * turned * turned;
  sg[r.longest] += r.stiffness * turned;
  for (int k = 0; k < 3; ++k) {
    const Corner c = corner(i, k);
    gradient.segment<3>(3 * c.low) += sg[k] * (0.5 * height[k].by_w - height[k].by_e);
    gradient.segment<3>(3 * c.high) += sg[k] * (0.5 * height[k].by_w + height[k].by_e);
    gradient.segment<3>(3 * k) -= sg[k] * height[k].by_w;
    gradient[9 + k] += sg[k] * height[k].by_theta;
  }
  return w;
}

double MidEdgeShell::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  const Reference& r = reference_[i];
  const RaisedMetric& a = stage_->raised[i];
  const Matrix3 dissipation = a.dissipation();

  // Heights and their derivatives by the twelve unknowns.
  Vector3 g;
  Eigen::Matrix<double, 3, 12> by_u = Eigen::Matrix<double, 3, 12>::Zero();
  DirectorHeight height[3];
  for (int k = 0; k < 3; ++k) {
    const Corner c = corner(i, k);
    const Vector3 low = u.segment<3>(3 * c.low), high = u.segment<3>(3 * c.high), apex = u.segment<3>(3 * k);
    const EdgeFrame& frame = stage_->frames[mesh_->triangle_edges[i][static_cast<std::size_t>(k)]];
    const Vector3 w = 0.5 * (low + high) - apex;
    height[k] = definite ? director_height<1>(frame, high - low, w, u[9 + k])
                         : director_height<2>(frame, high - low, w, u[9 + k]);
    g[k] = height[k].value;
    by_u.block<1, 3>(k, 3 * c.low) = (0.5 * height[k].by_w - height[k].by_e).transpose();
    by_u.block<1, 3>(k, 3 * c.high) = (0.5 * height[k].by_w + height[k].by_e).transpose();
    by_u.block<1, 3>(k, 3 * k) = -height[k].by_w.transpose();
    by_u(k, 9 + k) = height[k].by_theta;
  }
  const Vector3 beta = curvature(g);

  // W(β): moment-like s = ∂W/∂β and C = ∂²W/∂β².
  const Vector3 strain = beta - r.curvature;
  Matrix3 c = r.weight * dissipation;
  Vector3 s = c * strain;
  double w = 0.5 * strain.dot(s);

  gradient.setZero();
  hessian.setZero();
  if (arcs_) {
    const EdgeSprings springs(u.head<9>());
    const Vector3 m = springs.squared_lengths() + beta.cwiseProduct(beta) / 12 - r.lengths;
    const Matrix3 cm = r.membrane * dissipation;
    const Vector3 tension = cm * m; // by the squared arc lengths
    w += 0.5 * m.dot(tension);
    VectorN<9> part;
    springs.gradient(tension, part);
    gradient.head<9>() = part;
    MatrixN<9> block;
    springs.hessian(cm, definite ? a.positive_part(tension) : tension, block);
    hessian.topLeftCorner<9, 9>() = block;
    // L² = q + β²/12: the cross terms and the part of β.
    const Matrix3 slope = (beta / 6).asDiagonal();
    // by_beta = ∂β/∂u = -2 K by_u
    Eigen::Matrix<double, 3, 12> by_beta;
    by_beta.row(0) = -2 * (by_u.row(1) + by_u.row(2));
    by_beta.row(1) = -2 * (by_u.row(2) + by_u.row(0));
    by_beta.row(2) = -2 * (by_u.row(0) + by_u.row(1));
    const Eigen::Matrix<double, 3, 12> coupling = (cm * slope).lazyProduct(by_beta);
    const Eigen::Matrix<double, 9, 12> cross = springs.jacobian().transpose().lazyProduct(coupling);
    hessian.topRows<9>() += cross;
    hessian.leftCols<9>() += cross.transpose();
    c += slope * cm * slope;
    for (int k = 0; k < 3; ++k)
      c(k, k) += (definite ? std::max(0.0, tension[k]) : tension[k]) / 6;
    s += tension.cwiseProduct(beta) / 6;
  }

  // From β to g: s_g = -2 K s, C_g = 4 K C K.
  Vector3 sg = curvature(s);
  Matrix3 ck;
  for (int k = 0; k < 3; ++k)
    ck.col(k) = curvature(c.col(k));
  Matrix3 cg;
  for (int k = 0; k < 3; ++k)
    cg.row(k) = curvature(ck.row(k).transpose()).transpose();
  const double turned = g[r.longest] - r.height;
  w += 0.5 * r.stiffness * turned * turned;
  sg[r.longest] += r.stiffness * turned;
  cg(r.longest, r.longest) += r.stiffness;
  gradient.noalias() += by_u.transpose() * sg;
  const Eigen::Matrix<double, 3, 12> cu = cg.lazyProduct(by_u);
  hessian += by_u.transpose().lazyProduct(cu); // Eigen's general product costs more than this small one
  if (definite) {
    // ∂²g/∂θ² = -g: kept where it stiffens, without which Newton overshoots at sharp folds.
    for (int k = 0; k < 3; ++k)
      hessian(9 + k, 9 + k) += std::max(0.0, -sg[k] * height[k].value);
    return w;
  }

  for (int k = 0; k < 3; ++k) {
    const Corner at = corner(i, k);
    const int low = 3 * at.low, high = 3 * at.high, apex = 3 * k, angle = 9 + k;
    const DirectorHeight& d = height[k];
    // e = high - low, w = (low + high)/2 - apex
    for (int n = 0; n < 3; ++n)
      for (int m = 0; m < 3; ++m) {
        const double ee = sg[k] * d.ee(m, n), ew = sg[k] * d.ew(m, n), we = sg[k] * d.ew(n, m);
        const double both = 0.5 * (ew + we), mixed = -ee - 0.5 * (ew - we);
        hessian(low + m, low + n) += ee - both;
        hessian(high + m, high + n) += ee + both;
        hessian(low + m, high + n) += mixed;
        hessian(high + n, low + m) += mixed;
        hessian(low + m, apex + n) += ew;
        hessian(apex + n, low + m) += ew;
        hessian(high + m, apex + n) -= ew;
        hessian(apex + n, high + m) -= ew;
      }
    const Vector3 e = sg[k] * d.e_theta, t = sg[k] * d.w_theta;
    const auto mixed = [&](int row, const Vector3& x) {
      hessian.block<3, 1>(row, angle) += x;
      hessian.block<1, 3>(angle, row) += x.transpose();
    };
    mixed(low, 0.5 * t - e);
    mixed(high, 0.5 * t + e);
    mixed(apex, -t);
    hessian(angle, angle) -= sg[k] * d.value;
  }
  return w;
}

} // namespace sheet
