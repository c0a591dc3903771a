// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/mid_edge_shell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/geometry/angles.h"
#include "libsheet/geometry/area.h"

namespace sheet {

namespace {

constexpr std::size_t at_once = 512;

// Adds the lower triangles of the first `used` lanes to Hessians, or sets them; see term.h.
void give_hessians(const MidEdgeResult& result, int used, int stride, double* hessians, bool overwrite) {
  for (int lane = 0; lane < used; ++lane, hessians += stride * stride) {
    const LaneNumbers* from = result.hessian;
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column <= row; ++column, ++from) {
        double& to = hessians[column * stride + row];
        to = (overwrite ? 0 : to) + (*from)[lane];
      }
  }
}

// Without anything viscous.
MidEdgeReference inviscid(const MidEdgeReference& of) {
  MidEdgeReference reference = of;
  for (int lane = 0; lane < lane_count; ++lane) {
    reference.weight[lane] = reference.membrane[lane] = 0;
    for (int k = 0; k < 3; ++k)
      reference.stiffness[k][lane] = 0;
  }
  reference.folded = false;
  return reference;
}

} // namespace

void MidEdgeShell::begin(const Stage& stage) {
  mesh_ = stage.start->mesh;
  triangles_ = mesh_->triangles.size();
  references_.resize((triangles_ + lane_count - 1) / lane_count);
  if (stage.previous)
    prepare(*stage.previous);
  area_loads_.begin(stage);
  flows_.begin(stage);
  curved_ = arcs_ && !flows_.newtonian();
  find_lanes();
  stresses_.clear();
  loads_.resize(area_loads_.any() ? references_.size() : 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, references_.size(), at_once / lane_count),
                    [&](const auto& range) {
                      for (std::size_t batch = range.begin(); batch < range.end(); ++batch) {
                        refer(stage, batch);
                        if (!loads_.empty())
                          load(stage, batch);
                      }
                    });
}

// Lanes beyond the last triangle are like it.
void MidEdgeShell::find_lanes() {
  lanes_.resize(curved_ && flows_.several() ? references_.size() : 0);
  for (std::size_t batch = 0; batch < lanes_.size(); ++batch)
    for (int lane = 0; lane < lane_count; ++lane)
      lanes_[batch][static_cast<std::size_t>(lane)] =
          &flows_.of(std::min(lane_count * batch + static_cast<std::size_t>(lane), triangles_ - 1));
}

MidEdgeFlow MidEdgeShell::flow_of(std::size_t i) const {
  if (!curved_)
    return {};
  const MidEdgeStress* stress = stresses_.empty() ? nullptr : &stresses_[i / lane_count];
  if (lanes_.empty())
    return {&flows_.numbered(0), nullptr, stress};
  const LaneCurves& lanes = lanes_[i / lane_count];
  const bool mixed = std::ranges::any_of(lanes, [&](const FlowCurve* other) { return other != lanes[0]; });
  if (mixed)
    return {lanes[0], lanes.data(), stress};
  return lanes[0]->newtonian() ? MidEdgeFlow{} : MidEdgeFlow{lanes[0], nullptr, stress};
}

// What stays during the stage, of lane_count triangles; lanes beyond the last triangle are like it.
void MidEdgeShell::refer(const Stage& stage, std::size_t batch) {
  MidEdgeReference& to = references_[batch];
  MidEdgeStart start;
  MidEdgeState previous;
  start.ratio = stage.previous ? stage.ratio : 0;
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t t = std::min(lane_count * batch + static_cast<std::size_t>(lane), triangles_ - 1);
    const Corners& v = mesh_->triangles[t];
    start.volume[lane] = stage.start->volumes[t];
    start.rate[lane] = stage.viscosity[t] / (2 * stage.duration) * stage.stiffening(t);
    start.stiffening[lane] = stage.stiffening(t);
    start.duration[lane] = stage.reduced_time(t);
    start.bending[lane] = stage.bending(t);
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const std::uint32_t edge = mesh_->triangle_edges[t][at];
      const EdgeFrame& frame = stage.frames[edge];
      const double sign = v[(at + 1) % 3] < v[(at + 2) % 3] ? 1 : -1;
      start.sign[k][lane] = sign;
      start.held[k][lane] = stage.director_held(edge);
      start.metric[k][lane] = stage.raised[t].lengths[k];
      for (int a = 0; a < 3; ++a) {
        to.tangent[k][a][lane] = sign * frame.tangent[a];
        to.director[k][a][lane] = frame.director[a];
        to.binormal[k][a][lane] = frame.binormal[a];
        start.x[3 * k + a][lane] = stage.begin[3 * v[at] + a];
      }
      if (stage.previous == nullptr)
        continue;
      previous.cosine[k][lane] = cosine_[edge];
      previous.sine[k][lane] = sine_[edge];
      for (int a = 0; a < 3; ++a)
        previous.x[3 * k + a][lane] = (*stage.previous)[3 * v[at] + a];
    }
  }
  mid_edge_kernels().reference(start, previous, to);
}

// What works on the area of lane_count triangles; lanes beyond the last triangle are like it.
void MidEdgeShell::load(const Stage& stage, std::size_t batch) {
  MidEdgeLoads& to = loads_[batch];
  const auto& x = stage.start->positions;
  to.worked = false;
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t t = std::min(lane_count * batch + static_cast<std::size_t>(lane), triangles_ - 1);
    const Corners& v = mesh_->triangles[t];
    to.tension[lane] = area_loads_.tension ? area_loads_.tension->tension(t) : 0;
    to.thrust[lane] = area_loads_.weight ? area_loads_.weight->thrust(t) : 0;
    to.work[lane] = area_loads_.squeeze ? area_loads_.squeeze->work(t) : 0;
    to.start_area[lane] = TriangleArea(x[v[0]], x[v[1]], x[v[2]]).area;
    to.worked = to.worked || to.work[lane] != 0;
  }
}

void MidEdgeShell::prepare(const Unknowns& u) {
  const std::size_t edges = mesh_->edges.size();
  cosine_.resize(edges);
  sine_.resize(edges);
  sines_and_cosines({u.data() + 3 * mesh_->vertices, edges}, sine_, cosine_);
}

void MidEdgeShell::follow(const Unknowns& u, const Unknowns& step) {
  if (!curved_)
    return;
  prepare(u);
  std::vector<MidEdgeStress> next(references_.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, references_.size(), at_once / lane_count),
                    [&](const auto& range) {
                      for (std::size_t batch = range.begin(); batch < range.end(); ++batch) {
                        const std::size_t first = batch * lane_count;
                        const MidEdgeFlow flow = flow_of(first);
                        if (flow.curve == nullptr)
                          continue;
                        const MidEdgeState state = global_state(u, first);
                        LaneNumbers by[12];
                        gather(step, first, by);
                        mid_edge_kernels().stress(references_[batch], state, by, flow, next[batch]);
                      }
                    });
  stresses_ = std::move(next);
}

void MidEdgeShell::add_dissipated(const Unknowns& u, std::span<double> energy) const {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, references_.size(), at_once / lane_count), [&](const auto& range) {
        alignas(64) LaneNumbers dissipated;
        for (std::size_t batch = range.begin(); batch < range.end(); ++batch) {
          const std::size_t first = batch * lane_count;
          mid_edge_kernels().dissipated(references_[batch], global_state(u, first), arcs_, flow_of(first), dissipated);
          for (std::size_t t = first; t < std::min(first + lane_count, triangles_); ++t)
            energy[t] += dissipated[t - first];
        }
      });
}

// The unknowns of lane_count triangles; lanes beyond the last triangle are like it.
void MidEdgeShell::gather(const Unknowns& u, std::size_t first, LaneNumbers (&to)[12]) const {
  const auto angles = static_cast<Eigen::Index>(3 * mesh_->vertices);
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t t = std::min(first + static_cast<std::size_t>(lane), triangles_ - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(3 * mesh_->triangles[t][k]);
      for (int a = 0; a < 3; ++a)
        to[3 * k + a][lane] = u[at + a];
      to[9 + k][lane] = u[angles + mesh_->triangle_edges[t][k]];
    }
  }
}

MidEdgeState MidEdgeShell::global_state(const Unknowns& u, std::size_t first) const {
  LaneNumbers all[12];
  gather(u, first, all);
  MidEdgeState state;
  std::copy_n(&all[0][0], 9 * lane_count, &state.x[0][0]);
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t t = std::min(first + static_cast<std::size_t>(lane), triangles_ - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      state.cosine[k][lane] = cosine_[mesh_->triangle_edges[t][k]];
      state.sine[k][lane] = sine_[mesh_->triangle_edges[t][k]];
    }
  }
  return state;
}

// Of the elements first to first + used - 1; lanes beyond the last one repeat it.
MidEdgeState MidEdgeShell::state_of(std::size_t first, int used, const double* u, int stride) const {
  MidEdgeState state;
  for (int lane = 0; lane < lane_count; ++lane) {
    const int at = std::min(lane, used - 1);
    for (int k = 0; k < 9; ++k)
      state.x[k][lane] = u[at * stride + k];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t edge = mesh_->triangle_edges[first + static_cast<std::size_t>(at)][k];
      state.cosine[k][lane] = cosine_[edge];
      state.sine[k][lane] = sine_[edge];
    }
  }
  return state;
}

EnergySum MidEdgeShell::evaluate(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                                 double* hessians, bool definite, bool overwrite) const {
  const MidEdgeKernels& kernels = mid_edge_kernels();
  const auto kernel =
      hessians ? (definite ? kernels.definite : kernels.hessian) : (gradients ? kernels.gradient : kernels.value);
  MidEdgeResult result;
  EnergySum sum;
  for (std::size_t i = first; i < last; i += lane_count) {
    const int used = static_cast<int>(std::min<std::size_t>(lane_count, last - i));
    kernel(references_[i / lane_count], state_of(i, used, u, stride), arcs_, loads_of(i), flow_of(i), result);
    for (int lane = 0; lane < used; ++lane) {
      sum.add(result.value[lane]);
      if (gradients) {
        for (int k = 0; k < 12; ++k)
          gradients[k] = (overwrite ? 0 : gradients[k]) + result.gradient[k][lane];
        gradients += stride;
      }
    }
    if (hessians) {
      give_hessians(result, used, stride, hessians, overwrite);
      hessians += used * stride * stride;
    }
    u += lane_count * stride;
  }
  return sum;
}

void MidEdgeShell::hessians_of(Kind kind, std::size_t first, std::size_t last, const double* u, int stride,
                               double* hessians) const {
  MidEdgeResult result;
  for (std::size_t i = first; i < last; i += lane_count) {
    const int used = static_cast<int>(std::min<std::size_t>(lane_count, last - i));
    const MidEdgeState state = state_of(i, used, u, stride);
    const MidEdgeReference& reference = references_[i / lane_count];
    if (kind == Kind::elastic)
      mid_edge_kernels().hessian(inviscid(reference), state, arcs_, loads_of(i), {}, result);
    else
      mid_edge_kernels().hessian(reference, state, arcs_, nullptr, flow_of(i), result);
    give_hessians(result, used, stride, hessians, true);
    hessians += used * stride * stride;
    u += lane_count * stride;
  }
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
  mid_edge_kernels().value(references_[i / lane_count], state_of(u), arcs_, loads_of(i), flow_of(i), result);
  return result.value[i % lane_count];
}

double MidEdgeShell::derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                                 bool definite) const {
  MidEdgeResult result;
  const MidEdgeKernels& kernels = mid_edge_kernels();
  (definite ? kernels.definite : kernels.hessian)(references_[i / lane_count], state_of(u), arcs_, loads_of(i),
                                                  flow_of(i), result);
  const LaneNumbers* from = result.hessian;
  for (int row = 0; row < 12; ++row) {
    gradient[row] = result.gradient[row][i % lane_count];
    for (int column = 0; column <= row; ++column)
      hessian(row, column) = hessian(column, row) = (*from++)[i % lane_count];
  }
  return result.value[i % lane_count];
}

} // namespace sheet
