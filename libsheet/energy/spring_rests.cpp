// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/spring_rests.h"

#include <algorithm>

#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double most_change = 0.25; // that is predicted of a thickness

void bound_change(std::vector<double>& predicted, std::span<const double> start) {
  for (std::size_t v = 0; v < predicted.size(); ++v)
    predicted[v] = std::clamp(predicted[v], (1 - most_change) * start[v], (1 + most_change) * start[v]);
}

template <class PositionOf> double area_of(const Corners& c, PositionOf position_of) {
  return TriangleArea(position_of(c[0]), position_of(c[1]), position_of(c[2])).area;
}

template <class PositionOf> std::vector<double> thickness_at(const Stage& stage, PositionOf position_of) {
  const auto& triangles = stage.start->mesh->triangles;
  return thickness_around(stage.vertices(), triangles, stage.start->volumes,
                          [&](std::uint32_t t) { return area_of(triangles[t], position_of); });
}

// Where a vertex comes to by its velocity until the end of a first stage.
Vector3 first_guess(const Stage& stage, std::uint32_t v, double time) {
  const State& start = *stage.start;
  return start.velocities.empty() ? start.positions[v] : Vector3(start.positions[v] + time * start.velocities[v]);
}

} // namespace

std::vector<double> predicted_thickness(const Stage& stage) {
  const auto start = [&](std::uint32_t v) { return stage.start->positions[v]; };
  std::vector<double> predicted = thickness_at(stage, [&](std::uint32_t v) {
    return stage.previous == nullptr
               ? first_guess(stage, v, stage.duration)
               : Vector3(start(v) + (1 + stage.ratio) * (stage.position(*stage.previous, v) - start(v)));
  });
  bound_change(predicted, thickness_at(stage, start));
  return predicted;
}

void LongerRest::add_to_gradient(double times, VectorN<12>& gradient) const {
  if (!foot)
    return;
  const double by_area = times * volume / (foot->area * foot->area);
  for (int c = 0; c < 3; ++c)
    gradient.segment<3>(3 * (c + 1)) += by_area * foot->gradient(c);
}

// k ∇g ∇gᵀ + k g ∇²g, ∇g = along + a ∇A, ∇²g = a (∇²A - 2/A ∇A ∇Aᵀ), a = d0 V/((h0 + h0') A²).
void LongerRest::add_to_hessian(double k, double force, const VectorN<12>& along, MatrixN<12>& hessian,
                                bool definite) const {
  if (!foot) {
    hessian += k * along * along.transpose();
    return;
  }
  VectorN<12> gradient = along;
  add_to_gradient(1, gradient);
  hessian += k * gradient * gradient.transpose();
  const double bent = force * volume / (foot->area * foot->area),
               opposed = !definite || force < 0 ? -2 * bent / foot->area : 0;
  if (!definite || force > 0)
    foot->each_second(!definite, [&](int i, int j, const Matrix3& block) {
      hessian.block<3, 3>(3 * (i + 1), 3 * (j + 1)) += bent * block;
    });
  if (opposed != 0) {
    const Vector3 slope[3] = {foot->gradient(0), foot->gradient(1), foot->gradient(2)};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        hessian.block<3, 3>(3 * (i + 1), 3 * (j + 1)) += (opposed * slope[i]) * slope[j].transpose();
  }
}

SpringRests::SpringRests(std::span<const ContactSpring> springs, bool flow, const Connectivity& mesh)
    : springs_(springs), flow_(flow), triangles_(flow ? springs.size() : 0, no_index) {
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (const ContactSpring& s = springs[i]; s.of_vertex())
      triangles_[i] = triangle_of(mesh, {s.vertices[1], s.vertices[2], s.vertices[3]});
}

SpringRests::Foot SpringRests::foot_of(std::size_t i, const Stage& stage) const {
  const ContactSpring& s = springs_[i];
  const Corners at{s.vertices[1], s.vertices[2], s.vertices[3]};
  const std::uint32_t t = triangles_[i];
  if (t == no_index)
    return {at};
  return {at, stage.start->volumes[t], area_of(at, [&](std::uint32_t v) { return stage.start->positions[v]; })};
}

void SpringRests::begin(const Stage& stage) {
  if (!flow_)
    return;
  const auto start = [&](std::uint32_t v) { return stage.start->positions[v]; };
  const auto reference = [&](std::uint32_t v) { return reference_position(stage, v); };
  const std::vector<double> at_start = thickness_at(stage, start);
  rests_ = rests_with(stage, at_start, predicted_thickness(stage));
  before_.assign(springs_.size(), 0);
  if (stage.previous == nullptr)
    return;
  const std::vector<double> at_reference = thickness_at(stage, reference);
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const ContactSpring& s = springs_[i];
    const Foot foot = foot_of(i, stage);
    const double is = s.thickness(at_reference, foot.volume, foot.area, area_of(foot.corners, reference)),
                 was = s.thickness(at_start, foot.volume, foot.area, foot.area);
    before_[i] = s.rest_of_layers() * (is / was - 1);
  }
}

std::vector<SpringRests::Rest> SpringRests::rests_with(const Stage& stage, std::span<const double> start,
                                                       std::span<const double> end) const {
  std::vector<Rest> rests(springs_.size());
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const ContactSpring& s = springs_[i];
    const Foot foot = foot_of(i, stage);
    const double rest = s.rest_of_layers(), part = rest / s.thickness(start, foot.volume, foot.area, foot.area);
    if (const bool moves = foot.volume > 0 && of_layer(foot.volume, foot.area); moves)
      rests[i] = {part * end[s.vertices[0]] - rest, part * foot.volume};
    else
      rests[i].predicted = part * s.thickness(end, foot.volume, foot.area, foot.area) - rest;
  }
  return rests;
}

std::vector<double> SpringRests::longer_at_last(const Stage& stage) const {
  std::vector<double> longer(springs_.size(), 0);
  if (!flow_ || stage.previous == nullptr)
    return longer;
  const auto start = [&](std::uint32_t v) { return stage.start->positions[v]; };
  const auto last = [&](std::uint32_t v) { return stage.position(*stage.previous, v); };
  const std::vector<double> at_start = thickness_at(stage, start);
  std::vector<double> guess =
      thickness_at(stage, [&](std::uint32_t v) { return first_guess(stage, v, stage.duration); });
  bound_change(guess, at_start);
  const std::vector<Rest> rests = rests_with(stage, at_start, guess);
  for (std::size_t i = 0; i < springs_.size(); ++i)
    longer[i] =
        rests[i].predicted + (rests[i].volume > 0 ? rests[i].volume / area_of(foot_of(i, stage).corners, last) : 0);
  return longer;
}

} // namespace sheet
