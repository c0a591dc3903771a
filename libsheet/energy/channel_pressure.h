// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure by which liquid flows out of a gap between two walls (channels.h): it keeps a layer no thicker than its
// gap is wide. What it is too thick by, x = h/G - 1 of the gap, makes the pressure
//   p = max(0, m (dx/dt + r x)),   m = 50 (1 + D²/g²) μ,
// D the hydraulic diameter of what lies between walls around it, r the rate at which what is too thick gives way
// (channels.h). For each triangle of the volume V of which a corner lies between two walls
//   W = Σ f_c/3 m (1/τ + r) V/2 max(0, h/G - 1 - max(0, x̄)/(1 + r τ))²,   h = V/A,
//   G = Σ (f_c g_c exp(s_c·(x_c - x̂_c)/g_c) + (1 - f_c) 1.1 ĥ)/3,
// τ the stage's duration, x̄ at the start of the step, in a second stage extrapolated from the first, f_c the part in
// which the layer fills the gap g_c of a corner at the stage's predicted end, s_c the gap's slope along the wall, 1.1 ĥ
// the gap that the layer would begin to fill there. The layer feels -∇(p g) from the areas and p ∇g from the gaps: -g
// ∇p together, which with the drag of two walls is Reynolds' equation of lubrication [Reynolds 1886; Batchelor 1967,
// section 4.8]. Round plates of radius R that close at the rate e have p = 3 μ e (R² - s²)/g² at the radius s [Stefan
// 1874], so that x stays below 4e-3 there. The own wall, of the normal n, pushes the layer by p n, the facing one by
// p (∇g - n): by ∂W/∂g each, as far as its motion widens the gap.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "libsheet/base/each.h"
#include "libsheet/energy/channels.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/gap_forces.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class ChannelPressure {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  [[nodiscard]] const char* name() const { return "gap pressure"; }
  [[nodiscard]] std::size_t size() const { return triangles_; }

  void begin(const Stage& stage) {
    mesh_ = stage.start->mesh;
    const auto& triangles = mesh_->triangles;
    triangles_ = triangles.size();
    gaps_.assign(stage.channels.empty() ? 0 : triangles.size(), {});
    const double rate = stage.channel_rate;
    each_in_parallel(gaps_.size(), [&](std::size_t t) {
      const Corners& corners = triangles[t];
      if (std::ranges::none_of(corners, [&](std::uint32_t v) { return channel_at(stage, v) != nullptr; }))
        return;
      Gap& gap = gaps_[t];
      gap.volume = stage.start->volumes[t];
      const double free = near_touch * gap.volume / stage.raised[t].area();
      double mean = 0, filled = 0, diameter = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const Channel* channel = channel_at(stage, corners[c]);
        const double part = channel != nullptr ? channel->filled : 0;
        gap.corners[c].free = (1 - part) * free;
        if (part > 0) {
          gap.corners[c] = {(1 - part) * free, part * channel->gap, channel->slope / channel->gap, channel->place,
                            site_at(stage, corners[c])->normal / channel->gap};
          diameter = std::max(diameter, channel->diameter);
        }
        mean += (gap.corners[c].free + gap.corners[c].width) / 3;
        filled += part / 3;
      }
      const double wide = diameter / mean;
      gap.stiffness =
          filled * modulus * (1 + wide * wide) * stage.viscosity[t] * (1 / stage.duration + rate) * gap.volume;
      gap.allowed = std::max(0.0, reference(stage, t)) / (1 + rate * stage.duration);
    });
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    if (free(i))
      return 0;
    const double area = TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area;
    const double over = gaps_[i].excess(area, gaps_[i].mean(gaps_[i].widths(u)));
    return 0.5 * gaps_[i].stiffness * over * over;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    gradient.setZero();
    hessian.setZero();
    if (free(i))
      return 0;
    const Gap& gap = gaps_[i];
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    const Vector3 widths = gap.widths(u);
    const double mean = gap.mean(widths), over = gap.excess(a.area, mean), k = gap.stiffness;
    if (over == 0)
      return 0;
    const double ratio = gap.volume / (a.area * mean); // of thickness and gap
    VectorN<9> spreads, widens;                        // of the logarithms of the area, and of the gap
    spreads << a.gradient(0), a.gradient(1), a.gradient(2);
    spreads /= a.area;
    for (int c = 0; c < 3; ++c)
      widens.segment<3>(3 * c) = widths[c] / (3 * mean) * gap.corners[static_cast<std::size_t>(c)].slope;
    const VectorN<9> thins = spreads + widens;
    gradient = -k * over * ratio * thins;
    hessian = k * ratio * (ratio + over) * thins * thins.transpose() +
              k * over * ratio * (spreads * spreads.transpose() + widens * widens.transpose());
    if (!definite) {
      hessian -= k * over * ratio / a.area * a.hessian(true);
      for (int c = 0; c < 3; ++c) {
        const Vector3& slope = gap.corners[static_cast<std::size_t>(c)].slope;
        hessian.block<3, 3>(3 * c, 3 * c) -= k * over * ratio * widths[c] / (3 * mean) * slope * slope.transpose();
      }
    }
    return 0.5 * k * over * over;
  }

  void add_gap_forces(const Unknowns& x, GapForces& forces) const {
    for (std::size_t t = 0; t < gaps_.size(); ++t) {
      if (free(t))
        continue;
      const Corners& corners = mesh_->triangles[t];
      VectorN<9> u;
      for (Eigen::Index c = 0; c < 3; ++c)
        u.segment<3>(3 * c) = Stage::position(x, corners[static_cast<std::size_t>(c)]);
      const Gap& gap = gaps_[t];
      const double area = TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area;
      const Vector3 widths = gap.widths(u);
      const double mean = gap.mean(widths);
      const double work = gap.stiffness * gap.excess(area, mean) * gap.volume / (area * mean);
      for (std::size_t c = 0; c < 3; ++c) {
        const double share = work * widths[static_cast<Eigen::Index>(c)] / (3 * mean);
        forces.own[corners[c]] += share * gap.corners[c].normal;
        forces.facing[corners[c]] += share * (gap.corners[c].slope - gap.corners[c].normal);
      }
    }
  }

private:
  static constexpr double modulus = 50;

  struct Corner {
    double free = 0, width = 0;                               // parts of the gap: with a free face; at `place` [m]
    Vector3 slope = Vector3::Zero(), place = Vector3::Zero(); // of its logarithm [1/m]; predicted [m]
    Vector3 normal = Vector3::Zero();                         // of the own wall, over the gap [1/m]
  };

  struct Gap {
    double stiffness = 0; // m (1/τ + r) V [J], 0 where the layer's face is free
    double volume = 0;    // [m³]
    double allowed = 0;   // what it may be too thick by, over the gap
    std::array<Corner, 3> corners;

    [[nodiscard]] double mean(const Vector3& widths) const {
      return (corners[0].free + corners[1].free + corners[2].free + widths.sum()) / 3;
    }

    // Of the corners between walls [m].
    [[nodiscard]] Vector3 widths(const VectorN<9>& u) const {
      Vector3 at;
      for (int c = 0; c < 3; ++c) {
        const Corner& corner = corners[static_cast<std::size_t>(c)];
        at[c] = corner.width * std::exp(corner.slope.dot(u.segment<3>(3 * c) - corner.place));
      }
      return at;
    }

    // By how much the layer is thicker than it may be, over the gap.
    [[nodiscard]] double excess(double area, double width) const {
      return std::max(0.0, volume / (area * width) - 1 - allowed);
    }
  };

  [[nodiscard]] bool free(std::size_t i) const { return gaps_.empty() || gaps_[i].stiffness == 0; }

  static const Channel* channel_at(const Stage& stage, std::uint32_t vertex) {
    const WallSite* site = site_at(stage, vertex);
    return site == nullptr ? nullptr : channel_of(stage, *site);
  }

  // x at the start of the step, in a second stage extrapolated from the first.
  static double reference(const Stage& stage, std::size_t triangle) {
    const Corners& corners = stage.start->mesh->triangles[triangle];
    const auto too_thick = [&](double Channel::*gap, const std::array<Vector3, 3>& x) {
      const double thickness = stage.start->volumes[triangle] / TriangleArea(x[0], x[1], x[2]).area;
      double mean = 0;
      for (const std::uint32_t v : corners) {
        const Channel* channel = channel_at(stage, v);
        const double free = near_touch * thickness, part = channel != nullptr ? channel->filled : 0;
        mean += (part > 0 ? (1 - part) * free + part * std::min(channel->*gap, free) : free) / 3;
      }
      return thickness / mean - 1;
    };
    const auto& x = stage.start->positions;
    const double start = too_thick(&Channel::gap_before, {x[corners[0]], x[corners[1]], x[corners[2]]});
    if (stage.previous == nullptr)
      return start;
    const Unknowns& u = *stage.previous;
    const double first = too_thick(&Channel::gap_first, {Stage::position(u, corners[0]), Stage::position(u, corners[1]),
                                                         Stage::position(u, corners[2])});
    return start + stage.ratio * (first - start);
  }

  std::shared_ptr<const Connectivity> mesh_;
  std::size_t triangles_ = 0;
  std::vector<Gap> gaps_; // of each triangle; empty where nothing lies between walls
};

} // namespace sheet
