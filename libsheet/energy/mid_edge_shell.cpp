// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/mid_edge_shell.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace sheet {

namespace {

// β = -2 K g with K = [[0,1,1],[1,0,1],[1,1,0]]; its transpose is itself.
Vector3 curvature(const Vector3& g) { return {-2 * (g[1] + g[2]), -2 * (g[2] + g[0]), -2 * (g[0] + g[1])}; }

constexpr double kCap = 0.92; // -cos 157°: triangles with a greater angle are caps
constexpr std::size_t kAtOnce = 512;

Vector3 arc_lengths(const Vector3& lengths, const Vector3& beta) { return lengths + beta.cwiseProduct(beta) / 12; }

} // namespace

Vector3 MidEdgeShell::heights(std::size_t t, const Unknowns& u) const {
  const Triangle& v = mesh_->triangles[t];
  Vector3 g;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t edge = mesh_->triangle_edges[t][k];
    const Vector3 low = stage_->position(u, mesh_->edges[edge][0]), high = stage_->position(u, mesh_->edges[edge][1]);
    g[static_cast<Eigen::Index>(k)] =
        director_height<0>(stage_->frames[edge], high - low, 0.5 * (low + high) - stage_->position(u, v[k]),
                           u[static_cast<Eigen::Index>(3 * stage_->vertices() + edge)])
            .value;
  }
  return g;
}

void MidEdgeShell::begin(const Stage& stage) {
  stage_ = &stage;
  mesh_ = stage.start->mesh.get();
  reference_.resize(mesh_->triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, reference_.size(), kAtOnce), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const auto lengths = [&](const Unknowns& u) {
        const Triangle& v = mesh_->triangles[t];
        return squared_lengths(stage.position(u, v[0]), stage.position(u, v[1]), stage.position(u, v[2]));
      };
      Vector3 g = heights(t, stage.begin);
      const Vector3 beta = curvature(g);
      Reference& r = reference_[t];
      r.curvature = beta;
      r.lengths = arc_lengths(lengths(stage.begin), beta);
      if (stage.previous) {
        const Vector3 previous = heights(t, *stage.previous);
        g += stage.ratio * (previous - g);
        const Vector3 beta_previous = curvature(previous);
        r.curvature += stage.ratio * (beta_previous - beta);
        r.lengths += stage.ratio * (arc_lengths(lengths(*stage.previous), beta_previous) - r.lengths);
      }
      const double volume = stage.start->volumes[t], thickness = volume / stage.raised[t].area();
      r.membrane = volume * viscosity_ / (2 * stage.duration);
      r.weight = r.membrane * thickness * thickness / 3;
      stiffen_cap(r, stage.raised[t], g);
    }
  });
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

void MidEdgeShell::prepare(const Unknowns& u) {
  const std::size_t edges = mesh_->edges.size(), vertices = stage_->vertices();
  cosine_.resize(edges);
  sine_.resize(edges);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges, kAtOnce), [&](const auto& range) {
    for (std::size_t e = range.begin(); e < range.end(); ++e) {
      const double angle = u[static_cast<Eigen::Index>(3 * vertices + e)];
      cosine_[e] = std::cos(angle);
      sine_[e] = std::sin(angle);
    }
  });
}

// Element i's numbers into a lane; its edges' angles are u's or, by load_angles, those prepared.
void MidEdgeShell::load(std::size_t i, const double* u, MidEdgeBatch& batch, int lane) const {
  for (int k = 0; k < 9; ++k)
    batch.x[k][lane] = u[k];
  const Reference& r = reference_[i];
  const RaisedMetric& metric = stage_->raised[i];
  const Triangle& v = mesh_->triangles[i];
  for (int k = 0; k < 3; ++k) {
    const EdgeFrame& frame = stage_->frames[mesh_->triangle_edges[i][static_cast<std::size_t>(k)]];
    const double sign = v[static_cast<std::size_t>((k + 1) % 3)] < v[static_cast<std::size_t>((k + 2) % 3)] ? 1 : -1;
    for (int a = 0; a < 3; ++a) {
      batch.tangent[k][a][lane] = sign * frame.tangent[a];
      batch.director[k][a][lane] = frame.director[a];
      batch.binormal[k][a][lane] = frame.binormal[a];
    }
    batch.trace[k][lane] = metric.trace[k];
    batch.curvature[k][lane] = r.curvature[k];
    batch.lengths[k][lane] = r.lengths[k];
    batch.stiffness[k][lane] = k == r.longest ? r.stiffness : 0;
    batch.height[k][lane] = r.height;
  }
  batch.determinant[lane] = metric.determinant;
  batch.weight[lane] = r.weight;
  batch.membrane[lane] = r.membrane;
}

void MidEdgeShell::load_angles(std::size_t i, MidEdgeBatch& batch, int lane) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t edge = mesh_->triangle_edges[i][k];
    batch.cosine[k][lane] = cosine_[edge];
    batch.sine[k][lane] = sine_[edge];
  }
}

EnergySum MidEdgeShell::evaluate(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                                 double* hessians, bool definite, bool overwrite) const {
  const MidEdgeKernels& kernels = mid_edge_kernels();
  const auto kernel =
      hessians ? (definite ? kernels.definite : kernels.hessian) : (gradients ? kernels.gradient : kernels.value);
  MidEdgeBatch batch;
  EnergySum sum;
  for (std::size_t i = first; i < last; i += kLanes) {
    const int used = static_cast<int>(std::min<std::size_t>(kLanes, last - i));
    for (int lane = 0; lane < kLanes; ++lane) { // lanes beyond the last element repeat it
      const int at = std::min(lane, used - 1);
      load(i + static_cast<std::size_t>(at), u + at * stride, batch, lane);
      load_angles(i + static_cast<std::size_t>(at), batch, lane);
    }
    kernel(batch, arcs_);
    for (int lane = 0; lane < used; ++lane) {
      sum.add(batch.value[lane]);
      if (gradients) {
        for (int k = 0; k < 12; ++k)
          gradients[k] = (overwrite ? 0 : gradients[k]) + batch.gradient[k][lane];
        gradients += stride;
      }
      if (hessians) {
        const LaneNumbers* from = batch.hessian;
        for (int row = 0; row < 12; ++row)
          for (int column = 0; column <= row; ++column, ++from) {
            double& to = hessians[column * stride + row];
            to = (overwrite ? 0 : to) + (*from)[lane];
          }
        hessians += stride * stride;
      }
    }
    u += kLanes * stride;
  }
  return sum;
}

double MidEdgeShell::value(std::size_t i, const VectorN<12>& u) const {
  MidEdgeBatch batch;
  for (int lane = 0; lane < kLanes; ++lane) {
    load(i, u.data(), batch, lane);
    for (int k = 0; k < 3; ++k) {
      batch.cosine[k][lane] = std::cos(u[9 + k]);
      batch.sine[k][lane] = std::sin(u[9 + k]);
    }
  }
  mid_edge_kernels().value(batch, arcs_);
  return batch.value[0];
}

double MidEdgeShell::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  MidEdgeBatch batch;
  for (int lane = 0; lane < kLanes; ++lane) {
    load(i, u.data(), batch, lane);
    for (int k = 0; k < 3; ++k) {
      batch.cosine[k][lane] = std::cos(u[9 + k]);
      batch.sine[k][lane] = std::sin(u[9 + k]);
    }
  }
  (definite ? mid_edge_kernels().definite : mid_edge_kernels().hessian)(batch, arcs_);
  const LaneNumbers* from = batch.hessian;
  for (int row = 0; row < 12; ++row) {
    gradient[row] = batch.gradient[row][0];
    for (int column = 0; column <= row; ++column)
      hessian(row, column) = hessian(column, row) = (*from++)[0];
  }
  return batch.value[0];
}

} // namespace sheet
