// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the wall on a layer that flows along it. A layer of thickness h between a wall without slip, or with the slip
// length b, and a free face moves with its depth-averaged velocity u and is dragged by 3 μ u/(h + 3 b) [Pa] [Huppert
// 1982; Oron, Davis and Bankoff 1997, section II.B]. For each corner of a triangle that touches
//   W = (cos²φ Â/3 + sin²φ F) 3 μ |P (x - x̄)|² / (2 τ (ĥ + 3 b)),   F = Σ l ĥ/2,
// φ the angle between triangle and wall at the start of the step, Â and ĥ predicted for the end of the stage, P along
// the wall, x̄ where the corner had been carried by the wall (WallSite::carried). F is the foot on which a triangle
// stands, of its edges there whose both ends touch, of the length l: belts carry along what stands on them. Where
// another wall faces it across the gap g, 1/(ĥ + 3 b) becomes (1 - f)/(g + 3 b) + f/D, f the part filled, and x̄ the
// mean with these weights of where the one wall and both carry it (channels.h).
#pragma once
#include "libsheet/base/each.h"
#include "libsheet/energy/channels.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/walls.h"

namespace sheet {

class WallDrag {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  [[nodiscard]] const char* name() const { return "drag of walls"; }
  [[nodiscard]] std::size_t size() const { return triangles_; }
  void begin(const Stage& stage) {
    mesh_ = stage.start->mesh;
    triangles_ = mesh_->triangles.size();
    walls_.clear();
    for (const WallSite& site : stage.sites)
      walls_.push_back(touched(stage, site));
    corners_.assign(walls_.empty() ? 0 : triangles_, {});
    each_in_parallel(corners_.size(), [&](std::size_t i) {
      const Corners& corners = mesh_->triangles[i];
      const double area = stage.raised[i].area(), thickness = stage.start->volumes[i] / area;
      for (std::size_t c = 0; c < 3; ++c)
        if (const WallSite* site = site_at(stage, corners[c])) {
          const double between = walls_[stage.site_of[corners[c]]].depth;
          const double depth = between > 0 ? between : thickness + 3 * site->slip_length;
          const double lies = lying(stage, i, *site), foot = thickness / 2 * length_on_wall(stage, corners, c);
          corners_[i][c].stiffness =
              (lies * area + (1 - lies) * 3 * foot) * stage.viscosity[i] / (stage.duration * depth);
          corners_[i][c].site = stage.site_of[corners[c]];
        }
    });
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    each_corner(i, u, [&](int, const Vector3& slid, const Vector3&, double stiffness) {
      sum += 0.5 * stiffness * slid.squaredNorm();
    });
    return sum;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    double sum = 0;
    gradient.setZero();
    each_corner(i, u, [&](int c, const Vector3& slid, const Vector3&, double stiffness) {
      gradient.segment<3>(3 * c) = stiffness * slid;
      sum += 0.5 * stiffness * slid.squaredNorm();
    });
    return sum;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& g, MatrixN<9>& hessian, bool) const {
    hessian.setZero();
    each_corner(i, u, [&](int c, const Vector3&, const Vector3& normal, double stiffness) {
      hessian.block<3, 3>(3 * c, 3 * c) = stiffness * (Matrix3::Identity() - normal * normal.transpose());
    });
    return gradient(i, u, g);
  }

  void add_wall_forces(const Unknowns& u, std::span<Vector3> force) const {
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      const Corners& corners = mesh_->triangles[t];
      VectorN<9> x, pull;
      for (Eigen::Index c = 0; c < 3; ++c)
        x.segment<3>(3 * c) = Stage::position(u, corners[static_cast<std::size_t>(c)]);
      (void)gradient(t, x, pull);
      for (Eigen::Index c = 0; c < 3; ++c)
        force[corners[static_cast<std::size_t>(c)]] -= pull.segment<3>(3 * c);
    }
  }

private:
  // Where a vertex touches.
  struct Touched {
    Vector3 normal, carried; // of the wall; as in WallSite [m]
    double depth = 0;        // in place of the layer's, where another wall faces it; else 0 [m]
  };

  struct Corner {
    double stiffness = 0; // [N/m]; 0: it is not dragged
    std::uint32_t site = 0;
  };

  static Touched touched(const Stage& stage, const WallSite& site) {
    const Channel* channel = channel_of(stage, site);
    if (channel == nullptr)
      return {site.normal, site.carried};
    const double one = (1 - channel->filled) / (channel->gap + 3 * site.slip_length);
    const double both = channel->filled / channel->depth, sum = one + both;
    const double part = sum > 0 ? both / sum : 0;
    return {site.normal, site.carried + part * (channel->carried - site.carried), 1 / sum};
  }

  // Of the edges at a corner whose both ends touch its wall, at the start of the step [m].
  static double length_on_wall(const Stage& stage, const Corners& corners, std::size_t corner) {
    const auto& x = stage.start->positions;
    double length = 0;
    for (std::size_t other = 1; other < 3; ++other) {
      const std::uint32_t v = corners[corner], w = corners[(corner + other) % 3];
      if (const WallSite* site = site_at(stage, w); site != nullptr && site->wall == site_at(stage, v)->wall)
        length += (x[w] - x[v]).norm();
    }
    return length;
  }

  template <class Visit> void each_corner(std::size_t i, const VectorN<9>& u, Visit&& visit) const {
    for (std::size_t c = 0; c < 3 && !corners_.empty(); ++c) {
      const auto [stiffness, site] = corners_[i][c];
      if (stiffness == 0)
        continue;
      const auto& [normal, carried, depth] = walls_[site];
      const Vector3 moved = u.segment<3>(3 * static_cast<Eigen::Index>(c)) - carried;
      visit(static_cast<int>(c), Vector3(moved - normal.dot(moved) * normal), normal, stiffness);
    }
  }

  std::shared_ptr<const Connectivity> mesh_;
  std::size_t triangles_ = 0;
  std::vector<Touched> walls_;                 // of what touches
  std::vector<std::array<Corner, 3>> corners_; // of each triangle; empty where nothing touches
};

} // namespace sheet
