// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet that floats on a heavy bath: the hydrostatic pressure -ρ g d on its lower side, d the height [m] above the
// bath's level, as the potential (ρ g/2) ∫ d² dA of the horizontally projected area [Batty et al. 2012, section 4]:
//   W = (ρ g/12) A_z q,   q = d0² + d1² + d2² + d0 d1 + d1 d2 + d2 d0,   A_z = k·(x1-x0)×(x2-x0)/2,   k upwards.
// A bath acts from below only: ∫ min(d, 0)² dA takes the place of ∫ d² dA unless it clings to the sheet. In a triangle
// of which one vertex a is under the surface q is d_a² s r with s = d_a/(d_a - d_b), r = d_a/(d_a - d_c), and the same
// of the one vertex above it is what a triangle lacks of which two are under it.
// The normals point upwards; those of what floats on its face, and of what is closed, point to the bath, and A_z has
// the other sign there (BathReach::facing, outside). Below zero, where W would have no lower bound, A_z counts as
// nothing, and smoothly so from a twentieth of the area on; what is closed has all of it, as the bath presses on its
// top. What is wet on both faces (BathReach::around, and under the surface what has its face down at the start of a
// step) is lifted by the weight of as much of the bath as it is itself (Archimedes), ρ g V/3 at each corner, and as it
// comes up by less of it from d = -h on, h = V/A its thickness at the start of the step, ρ g V/3 min(1, max(0, -d/h)):
// so much is its lower face lifted by then, and a step in which it comes up does not throw it out of the bath. Corners
// that another layer bears feel neither. Of a triangle of which the bath reaches some corners alone from below W is
// the sum of their (ρ g/6) A_z min(d, 0)², so that each bears its own part. ρ in kg/m³, g in m/s².
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/element.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class Bath {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr bool external = true;
  static constexpr Kind kind = Kind::elastic;
  // gravity [m/s²]; level: height of the rest plane along the upward direction [m]; clings: it pulls what is above it;
  // reach: as in BathSurface.
  Bath(double density, const Vector3& gravity, double level, bool clings, std::vector<BathReach> reach = {})
      : weight_(density * gravity.norm() / 12), surface_(gravity, level, std::move(reach)), clings_(clings) {}
  [[nodiscard]] const char* name() const { return "bath"; }
  [[nodiscard]] std::size_t size() const { return start_.size(); }
  void begin(const Stage& stage) {
    const auto& triangles = stage.start->mesh->triangles;
    const auto& x = stage.start->positions;
    start_.assign(triangles.size(), {});
    for (std::size_t t = 0; t < start_.size(); ++t) {
      const Corners& c = triangles[t];
      const TriangleArea area(x[c[0]], x[c[1]], x[c[2]]);
      const bool closed = std::ranges::any_of(c, [&](auto v) { return surface_.reach(v) == BathReach::outside; });
      start_[t].side = surface_.side(c);
      const bool overturned = !closed && start_[t].side * surface_.up().dot(area.normal) < 0;
      int from_below = 0;
      for (int a = 0; a < 3; ++a) {
        const std::uint32_t v = c[static_cast<std::size_t>(a)];
        start_[t].below[static_cast<std::size_t>(a)] = !overturned && surface_.on_one_face(v);
        from_below += !overturned && surface_.on_one_face(v);
        if ((overturned || surface_.reach(v) == BathReach::around) && surface_.wets(v, x[v]))
          start_[t].lift[a] = 4 * weight_ * stage.start->volumes[t]; // ρ g V/3
      }
      start_[t].thickness = stage.start->volumes[t] / area.area;
      start_[t].steep = closed ? -std::numeric_limits<double>::infinity() : steepest * area.area;
      start_[t].weight = from_below > 0 ? weight_ : 0;
    }
  }

  [[nodiscard]] double value(std::size_t t, const VectorN<9>& u) const {
    if (start_[t].weight == 0)
      return lifted(t, u);
    const Parts p(*this, u, start_[t]);
    return start_[t].weight * Projection(p.area, start_[t].steep).value * p.depth.square + lifted(t, u);
  }

  double derivatives(std::size_t t, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    hessian.setZero();
    for (int a = 0; a < 3; ++a) {
      const Lift lift(start_[t].lift[a], surface_.height(u.segment<3>(3 * a)), start_[t].thickness);
      gradient.segment<3>(3 * a) = lift.first * surface_.up();
      hessian.block<3, 3>(3 * a, 3 * a) = lift.second * surface_.up() * surface_.up().transpose();
    }
    const double weight = start_[t].weight;
    if (weight == 0)
      return lifted(t, u);
    const Parts p(*this, u, start_[t]);
    const Projection area(p.area, start_[t].steep);
    gradient += weight * (area.first * p.depth.square * p.by_area + area.value * p.by_square);
    const Matrix3 upright =
        (weight * (definite ? std::max(0.0, area.value) : area.value)) * (surface_.up() * surface_.up().transpose());
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        hessian.block<3, 3>(3 * a, 3 * b) += p.depth.second(a, b) * upright;
    if (area.second > 0)
      hessian += (weight * area.second * p.depth.square) * p.by_area * p.by_area.transpose();
    if (!definite) {
      const Matrix3 turn = (0.5 * start_[t].side * weight * area.first * p.depth.square) * skew(surface_.up());
      for (int a = 0; a < 3; ++a) {
        hessian.block<3, 3>(3 * a, 3 * ((a + 2) % 3)) += turn;
        hessian.block<3, 3>(3 * a, 3 * ((a + 1) % 3)) -= turn;
      }
      hessian += (weight * area.first) * (p.by_area * p.by_square.transpose() + p.by_square * p.by_area.transpose());
    }
    return weight * area.value * p.depth.square + lifted(t, u);
  }

private:
  static constexpr double steepest = 0.05; // projection over area
  struct Start {
    double side = 1;                // by which A_z counts: -1 where the normal points to the bath
    double steep = 0;               // the projection below which it counts less [m²]
    double weight = 0;              // ρ g/12, or 0 if the bath reaches no corner from below alone [N/m³]
    std::array<bool, 3> below{};    // which corners it reaches so
    Vector3 lift = Vector3::Zero(); // at each corner, where it is deeper than its thickness [N]
    double thickness = 0;           // h [m]
  };

  // Of a corner at the height d, with its derivatives by d: its force is all of it below -h, and none above 0.
  struct Lift {
    double value, first, second;
    Lift(double all, double d, double h) : value(-all * (d + h / 2)), first(-all), second(0) {
      if (d <= -h)
        return;
      const double under = std::min(d, 0.0);
      value = all * under * under / (2 * h);
      first = all * under / h;
      second = d < 0 ? all / h : 0;
    }
  };

  // What counts of A_z, with its derivatives: itself, a parabola between ±s, nothing below.
  struct Projection {
    double value, first = 1, second = 0;
    Projection(double area, double s) : value(area) {
      if (area >= s)
        return;
      const double above = std::max(0.0, area + s);
      value = above > 0 ? above * above / (4 * s) : 0;
      first = above > 0 ? above / (2 * s) : 0;
      second = above > 0 ? 1 / (2 * s) : 0;
    }
  };

  [[nodiscard]] double lifted(std::size_t t, const VectorN<9>& u) const {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      sum += Lift(start_[t].lift[a], surface_.height(u.segment<3>(3 * a)), start_[t].thickness).value;
    return sum;
  }

  // q as a function of the heights of the three vertices, with its derivatives.
  struct Depth {
    double square = 0;
    Vector3 first = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();

    void add_whole(const Vector3& d) {
      const double sum = d.sum();
      square += 0.5 * (d.squaredNorm() + sum * sum);
      first += d + Vector3::Constant(sum);
      second += Matrix3::Identity() + Matrix3::Ones();
    }
    // The third of the triangle at vertex a.
    void add_alone(double d, int a) {
      square += 2 * d * d;
      first[a] += 4 * d;
      second(a, a) += 4;
    }
    // The part on the side of vertex a, which lies alone on its side of the surface.
    void add_corner(const Vector3& d, int a, double sign) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double x = d[a], s = x / (x - d[b]), r = x / (x - d[c]), w = sign * s * r;
      square += w * x * x;
      first += w * x * (Vector3::Unit(a) * (4 - s - r) + Vector3::Unit(b) * s + Vector3::Unit(c) * r);
      second(a, a) += w * (12 - 8 * (s + r) + 2 * (s * s + s * r + r * r));
      second(b, b) += 2 * w * s * s;
      second(c, c) += 2 * w * r * r;
      const double ab = w * s * (4 - 2 * s - r), ac = w * r * (4 - s - 2 * r), bc = w * s * r;
      for (const auto& [i, j, value] : {std::tuple(a, b, ab), {a, c, ac}, {b, c, bc}}) {
        second(i, j) += value;
        second(j, i) += value;
      }
    }

    Depth(const Vector3& d, const std::array<bool, 3>& below, bool clings) {
      if (!(below[0] && below[1] && below[2])) {
        for (int a = 0; a < 3; ++a)
          if (below[static_cast<std::size_t>(a)] && (clings || d[a] < 0))
            add_alone(d[a], a);
        return;
      }
      const auto under = (d.array() < 0).count();
      if (clings || under == 3) {
        add_whole(d);
        return;
      }
      if (under == 2)
        add_whole(d);
      for (int a = 0; a < 3 && under > 0; ++a)
        if ((d[a] < 0) == (under == 1))
          add_corner(d, a, under == 1 ? 1 : -1);
    }
  };

  struct Parts {
    double area;
    Depth depth;
    VectorN<9> by_area, by_square;
    Parts(const Bath& bath, const VectorN<9>& u, const Start& start)
        : depth(Eigen::Map<const Matrix3>(u.data()).transpose() * bath.surface_.up() -
                    Vector3::Constant(bath.surface_.level()),
                start.below, bath.clings_) {
      const Vector3& k = bath.surface_.up();
      const double side = start.side;
      const Vector3 x[3] = {u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)};
      area = 0.5 * side * k.dot((x[1] - x[0]).cross(x[2] - x[0]));
      for (int a = 0; a < 3; ++a) {
        by_area.segment<3>(3 * a) = 0.5 * side * k.cross(x[(a + 2) % 3] - x[(a + 1) % 3]);
        by_square.segment<3>(3 * a) = depth.first[a] * k;
      }
    }
  };

  double weight_; // ρ g/12 [N/m³]
  BathSurface surface_;
  bool clings_;
  std::vector<Start> start_; // of each triangle
};

} // namespace sheet
