// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the wall on a layer that flows along it. A layer of thickness h between a wall without slip, or with the slip
// length b, and a free face moves with its depth-averaged velocity u and is dragged by 3 μ u/(h + 3 b) [Pa] [Huppert
// 1982; Oron, Davis and Bankoff 1997, section II.B]. For each corner of a triangle that touches
//   W = (cos²φ Â/3 + sin²φ F) 3 μ |P (x - x̄)|² / (2 τ (ĥ + 3 b)),   F = Σ l ĥ/2,
// φ the angle between triangle and wall at the start of the step, Â and ĥ predicted for the end of the stage, P along
// the wall, x̄ where the corner had been carried by the wall (WallSite::carried). F is the foot on which a triangle
// stands, of its edges there whose both ends touch, of the length l: belts carry along what stands on them. Where
// another wall faces it across the gap g, 1/(ĥ + 3 b) becomes (1 - f)/(g + 3 b) + f/D, f the part filled, and x̄ the
// mean with these weights of where the one wall and both carry it (channels.h). Each of the two walls bears its part of
// that drag, of liquids that are not Newtonian as if they had the viscosity that the drag shows.
//
// μ is that which the layer has for what it carries along: where it is warmer it flows more easily (stage_setup.h).
//
// A liquid that is not Newtonian has the potential Ψ of its own flow curve (wall_flow.h, curved_drag.h):
//   W = (cos²φ Â/3 + sin²φ F) τ Ψ(u),   u² = |P (x - x̄)|²/τ² + (ε ĥ/3)²,
// ε its rest rate, or one below which it is Newtonian.
#pragma once
#include <algorithm>
#include <cmath>

#include "libsheet/base/each.h"
#include "libsheet/energy/channels.h"
#include "libsheet/energy/curved_drag.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/gap_forces.h"
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
    flows_.clear();
    rest_rates_.clear();
    for (const StageLiquid& of : stage.liquids) {
      flows_.push_back(of.wall_flow);
      rest_rates_.push_back(of.wall_flow ? std::max(rest_rate(of.liquid), of.wall_flow->newtonian_below()) : 0);
    }
    own_force_.clear();
    each_in_parallel(corners_.size(), [&](std::size_t i) {
      const Corners& corners = mesh_->triangles[i];
      const double area = stage.raised[i].area(), thickness = stage.start->volumes[i] / area;
      for (std::size_t c = 0; c < 3; ++c)
        if (const WallSite* site = site_at(stage, corners[c])) {
          const double between = walls_[stage.site_of[corners[c]]].depth;
          const double depth = between > 0 ? between : thickness + 3 * site->slip_length;
          const double lies = lying(stage, i, *site), foot = thickness / 2 * length_on_wall(stage, corners, c);
          const double trebled = lies * area + (1 - lies) * 3 * foot;
          const double shift = wall_shift(stage, i, *site);
          corners_[i][c].stiffness = trebled * shift * stage.viscosity[i] / (stage.duration * depth);
          corners_[i][c].area = trebled / 3;
          corners_[i][c].time = stage.reduced_time(i) / shift;
          corners_[i][c].depth = between > 0 ? between : thickness;
          corners_[i][c].slip_length = between > 0 ? 0 : site->slip_length;
          corners_[i][c].site = stage.site_of[corners[c]];
          corners_[i][c].liquid = flows_.size() > 1 ? stage.start->liquids[i] : 0;
        }
    });
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    each_corner(i, u, [&](int c, const Vector3& slid, const Vector3&) {
      sum += slide_of(corners_[i][static_cast<std::size_t>(c)], slid).potential;
    });
    return sum;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    double sum = 0;
    gradient.setZero();
    each_corner(i, u, [&](int c, const Vector3& slid, const Vector3&) {
      const CurvedDrag slide = slide_of(corners_[i][static_cast<std::size_t>(c)], slid);
      gradient.segment<3>(3 * c) = slide.stiffness * slid;
      sum += slide.potential;
    });
    return sum;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian, bool) const {
    double sum = 0;
    gradient.setZero();
    hessian.setZero();
    each_corner(i, u, [&](int c, const Vector3& slid, const Vector3& normal) {
      const CurvedDrag slide = slide_of(corners_[i][static_cast<std::size_t>(c)], slid);
      const Vector3* own = own_force_.empty() ? nullptr : &own_force_[i][static_cast<std::size_t>(c)];
      gradient.segment<3>(3 * c) = slide.stiffness * slid;
      hessian.block<3, 3>(3 * c, 3 * c) = slide.hessian(slid, Matrix3::Identity() - normal * normal.transpose(), own);
      sum += slide.potential;
    });
    return sum;
  }

  // See term.h.
  void rest_at(std::span<const double> rates) { rest_rates_.assign(rates.begin(), rates.end()); }
  void follow(const Unknowns& u, const Unknowns& step) {
    const bool curved = std::ranges::any_of(flows_, [](const auto& flow) { return flow != nullptr; });
    if (!curved || corners_.empty())
      return;
    std::vector<std::array<Vector3, 3>> next(triangles_, {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()});
    each_in_parallel(triangles_, [&](std::size_t t) {
      VectorN<9> at, by;
      for (Eigen::Index c = 0; c < 3; ++c) {
        at.segment<3>(3 * c) = Stage::position(u, mesh_->triangles[t][static_cast<std::size_t>(c)]);
        by.segment<3>(3 * c) = Stage::position(step, mesh_->triangles[t][static_cast<std::size_t>(c)]);
      }
      each_corner(t, at, [&](int c, const Vector3& slid, const Vector3& normal) {
        const auto at_corner = static_cast<std::size_t>(c);
        const Vector3 d = by.segment<3>(3 * c), along = d - normal.dot(d) * normal;
        next[t][at_corner] = slide_of(corners_[t][at_corner], slid)
                                 .followed(slid, along, own_force_.empty() ? nullptr : &own_force_[t][at_corner]);
      });
    });
    own_force_ = std::move(next);
  }

  void add_dissipated(const Unknowns& u, std::span<double> energy) const {
    each_in_parallel(corners_.size(), [&](std::size_t t) {
      VectorN<9> x;
      for (Eigen::Index c = 0; c < 3; ++c)
        x.segment<3>(3 * c) = Stage::position(u, mesh_->triangles[t][static_cast<std::size_t>(c)]);
      each_corner(t, x, [&](int c, const Vector3& slid, const Vector3&) {
        energy[t] += slide_of(corners_[t][static_cast<std::size_t>(c)], slid).stiffness * slid.squaredNorm();
      });
    });
  }

  void add_wall_forces(const Unknowns& u, std::span<Vector3> force) const {
    each_slide(u, [&](std::uint32_t v, const Corner&, double stiffness, const Vector3& slid) {
      force[v] -= stiffness * slid;
    });
  }

  void add_gap_forces(const Unknowns& u, GapForces& forces) const {
    each_slide(u, [&](std::uint32_t v, const Corner& corner, double stiffness, const Vector3& slid) {
      const Touched& wall = walls_[corner.site];
      const Vector3 of_facing = stiffness * (wall.facing_sheared - wall.facing_part * (slid - wall.facing_ahead));
      forces.facing[v] += of_facing;
      forces.own[v] -= of_facing;
    });
  }

private:
  // Where a vertex touches.
  struct Touched {
    Vector3 normal, carried; // of the wall; as in WallSite [m]
    double depth = 0;        // in place of the layer's, where another wall faces it; else 0 [m]
    // What that wall bears: this part of the drag, of how far liquid has slid past where both walls carry it, which is
    // so far ahead of `carried` [m]; and the shear between the walls, as if it had slid so far [m].
    double facing_part = 0;
    Vector3 facing_ahead = Vector3::Zero(), facing_sheared = Vector3::Zero();
  };

  struct Corner {
    double stiffness = 0;                        // of a Newtonian liquid [N/m]; 0: it is not dragged
    double area = 0, depth = 0, slip_length = 0; // for a flow curve [m²], [m], [m]
    double time = 0;                             // likewise: τ, reduced by temperature (stage.h) [s]
    std::uint32_t site = 0, liquid = 0;          // the latter by its number
  };

  [[nodiscard]] CurvedDrag slide_of(const Corner& corner, const Vector3& slid) const {
    const WallFlow* flow = flows_[corner.liquid].get();
    if (flow == nullptr)
      return {0.5 * corner.stiffness * slid.squaredNorm(), corner.stiffness, 0};
    const double still = rest_rates_[corner.liquid] * corner.depth / 3;
    const double time = corner.time, u = std::sqrt(slid.squaredNorm() / (time * time) + still * still);
    const WallFlow::Drag drag = flow->drag(u, corner.depth, corner.slip_length);
    const double stiffness = corner.area * drag.stress / (time * u);
    const double change = corner.area * (drag.slope - drag.stress / u) / (time * time * time * u * u);
    return {corner.area * time * drag.potential, stiffness, change};
  }

  static Touched touched(const Stage& stage, const WallSite& site) {
    const Channel* channel = channel_of(stage, site);
    if (channel == nullptr)
      return {site.normal, site.carried};
    const double one = (1 - channel->filled) / (channel->gap + 3 * site.slip_length);
    const double both = channel->filled / channel->depth, sum = one + both;
    const double part = sum > 0 ? both / sum : 0;
    Vector3 moved = channel->carried - site.carried;
    moved -= site.normal.dot(moved) * site.normal;
    Touched result{site.normal, site.carried + part * (channel->carried - site.carried), 1 / sum};
    if (part > 0) {
      result.facing_part = part * channel->facing_part;
      result.facing_ahead = (1 - part) * moved;
      result.facing_sheared = channel->filled / (3 * (channel->gap / 2 + site.slip_length) * sum) * moved;
    }
    return result;
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
      const Corner& corner = corners_[i][static_cast<std::size_t>(c)];
      if (corner.stiffness == 0)
        continue;
      const Touched& wall = walls_[corner.site];
      const Vector3 moved = u.segment<3>(3 * static_cast<Eigen::Index>(c)) - wall.carried;
      visit(static_cast<int>(c), Vector3(moved - wall.normal.dot(moved) * wall.normal), wall.normal);
    }
  }

  // Visits what is dragged: vertex, corner, stiffness [N/m], how far it has slid past the wall [m].
  template <class Visit> void each_slide(const Unknowns& u, Visit&& visit) const {
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      const Corners& vertices = mesh_->triangles[t];
      VectorN<9> x;
      for (Eigen::Index c = 0; c < 3; ++c)
        x.segment<3>(3 * c) = Stage::position(u, vertices[static_cast<std::size_t>(c)]);
      each_corner(t, x, [&](int c, const Vector3& slid, const Vector3&) {
        const Corner& corner = corners_[t][static_cast<std::size_t>(c)];
        visit(vertices[static_cast<std::size_t>(c)], corner, slide_of(corner, slid).stiffness, slid);
      });
    }
  }

  std::shared_ptr<const Connectivity> mesh_;
  std::size_t triangles_ = 0;
  std::vector<std::shared_ptr<const WallFlow>> flows_; // of each liquid; null: it is Newtonian
  std::vector<double> rest_rates_;                     // likewise [1/s]
  std::vector<std::array<Vector3, 3>> own_force_;      // once Newton has gone a step [N]
  std::vector<Touched> walls_;                         // of what touches
  std::vector<std::array<Corner, 3>> corners_;         // of each triangle; empty where nothing touches
};

} // namespace sheet
