// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic drag of air, or of a bath, on what moves through it [Hoerner 1965, chapters 2 and 3]: with w the velocity
// less the wind's, w_n across a triangle and w_t along it, the pressure C_n ρ |w_n| w_n/2 and the friction
// C_t ρ |w_t| w_t/2 [Pa], C_t for both faces together. For each corner of a triangle
//   W = (Â/3) τ (ρ/6) (C_n |w_n|³ + C_t |w_t|³),   w = (x - x̄)/τ - wind,
// Â and the normal predicted for the end of the stage, x̄ the start of the step, in a second stage extrapolated from the
// first, wind at the stage's end. A corner that is sheltered has none of it, one that slides no friction, one that is
// reached on one face half the friction, and nothing across.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/geometry/area.h"

namespace sheet {

struct OuterFlow {
  const char* name = "drag of air";
  double density = 0;                                                                      // ρ [kg/m³]
  double drag = 0, friction = 0;                                                           // C_n, C_t
  std::function<Vector3(double)> wind = [](double) -> Vector3 { return Vector3::Zero(); }; // at a time [m/s]
  std::vector<char> sheltered = {}; // of each vertex, whether it is not reached; empty: all are
  std::vector<char> slides = {};    // of each vertex, whether it has no friction; empty: all have
  std::vector<char> one_face = {};  // of each vertex, whether only one of its faces is reached; empty: of none
};

class FormDrag {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr bool external = true;
  explicit FormDrag(OuterFlow flow) : flow_(std::move(flow)) {}
  [[nodiscard]] const char* name() const { return flow_.name; }
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  void begin(const Stage& stage) {
    mesh_ = stage.start->mesh;
    const Vector3 blown = stage.duration * flow_.wind(stage.end_time);
    still_.resize(stage.vertices());
    for (std::uint32_t v = 0; v < still_.size(); ++v)
      still_[v] = reference_position(stage, v) + blown;
    triangles_.resize(mesh_->triangles.size());
    const auto& x = stage.predicted;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Corners& c = mesh_->triangles[t];
      triangles_[t].normal = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal;
      triangles_[t].weight = stage.raised[t].area() * flow_.density / (18 * stage.duration * stage.duration);
    }
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    each_corner(i, u, [&](int, const Vector3& across, const Vector3& along, double friction) {
      sum += potential(triangles_[i].weight, across.norm(), along.norm(), friction);
    });
    return sum;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    double sum = 0;
    gradient.setZero();
    each_corner(i, u, [&](int c, const Vector3& across, const Vector3& along, double friction) {
      sum += add_corner(triangles_[i].weight, across, along, friction, gradient.segment<3>(3 * c));
    });
    return sum;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian, bool) const {
    double sum = 0;
    gradient.setZero();
    hessian.setZero();
    const Vector3& normal = triangles_[i].normal;
    const Matrix3 nn = normal * normal.transpose();
    each_corner(i, u, [&](int c, const Vector3& across, const Vector3& along, double friction) {
      const double weight = 3 * triangles_[i].weight, slid = along.norm();
      sum += add_corner(triangles_[i].weight, across, along, friction, gradient.segment<3>(3 * c));
      auto block = hessian.block<3, 3>(3 * c, 3 * c);
      block = 2 * weight * flow_.drag * across.norm() * nn + weight * friction * slid * (Matrix3::Identity() - nn);
      if (slid > 0)
        block += weight * friction / slid * along * along.transpose();
    });
    return sum;
  }

private:
  struct Triangle {
    Vector3 normal = Vector3::Zero();
    double weight = 0; // Â ρ/(18 τ²) [kg/(m s²)]
  };

  static double cube(double x) { return x * x * x; }
  [[nodiscard]] double potential(double weight, double across, double along, double friction) const {
    return weight * (flow_.drag * cube(across) + friction * cube(along));
  }
  // Adds a corner's to the gradient and returns its potential.
  double add_corner(double weight, const Vector3& across, const Vector3& along, double friction,
                    Eigen::Ref<Vector3> gradient) const {
    const double a = across.norm(), l = along.norm();
    gradient += 3 * weight * (flow_.drag * a * across + friction * l * along);
    return potential(weight, a, l, friction);
  }
  // Of each corner that is reached what it has moved against the flow, across the triangle and along it [m], and C_t.
  template <class Visit> void each_corner(std::size_t i, const VectorN<9>& u, Visit&& visit) const {
    const Vector3& normal = triangles_[i].normal;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh_->triangles[i][static_cast<std::size_t>(c)];
      if (!flow_.sheltered.empty() && flow_.sheltered[v] != 0)
        continue;
      const Vector3 moved = u.segment<3>(3 * c) - still_[v], across = normal.dot(moved) * normal;
      const bool rubs = flow_.slides.empty() || flow_.slides[v] == 0;
      const bool on_one = !flow_.one_face.empty() && flow_.one_face[v] != 0;
      visit(c, on_one ? Vector3(Vector3::Zero()) : across, rubs ? Vector3(moved - across) : Vector3::Zero(),
            on_one ? flow_.friction / 2 : flow_.friction);
    }
  }

  OuterFlow flow_;
  std::shared_ptr<const Connectivity> mesh_;
  std::vector<Vector3> still_; // of each vertex: where it would be if it rested in the flow, from x̄ on [m]
  std::vector<Triangle> triangles_;
};

} // namespace sheet
