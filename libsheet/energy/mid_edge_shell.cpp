// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/mid_edge_shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/base/each.h"

namespace sheet {

namespace {

// β = -2 K g with K = [[0,1,1],[1,0,1],[1,1,0]]; its transpose is itself.
Vector3 curvature(const Vector3& g) { return {-2 * (g[1] + g[2]), -2 * (g[2] + g[0]), -2 * (g[0] + g[1])}; }

constexpr double cap_cosine = 0.92; // -cos 157°: triangles with a greater angle are caps
constexpr std::size_t at_once = 512;

// Of half a hinge at edge k [J/m²]: 4/H⁴ of the weight.
double hinge_stiffness(double weight, const RaisedMetric& metric, int k) {
  const double squared_height = metric.determinant / metric.lengths[k];
  return 4 * weight / (squared_height * squared_height);
}

Vector3 arc_lengths(const Vector3& lengths, const Vector3& beta) { return lengths + beta.cwiseProduct(beta) / 12; }

} // namespace

void MidEdgeShell::carry(const Unknowns& u, std::vector<CarriedDirector>& directors) const {
  const std::size_t edges = mesh_->edges.size();
  directors.resize(edges);
  each_in_parallel(edges, [&](std::size_t e) {
    const Vector3 along = stage_->position(u, mesh_->edges[e][1]) - stage_->position(u, mesh_->edges[e][0]);
    directors[e] = {stage_->frames[e], along.normalized(), u[static_cast<Eigen::Index>(3 * stage_->vertices() + e)]};
  });
}

MidEdgeShell::Heights MidEdgeShell::heights(std::size_t t, const Unknowns& u,
                                            const std::vector<CarriedDirector>& directors) const {
  const Corners& v = mesh_->triangles[t];
  const std::array<Vector3, 3> x{stage_->position(u, v[0]), stage_->position(u, v[1]), stage_->position(u, v[2])};
  Heights result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 w = 0.5 * (x[(k + 1) % 3] + x[(k + 2) % 3]) - x[k];
    const CarriedDirector& n = directors[mesh_->triangle_edges[t][k]];
    result.heights[static_cast<Eigen::Index>(k)] = n.director.dot(w);
    result.sides[static_cast<Eigen::Index>(k)] = n.beside.dot(w);
  }
  return result;
}

void MidEdgeShell::begin(const Stage& stage) {
  stage_ = &stage;
  mesh_ = stage.start->mesh.get();
  triangles_ = mesh_->triangles.size();
  references_.resize((triangles_ + lane_count - 1) / lane_count);
  carry(stage.begin, at_begin_);
  if (stage.previous)
    carry(*stage.previous, at_previous_);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, references_.size(), at_once / lane_count), [&](const auto& range) {
        for (std::size_t t = lane_count * range.begin(); t < std::min(lane_count * range.end(), triangles_); ++t)
          refer(t, stage);
        if (range.end() == references_.size()) // lanes beyond the last triangle must hold numbers
          for (std::size_t t = triangles_; t < lane_count * references_.size(); ++t)
            refer(t, stage);
      });
}

// Fills a lane with what stays during the stage; lanes beyond the last triangle are like it.
void MidEdgeShell::refer(std::size_t lane_of_all, const Stage& stage) {
  const std::size_t t = std::min(lane_of_all, triangles_ - 1), lane = lane_of_all % lane_count;
  MidEdgeReference& to = references_[lane_of_all / lane_count];
  const Corners& v = mesh_->triangles[t];
  const auto lengths = [&](const Unknowns& u) {
    return squared_lengths(stage.position(u, v[0]), stage.position(u, v[1]), stage.position(u, v[2]));
  };
  const Heights start = heights(t, stage.begin, at_begin_);
  Vector3 g = start.heights, c = start.sides, beta = curvature(g), squared = arc_lengths(lengths(stage.begin), beta);
  if (stage.previous) {
    const Heights previous = heights(t, *stage.previous, at_previous_);
    const Vector3 beta_previous = curvature(previous.heights);
    g += stage.ratio * (previous.heights - g);
    c += stage.ratio * (previous.sides - c);
    squared += stage.ratio * (arc_lengths(lengths(*stage.previous), beta_previous) - squared);
    beta += stage.ratio * (beta_previous - beta);
  }
  const RaisedMetric& metric = stage.raised[t];
  const double volume = stage.start->volumes[t], thickness = volume / metric.area();
  to.membrane[lane] = volume * viscosity_ / (2 * stage.duration);
  to.weight[lane] = to.membrane[lane] * thickness * thickness / 3;
  to.determinant[lane] = metric.determinant;
  const Cap cap = cap_of(to.weight[lane], metric, g);
  to.folded = to.folded && lane != 0;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const EdgeFrame& frame = stage.frames[mesh_->triangle_edges[t][at]];
    const double sign = v[(at + 1) % 3] < v[(at + 2) % 3] ? 1 : -1;
    for (int a = 0; a < 3; ++a) {
      to.tangent[k][a][lane] = sign * frame.tangent[a];
      to.director[k][a][lane] = frame.director[a];
      to.binormal[k][a][lane] = frame.binormal[a];
    }
    to.trace[k][lane] = metric.trace[k];
    to.curvature[k][lane] = beta[k];
    to.lengths[k][lane] = squared[k];
    to.stiffness[k][lane] = k == cap.longest ? cap.stiffness : 0;
    to.height[k][lane] = cap.height;
    const double lean = sign * start.sides[k] / std::hypot(start.heights[k], start.sides[k]); // cos ᾱ
    const double folding = std::max(0.0, 1 - std::numbers::sqrt2 * lean);
    to.folding[k][lane] = folding * hinge_stiffness(to.weight[lane], metric, k);
    to.side[k][lane] = c[k];
    to.folded = to.folded || folding > 0;
  }
}

MidEdgeShell::Cap MidEdgeShell::cap_of(double weight, const RaisedMetric& metric, const Vector3& heights) {
  Cap cap;
  const Vector3& q = metric.lengths;
  const double longest = q.maxCoeff(&cap.longest), p = q[(cap.longest + 1) % 3], s = q[(cap.longest + 2) % 3];
  const double flatness = (longest - p - s) / (2 * std::sqrt(p * s)); // -cos α
  const double part = std::max(0.0, (flatness - cap_cosine) / (1 - cap_cosine));
  cap.stiffness = part * hinge_stiffness(weight, metric, cap.longest);
  cap.height = heights[cap.longest];
  return cap;
}

void MidEdgeShell::prepare(const Unknowns& u) {
  const std::size_t edges = mesh_->edges.size(), vertices = stage_->vertices();
  cosine_.resize(edges);
  sine_.resize(edges);
  each_in_parallel(edges, [&](std::size_t e) {
    const double angle = u[static_cast<Eigen::Index>(3 * vertices + e)];
    cosine_[e] = std::cos(angle);
    sine_[e] = std::sin(angle);
  });
}

EnergySum MidEdgeShell::evaluate(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                                 double* hessians, bool definite, bool overwrite) const {
  const MidEdgeKernels& kernels = mid_edge_kernels();
  const auto kernel =
      hessians ? (definite ? kernels.definite : kernels.hessian) : (gradients ? kernels.gradient : kernels.value);
  MidEdgeState state;
  MidEdgeResult result;
  EnergySum sum;
  for (std::size_t i = first; i < last; i += lane_count) {
    const int used = static_cast<int>(std::min<std::size_t>(lane_count, last - i));
    for (int lane = 0; lane < lane_count; ++lane) { // lanes beyond the last element repeat it
      const int at = std::min(lane, used - 1);
      for (int k = 0; k < 9; ++k)
        state.x[k][lane] = u[at * stride + k];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t edge = mesh_->triangle_edges[i + static_cast<std::size_t>(at)][k];
        state.cosine[k][lane] = cosine_[edge];
        state.sine[k][lane] = sine_[edge];
      }
    }
    kernel(references_[i / lane_count], state, arcs_, result);
    for (int lane = 0; lane < used; ++lane) {
      sum.add(result.value[lane]);
      if (gradients) {
        for (int k = 0; k < 12; ++k)
          gradients[k] = (overwrite ? 0 : gradients[k]) + result.gradient[k][lane];
        gradients += stride;
      }
      if (hessians) {
        const LaneNumbers* from = result.hessian;
        for (int row = 0; row < 12; ++row)
          for (int column = 0; column <= row; ++column, ++from) {
            double& to = hessians[column * stride + row];
            to = (overwrite ? 0 : to) + (*from)[lane];
          }
        hessians += stride * stride;
      }
    }
    u += lane_count * stride;
  }
  return sum;
}

// One triangle's state in all lanes.
MidEdgeState MidEdgeShell::state_of(const VectorN<12>& u) {
  MidEdgeState state;
  for (int lane = 0; lane < lane_count; ++lane) {
    for (int k = 0; k < 9; ++k)
      state.x[k][lane] = u[k];
    for (int k = 0; k < 3; ++k) {
      state.cosine[k][lane] = std::cos(u[9 + k]);
      state.sine[k][lane] = std::sin(u[9 + k]);
    }
  }
  return state;
}

double MidEdgeShell::value(std::size_t i, const VectorN<12>& u) const {
  MidEdgeResult result;
  mid_edge_kernels().value(references_[i / lane_count], state_of(u), arcs_, result);
  return result.value[i % lane_count];
}

double MidEdgeShell::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  MidEdgeResult result;
  const MidEdgeKernels& kernels = mid_edge_kernels();
  (definite ? kernels.definite : kernels.hessian)(references_[i / lane_count], state_of(u), arcs_, result);
  const LaneNumbers* from = result.hessian;
  for (int row = 0; row < 12; ++row) {
    gradient[row] = result.gradient[row][i % lane_count];
    for (int column = 0; column <= row; ++column)
      hessian(row, column) = hessian(column, row) = (*from++)[i % lane_count];
  }
  return result.value[i % lane_count];
}

} // namespace sheet
